#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_tiles.glsl"

// The depths of the surfaces that blend, by tile: they are in no depth buffer. A little more, where their depth is computed again of their
// position. Variant MULTISAMPLED: at each sample.
layout(constant_id = 6) const uint kTileSize = 16u;
layout(early_fragment_tests) in;
layout(set = 1, binding = kPassStorage + kListBlended, scalar) buffer Blended { uvec2 blended[]; };  // bits of depth: nearest, ~farthest

void main() {
    const uint tile = tileOf(uvec2(gl_FragCoord.xy), kTileSize);
#ifdef MULTISAMPLED
    const float depth = gl_SampleID >= 0 ? gl_FragCoord.z : 0.0;
    const float more = 4e-6;
#else
    const float depth = gl_FragCoord.z;
    const float more = 0.0;
#endif
    atomicMax(blended[tile].x, floatBitsToUint(min(depth * (1.0 + more), 1.0)));
    atomicMax(blended[tile].y, ~floatBitsToUint(depth * (1.0 - more)));
}
