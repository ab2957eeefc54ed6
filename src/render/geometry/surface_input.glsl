// What the geometry phase's fragment shaders get: interpolants, the material and its textures.
#include "render/shaders/frame.glsl"

layout(location = 0) in vec3 positionView;
layout(location = 1) in vec3 positionObject;
layout(location = 2) in vec3 normalView;
layout(location = 3) in vec4 tangentView;
layout(location = 4) in vec4 uv;
layout(location = 5) in vec4 color;
layout(location = 6) flat in uvec2 materialAndObject;  // index into the materials, object ID

layout(set = 2, binding = 0) uniform sampler2D textureBaseColor;
layout(set = 2, binding = 1) uniform sampler2D textureMetallicRoughness;
layout(set = 2, binding = 2) uniform sampler2D textureNormal;
layout(set = 2, binding = 3) uniform sampler2D textureOcclusion;
layout(set = 2, binding = 4) uniform sampler2D textureEmissive;
layout(set = 2, binding = 5, scalar) uniform Material_ { DrawnMaterial material; };

layout(constant_id = 3) const uint kSurfaceShader = 0u;  // enum SurfaceShader
layout(constant_id = 4) const uint kMasked = 0u;
layout(constant_id = 5) const uint kInputs = 0u;         // bit i: slot i has a texture; bit kVertexColors: not all vertices are white

// Interpolants are read HERE: at the pixel's centre, or, where there are several samples a pixel, at `shadingSample`, one that the
// triangle covers, so that nothing is extrapolated.
#ifdef MULTISAMPLED
int shadingSample;
#define HERE(interpolant) interpolateAtSample(interpolant, shadingSample)
#else
#define HERE(interpolant) interpolant
#endif

bool hasInput(uint bit) { return (kInputs & (1u << bit)) != 0u; }
bool hasTexture(uint slot) { return hasInput(slot); }

// Texture of `slot` at this pixel. Derivatives are taken of the interpolants alone: in pixels outside the triangle, which
// only help with derivatives, Mesa's software driver (22.3) reads zeros from buffers.
vec4 sampleTexture(sampler2D image, SurfaceConstants surface, uint slotIndex) {
    const TextureSlot slot = surface.slots[slotIndex];
    const vec4 dx = dFdx(uv);
    const vec4 dy = dFdy(uv);
    const vec4 uvHere = HERE(uv);
    const vec2 p = slot.uvSet == 0u ? uvHere.xy : uvHere.zw;
    const vec2 px = slot.uvSet == 0u ? dx.xy : dx.zw;
    const vec2 py = slot.uvSet == 0u ? dy.xy : dy.zw;
    // precise: the depth set-up pass has to find the same alpha.
    precise const vec2 at = vec2(dot(slot.uRow, vec3(p, 1)), dot(slot.vRow, vec3(p, 1)));
    return textureGrad(image, at, vec2(dot(slot.uRow.xy, px), dot(slot.vRow.xy, px)),
                       vec2(dot(slot.uRow.xy, py), dot(slot.vRow.xy, py)));
}

// Base colour with alpha: factor * texture * vertex colour.
vec4 baseColor(SurfaceConstants surface) {
    precise vec4 base = surface.baseColor;
    if (hasInput(kVertexColors)) base *= HERE(color);
    if (hasTexture(kTextureBaseColor)) base *= sampleTexture(textureBaseColor, surface, kTextureBaseColor);
    return base;
}
