#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/geometry/gbuffer_read.glsl"
#include "render/shaders/illuminate.glsl"

layout(push_constant, scalar) uniform Push { LightSlice slice; };
layout(location = 0) out vec4 radiance;

// Every light at every pixel, summed in registers: one rounding. The yardstick of all other techniques.
void main() {
    const ShadingPoint p = shadingPoint(readSurface(ivec2(gl_FragCoord.xy)));
    vec3 sum = vec3(0);
    for (uint i = 0u; i < slice.count; ++i) sum += illuminate(p, lightAt(slice.first + i));
    radiance = vec4(sum, 0);
}
