#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_index_draw.glsl"

layout(early_fragment_tests) in;
layout(set = 1, binding = kPassStorage + kIndexCounts, scalar) buffer Counts { uint counts[]; };  // by pixel

// How many lights hit each pixel.
void main() {
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    if (hits()) atomicAdd(counts[pixel.y * uint(view.extent.x) + pixel.x], 1u);
}
