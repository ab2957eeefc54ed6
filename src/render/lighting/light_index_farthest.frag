#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/bindings.shared.h"
#include "render/lighting/light_index.shared.h"

layout(set = kPassSet, binding = kIndexDepth) uniform sampler2DMS depths;

// The farthest of the pixel's samples; depth is reversed.
void main() {
    float farthest = 1.0;
    for (int i = 0; i < 4; ++i) farthest = min(farthest, texelFetch(depths, ivec2(gl_FragCoord.xy), i).x);
    gl_FragDepth = farthest;
}
