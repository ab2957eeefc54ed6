#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/forward.shared.h"
#include "render/shaders/frame.glsl"

layout(set = 1, binding = kPassStorage + kForwardCounts, scalar) readonly buffer Counts { uint counts[]; };
layout(location = 0) out vec4 sum;

// Adds what the forward passes counted to the picture of counts.
void main() {
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    const uint first = (pixel.y * uint(view.extent.x) + pixel.x) * kForwardCounters;
    sum = vec4(counts[first], counts[first + 1u], counts[first + 2u], 0);
}
