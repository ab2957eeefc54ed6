// What the geometry phase's fragment shaders get: interpolants, the material and its textures.
#include "render/shaders/frame.glsl"

layout(location = 0) in vec3 positionView;
layout(location = 1) in vec3 positionObject;
layout(location = 2) in vec3 normalView;
layout(location = 3) in vec4 tangentView;
layout(location = 4) in vec4 uv;
layout(location = 5) in vec4 color;
layout(location = 6) flat in uint objectIndex;

layout(set = 2, binding = 0) uniform sampler2D textureBaseColor;
layout(set = 2, binding = 1) uniform sampler2D textureMetallicRoughness;
layout(set = 2, binding = 2) uniform sampler2D textureNormal;
layout(set = 2, binding = 3) uniform sampler2D textureOcclusion;
layout(set = 2, binding = 4) uniform sampler2D textureEmissive;

layout(constant_id = 3) const uint kSurfaceShader = 0u;  // enum SurfaceShader
layout(constant_id = 4) const uint kMasked = 0u;
layout(constant_id = 5) const uint kTextures = 0u;       // bit i: slot i has a texture

bool hasTexture(uint slot) { return (kTextures & (1u << slot)) != 0u; }

vec2 uvOf(TextureSlot slot) {
    const vec3 p = vec3(slot.uvSet == 0u ? uv.xy : uv.zw, 1);
    return vec2(dot(slot.uRow, p), dot(slot.vRow, p));
}

// Base colour with alpha: factor * texture * vertex colour.
vec4 baseColor(SurfaceConstants surface) {
    vec4 base = surface.baseColor * color;
    if (hasTexture(kTextureBaseColor)) base *= texture(textureBaseColor, uvOf(surface.slots[kTextureBaseColor]));
    return base;
}
