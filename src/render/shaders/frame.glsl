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
layout(set = 0, binding = 1, scalar) readonly buffer Objects { ObjectConstants objects[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Materials { MaterialConstants materials[]; };
layout(set = 0, binding = 3, scalar) uniform UniformMaterials_ { MaterialConstants uniformMaterials[kUniformMaterials]; };
layout(set = 0, binding = 4, scalar) readonly buffer Lights { LightConstants lights[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Links { uint links[]; };
layout(set = 0, binding = 6) uniform sampler2D functions;
layout(set = 0, binding = 7, scalar) uniform UniformLights { LightConstants uniformLights[kUniformLights]; };
layout(set = 0, binding = 8, scalar) readonly buffer Sources { LightConstants sources[]; };
layout(set = 0, binding = 9, scalar) readonly buffer Volumes { VolumeConstants volumes[]; };
layout(set = 0, binding = 10, scalar) readonly buffer VolumeVertices { vec3 volumeVertices[]; };
layout(set = 0, binding = 11) uniform sampler2D lightTree;

bool usesMaterials(uint bit) { return (kEquations & bit) != 0u; }
bool usesEquation(uint equation) { return usesMaterials(1u << equation); }
// Whether a surface's equation is this one: where there is no other, without a look at its material.
bool isEquation(uint equation, MaterialConstants material) {
    const bool alone = (kEquations & (kMaterialsFit - 1u)) == 1u << equation;
    return alone || (usesEquation(equation) && material.equation == equation);
}
MaterialConstants materialAt(uint index) {
    if (usesMaterials(kMaterialsFit)) return uniformMaterials[index];
    return materials[index];
}
LightConstants lightAt(uint index) {
    if ((kLights & kUsesUniformLights) != 0u) return uniformLights[index];
    return lights[index];
}
LightConstants lightInView(uint index) { return lightAt(index); }
#endif
