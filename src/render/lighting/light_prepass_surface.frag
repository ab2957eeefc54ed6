#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/geometry/gbuffer.glsl"
#include "render/geometry/surface_shading.glsl"

layout(location = 0) out vec4 outSurface;
layout(location = 1) out float outObject;

// What light terms need of a surface (light_prepass.shared.h); its colours are not among it.
void main() {
    float alpha;
    const Surface s = surfaceHere(alpha);
    outSurface = vec4(packNormal(s.N), s.roughness, packIndex(s.material));
    outObject = packIndex(s.objectId);
}
