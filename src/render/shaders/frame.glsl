// Set 0: the tables of the frame, for every pass.
#ifndef LUCIOLE_FRAME_GLSL
#define LUCIOLE_FRAME_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "gpu/bindings.shared.h"
#include "render/shaders/types.shared.h"

layout(constant_id = 0) const uint kLayout = 0u;
layout(constant_id = 1) const uint kEquations = ~0u;
layout(constant_id = 2) const uint kLights = ~0u;

layout(set = 0, binding = 0, scalar) uniform View { ViewConstants view; };
layout(set = 0, binding = 2, scalar) readonly buffer Materials { MaterialConstants materials[]; };
layout(set = 0, binding = 3, scalar) uniform UniformMaterials_ { MaterialConstants uniformMaterials[kUniformMaterials]; };
layout(set = 0, binding = 4, scalar) readonly buffer Lights { PackedLight lights[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Links { uint links[]; };
layout(set = 0, binding = 6) uniform sampler2D functions;
layout(set = 0, binding = 7, scalar) uniform UniformLights { PackedLight uniformLights[kUniformLights]; };
layout(set = 0, binding = 8, scalar) readonly buffer LightKinds { LightKind lightKinds[]; };
layout(set = 0, binding = 9, scalar) readonly buffer Volumes { VolumeConstants volumes[]; };
layout(set = 0, binding = 10, scalar) readonly buffer VolumeVertices { vec3 volumeVertices[]; };
layout(set = 0, binding = 11, scalar) uniform UniformLightKinds { LightKind uniformLightKinds[kUniformLightKinds]; };
layout(set = 0, binding = 12) uniform sampler2D lightTree;

bool usesMaterials(uint bit) { return (kEquations & bit) != 0u; }
bool usesEquation(uint equation) { return usesMaterials(1u << equation); }
// Whether a surface's equation is this one: where there is no other, without a look at its material.
bool isEquation(uint equation, MaterialConstants material) {
    const bool alone = (kEquations & kEquationBits) == 1u << equation;
    return alone || (usesEquation(equation) && material.equation == equation);
}
MaterialConstants materialAt(uint index) {
    if (usesMaterials(kMaterialsFit)) return uniformMaterials[index];
    return materials[index];
}

// Read here once: Mesa's software driver (22.3) leaves in a loop what is read in it, though it never changes.
vec3 eyeWorld = view.worldFromView[3].xyz;

bool usesLights(uint bit) { return (kLights & bit) != 0u; }

LightKind lightKindAt(uint index) {
    if (usesLights(kUsesUniformLightKinds)) return uniformLightKinds[index];
    return lightKinds[index];
}

LightConstants unpackLight(PackedLight packed) {
    LightConstants light = unpackLight(packed, lightKindAt(kindOf(packed)));
    if (!usesLights(kUsesVolumes)) light.volume = kNoIndex;
    return light;
}

// A light of the table, in world space.
LightConstants lightInWorld(uint index) {
    if (usesLights(kUsesUniformLights)) return unpackLight(uniformLights[index]);
    return unpackLight(lights[index]);
}

// In shading space (docs/conventions.md, "Spaces"): for whatever lights surfaces.
LightConstants lightAt(uint index) {
    LightConstants light = lightInWorld(index);
    light.position -= eyeWorld;
    return light;
}

// In view space: for whatever asks where on the screen it is.
LightConstants lightInView(uint index) { return inView(lightInWorld(index), view.viewFromWorld, eyeWorld); }

vec3 shadingFromView(vec3 directionView) { return mat3(view.worldFromView) * directionView; }
vec3 viewFromShading(vec3 directionShading) { return mat3(view.viewFromWorld) * directionShading; }
#endif
