#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/bindings.shared.h"

#ifdef MULTISAMPLED
layout(set = kPassSet, binding = 0) uniform sampler2DMS more;
#define SAMPLE_HERE gl_SampleID
#else
layout(set = kPassSet, binding = 0) uniform sampler2D more;
#define SAMPLE_HERE 0
#endif
layout(location = 0) out vec4 sum;

// Adds what a further pass over the surfaces gave.
void main() { sum = texelFetch(more, ivec2(gl_FragCoord.xy), SAMPLE_HERE); }
