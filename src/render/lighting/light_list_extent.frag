#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_tiles.glsl"
#include "render/shaders/samples.glsl"

// The depths of the surfaces that blend, by tile: they are in no depth buffer. Variant MULTISAMPLED: at each sample that is covered, as
// their shader computes them, and a little more, as that may round otherwise.
layout(constant_id = 6) const uint kTileSize = 16u;
layout(early_fragment_tests) in;
layout(set = 1, binding = kPassStorage + kListBlended, scalar) buffer Blended { uvec2 blended[]; };  // bits of depth: nearest, ~farthest
#ifdef MULTISAMPLED
layout(location = 0) in vec3 positionView;
#endif

void add(float farthest, float nearest) {
    const uint tile = tileOf(uvec2(gl_FragCoord.xy), kTileSize);
    atomicMax(blended[tile].x, floatBitsToUint(nearest));
    atomicMax(blended[tile].y, ~floatBitsToUint(farthest));
}

void main() {
#ifdef MULTISAMPLED
    for (uint covered = uint(gl_SampleMaskIn[0]); covered != 0u; covered &= covered - 1u) {
        const float depth = depthOf(interpolateAtSample(positionView, firstSample(covered)));
        add(depth * (1.0 - 4e-6), depth * (1.0 + 4e-6));
    }
#else
    add(gl_FragCoord.z, gl_FragCoord.z);
#endif
}
