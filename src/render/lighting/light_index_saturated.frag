#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_index.shared.h"
#include "render/shaders/frame.glsl"

layout(early_fragment_tests) in;
layout(set = 1, binding = kPassStorage + kIndexCounters, scalar) buffer Counters { uint counters[]; };

// Variants: COUNTED, an image holds the number of lights; else the stencil does, and lets through where it is too large. MULTISAMPLED: an
// invocation a sample, which naming the sample brings about.
#ifdef COUNTED
layout(push_constant, scalar) uniform Push { uint overlap; };
#ifdef MULTISAMPLED
layout(set = 1, binding = kIndexImages) uniform sampler2DMS numbers;
#else
layout(set = 1, binding = kIndexImages) uniform sampler2D numbers;
#endif
#endif

void main() {
#ifdef MULTISAMPLED
    const int sample_ = gl_SampleID;
#else
    const int sample_ = 0;
#endif
    bool over = sample_ >= 0;
#ifdef COUNTED
    over = uint(texelFetch(numbers, ivec2(gl_FragCoord.xy), sample_).x * 255.0 + 0.5) > overlap;
#endif
    if (over) atomicAdd(counters[kCounterPixels], 1u);
}
