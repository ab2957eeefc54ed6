#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_lists.glsl"

// What a page's lists add to the layers list-length and list-slice. Variants: CLUSTERED; MULTISAMPLED, the first sample's.
layout(constant_id = 3) const uint kTileSize = 16u;
layout(constant_id = 4) const uint kParts = 1u;
layout(constant_id = 5) const uint kFirst = 1u;  // page: it brings the slice
#ifdef MULTISAMPLED
layout(set = 1, binding = kListDepth) uniform sampler2DMS depths;
#else
layout(set = 1, binding = kListDepth) uniform sampler2D depths;
#endif
layout(location = 0) out vec4 layers;  // length, slice

void main() {
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    const float depth = texelFetch(depths, ivec2(pixel), 0).x;
    const uvec2 list = listAt(pixel, depth, kTileSize, kParts);
    float slice = depth > 0.0 ? 0.0 : -1.0;
#ifdef CLUSTERED
    const float farthest = tiles[tileOf(pixel, kTileSize)].farthest;
    if (depth > 0.0) slice = float(sliceFrom0(1.0)) - float(sliceFrom0(farthest) + sliceOf(depth, farthest));
#endif
    layers = vec4(list.y - list.x, kFirst != 0u ? slice : 0.0, 0, 0);
}
