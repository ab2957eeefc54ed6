// Lights by index, out of textures (light_tables.frag).
#ifndef LUCIOLE_LIGHT_TABLES_GLSL
#define LUCIOLE_LIGHT_TABLES_GLSL

layout(set = 1, binding = kIndexTables) uniform sampler2D tablePositions;
layout(set = 1, binding = kIndexTables + 1) uniform sampler2D tableColors;
layout(set = 1, binding = kIndexTables + 2) uniform sampler2D tableDirections;
layout(set = 1, binding = kIndexTables + 3) uniform sampler2D tableKinds;
layout(set = 1, binding = kIndexTables + 4) uniform sampler2D tableFunctions;
layout(set = 1, binding = kPassStorage + kIndexShapes, scalar) readonly buffer Classes { uint classOfObject[]; };
layout(constant_id = 17) const uint kRows = 1u;  // of 256 lights

uint loaded(float stored) { return stored < 0.0 ? kNoIndex : uint(stored); }

// What does not reach the surface's object, as the null light, has the range 0.
LightConstants indexedLight(uint index) {
    const ivec2 texel = ivec2(index & 255u, index >> 8u);
    const ivec2 own = texel + ivec2(0, usesLights(kUsesLinks) ? classOfObject[point.s.objectId] * kRows : 0u);
    const vec4 place = texelFetch(tablePositions, texel, 0);
    const vec4 color = texelFetch(tableColors, own, 0);
    LightConstants light;
    light.position = place.xyz;
    light.inverseRange = place.w;
    light.color = color.rgb;
    light.range = color.w;
    light.type = kLightPoint;
    light.flags = kLightDiffuse | kLightSpecular;
    light.attenuation = light.falloff = light.linkGroup = light.volume = kNoIndex;
    if (usesLights(kUsesSpot | kUsesDirectional | kUsesCurves | kUsesVolumes | kUsesContributions | kUsesLambertian | kCountsLights)) {
        const vec4 direction = texelFetch(tableDirections, texel, 0);
        const vec4 kind = texelFetch(tableKinds, texel, 0);
        light.direction = direction.xyz;
        light.cosOuter = direction.w;
        light.coneScale = kind.x;
        light.coneOffset = kind.y;
        light.type = uint(kind.z) & 255u;
        light.flags = uint(kind.z) >> 8u;
        light.sceneIndex = uint(kind.w);
    }
    if (usesLights(kUsesCurves | kUsesVolumes)) {
        const vec4 rows = texelFetch(tableFunctions, texel, 0);
        light.attenuation = loaded(rows.x);
        light.falloff = loaded(rows.y);
        light.volume = loaded(rows.z);
    }
    return light;
}
#endif
