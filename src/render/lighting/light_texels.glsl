// A light as texels, or as flat interpolants. What a scene's lights don't need need not be kept (light_texels.shared.h).
#ifndef LUCIOLE_LIGHT_TEXELS_GLSL
#define LUCIOLE_LIGHT_TEXELS_GLSL
#include "render/lighting/light_texels.shared.h"
#include "render/shaders/illuminate.glsl"

struct LightTexels {
    vec4 place;      // position, type and flags
    vec4 color;      // colour, range
    vec4 direction;  // direction, cosine of the outer angle
    vec4 kind;       // the cone's scale, scene index
    vec4 rows;       // attenuation, falloff, volume, link group
};

// Small whole numbers as floats, which keep them; kNoIndex as -1.
float stored(uint index) { return index == kNoIndex ? -1.0 : float(index); }
uint loaded(float stored_) { return stored_ < 0.0 ? kNoIndex : uint(stored_); }

LightTexels toTexels(LightConstants light) {
    return LightTexels(vec4(light.position, float(light.type + 256u * light.flags)), vec4(light.color, light.range), vec4(light.direction, light.cosOuter),
                       vec4(light.coneScale, float(light.sceneIndex), 0, 0),
                       vec4(stored(light.attenuation), stored(light.falloff), stored(light.volume), stored(light.linkGroup)));
}

LightConstants toLight(LightTexels texels) {
    LightConstants light;
    light.position = texels.place.xyz;
    light.type = uint(texels.place.w) & 255u;
    light.flags = uint(texels.place.w) >> 8u;
    light.color = texels.color.rgb;
    light.range = texels.color.w;
    light.direction = vec3(0, 0, -1);
    light.cosOuter = kFullCone;
    light.coneScale = kFullConeScale;
    light.sceneIndex = 0u;
    light.attenuation = light.falloff = light.linkGroup = light.volume = kNoIndex;
    if (usesLights(kNeedsKinds)) {
        light.direction = texels.direction.xyz;
        light.cosOuter = texels.direction.w;
        light.coneScale = texels.kind.x;
        light.sceneIndex = uint(texels.kind.y);
    }
    if (usesLights(kNeedsRows)) {
        light.attenuation = loaded(texels.rows.x);
        light.falloff = loaded(texels.rows.y);
        light.volume = loaded(texels.rows.z);
        light.linkGroup = loaded(texels.rows.w);
    }
    return light;
}
#endif
