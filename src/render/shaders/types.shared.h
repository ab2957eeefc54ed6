// Everything that the host writes and shaders read. Scalar block layout, so that both compilers lay it out alike.
#ifndef LUCIOLE_TYPES_SHARED_H
#define LUCIOLE_TYPES_SHARED_H
#include "render/shaders/light.shared.h"
SHARED_BEGIN

// One view of the scene. Set 0, kFrameView.
struct ViewConstants {
    mat4 clipFromView;
    mat4 viewFromWorld;
    mat4 worldFromView;
    mat4 shadingFromGBuffer;  // from (pixel / extent, depth, 1), un-biasing included (Calver 2003, "Storing Position")
    vec3 sky;              // ambience, radiance
    uint lightCount;
    vec3 ground;
    uint linkWords;        // 32-bit words of one row of the link table
    vec3 upWorld;
    uint orthographic;
    vec2 extent;           // pixels
    float exposure;        // factor
    vec4 slack;            // light_volume.shared.h, slackOf
    vec2 clipScale;        // clipFromView[0][0] and -clipFromView[1][1]
    float zNear;
    uint cullLights;       // 0: lights that cover no pixel are drawn all the same
    uint shadowMaskWords;  // of a pixel's mask of shadow volumes
};

// What the geometry phase needs of a material.
const uint kTextureBaseColor = 0u;
const uint kTextureMetallicRoughness = 1u;
const uint kTextureNormal = 2u;
const uint kTextureOcclusion = 3u;
const uint kTextureEmissive = 4u;
const uint kTextureSlots = 5u;
const uint kVertexColors = 5u;  // after the slots, in the bits that say what a material's shader reads

struct TextureSlot {
    vec3 uRow;  // u' = dot(uRow, (u, v, 1))
    vec3 vRow;
    uint uvSet;
};

struct SurfaceConstants {
    vec4 baseColor;
    vec3 cs1;         // shaped: Ks times the specular colour; metallic-roughness: emissive / Kemm
    float metallic;   // shaped: specular blend
    float roughness;
    float normalScale;
    float occlusionStrength;
    float alphaCutoff;
    vec3 cs0Factor;   // shaped: Kd; then divided by MaterialConstants.cs0Scale
    float cs1Factor;  // 1 / MaterialConstants.cs1Scale
    vec3 proceduralColor;
    float proceduralScale;
    uint equation;
    TextureSlot slots[5];
};

// What the lighting phase needs of a material. Set 0, kFrameMaterials. Equations as enum LightEquation.
const uint kEquationMetallicRoughness = 0u;
const uint kEquationShaped = 1u;
const uint kEquationUnlit = 2u;

struct MaterialConstants {
    vec3 kAmbient;
    float kEmissive;
    float cs0Scale;  // the G-buffer stores Cs0 / cs0Scale, so that colours above 1 fit
    float cs1Scale;
    uint equation;
    uint diffuseFunction;   // Fa: row of the function table
    uint specularFunction;  // Fb
};
const uint kUniformMaterials = 1792u;  // of 36 bytes in 64 KiB

// The material that a draw has. Set 2, uniform: its members lie at offsets that a shader knows, which loads them once for many pixels.
struct DrawnMaterial {
    SurfaceConstants surface;
    MaterialConstants lit;
};

// A closed mesh that bounds a light, world space. Set 0, kFrameVolumes.
struct VolumeConstants {
    uint firstVertex;  // in the volumes' vertices: three per triangle
    uint vertexCount;
    vec3 low;          // bounds
    vec3 high;
};

// Rounds of loops, over lights and the triangles of their volumes, that one draw may go through. Mesa's software driver (22.3) leaves its loops after 65,535 rounds in all without a
// word, and GPU drivers end work that runs too long.
const uint kLightsPerDraw = 32768u;
struct LightSlice {
    uint first;
    uint count;
};

// The table of functions of one variable. Odd, so that 0 of [-1, 1] is a sample.
const uint kFunctionSamples = 4097u;

// Specialization constants that all passes of a frame share.
const uint kConstantLayout = 0u;     // enum GBufferLayout
const uint kConstantEquations = 1u;  // bit e: some material uses equation e; and what else there is of materials:
const uint kEquationBits = 255u;
const uint kMaterialsFit = 256u;     // all fit into a uniform buffer, the faster way to read them
const uint kMaterialsScale = 512u;   // some have a cs0Scale or cs1Scale other than 1
const uint kMaterialsEmit = 1024u;   // some have a kEmissive other than 0
const uint kConstantLights = 2u;     // bits kUses*
const uint kUsesLocal = 1u;          // a point or spot light
const uint kUsesDirectional = 2u;
const uint kUsesSpot = 4u;
const uint kUsesCurves = 8u;         // an attenuation or falloff function
const uint kUsesLinks = 16u;
const uint kUsesContributions = 32u; // a diffuse-only, specular-only or infinite-viewer light
const uint kUsesUniformLights = 64u; // all lights fit into a uniform buffer, the faster way to read them
const uint kUniformLights = 1170u;   // of 56 bytes in 64 KiB
const uint kUsesVolumes = 128u;      // a light that is bounded by a mesh, and nothing else has seen to that
const uint kCountsLights = 256u;     // passes add up what they evaluate instead of light (contribution.glsl)
const uint kUsesLambertian = 512u;
const uint kUsesUniformLightKinds = 1024u;  // likewise all kinds of lights
const uint kUniformLightKinds = 4096u;      // of 16 bytes
const uint kUsesShadows = 2048u;            // shadow maps keep light off (shadow.glsl), by enum ShadowFilter:
const uint kShadowsJittered = 4096u;
const uint kShadowsSmooth = 8192u;
const uint kShadowsStencilled = 16384u;     // shadow volumes do
const uint kShadowsByIndex = 32768u;        // light-indexed: surfaces ask for none of lights that have an index
const uint kShadowsWait = 65536u;           // a map may be of where its light was, which costs a look (shadow-redraws)

SHARED_END
#endif
