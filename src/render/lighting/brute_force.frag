#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/geometry/gbuffer_read.glsl"
#include "render/lighting/contribution.glsl"

layout(push_constant, scalar) uniform Push { LightSlice slice; };
layout(location = 0) out vec4 sum;

// Every light at every pixel, summed in registers: one rounding. The yardstick of all other techniques.
void main() {
    const ShadingPoint p = shadingPoint(readSurface(ivec2(gl_FragCoord.xy)));
    sum = vec4(0);
    const LightSlice all = slice;  // read once, as eyeWorld is
    for (uint i = 0u; i < all.count; ++i) sum += contribution(p, lightAt(all.first + i));
}
