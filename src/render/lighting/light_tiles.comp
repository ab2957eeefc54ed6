#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_tiles.glsl"

// What lies in each tile: its range of depth and the slices that hold a surface (Harada 2012, "A 2.5D Culling for Forward+"). One
// invocation a tile. Variants: CLUSTERED, its clusters are counted; MULTISAMPLED, several depths a pixel; BLENDED, surfaces that blend
// lie before them.
layout(constant_id = 3) const uint kTileSize = 16u;
layout(local_size_x = 64) in;
#ifdef MULTISAMPLED
layout(set = 1, binding = kListDepth) uniform sampler2DMS depths;
const int kSamples = 4;
#else
layout(set = 1, binding = kListDepth) uniform sampler2D depths;
const int kSamples = 1;
#endif
layout(set = 1, binding = kPassStorage + kListTiles, scalar) writeonly buffer Tiles { Tile tiles[]; };
#ifdef CLUSTERED
layout(set = 1, binding = kPassStorage + kListCounts, scalar) writeonly buffer Counts { uint counts[]; };
#endif
#ifdef BLENDED
layout(set = 1, binding = kPassStorage + kListBlended, scalar) readonly buffer Blended { uvec2 blended[]; };  // bits of depth: nearest, ~farthest
#endif

void main() {
    const uint index = gl_WorkGroupID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
    const uvec2 across = tilesOf(kTileSize);
    if (index >= across.x * across.y) return;
    const ivec2 first = ivec2(index % across.x, index / across.x) * int(kTileSize);
    const ivec2 end = min(first + int(kTileSize), ivec2(view.extent));
    Tile tile = Tile(2.0, -1.0, 0u);
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x)
            for (int s = 0; s < kSamples; ++s) {
                const float depth = texelFetch(depths, ivec2(x, y), s).x;
                if (holdsSurface(depth)) {
                    tile.farthest = min(tile.farthest, depth);
                    tile.nearest = max(tile.nearest, depth);
                }
            }
#ifdef BLENDED
    const bool blends = blended[index].x != 0u;
    const vec2 range = uintBitsToFloat(uvec2(~blended[index].y, blended[index].x));
    if (blends) {
        tile.farthest = min(tile.farthest, range.x);
        tile.nearest = max(tile.nearest, range.y);
    }
#endif
    if (tile.nearest >= 0.0) tile.slices = 1u << sliceOf(tile.nearest, tile.farthest);
    // A second look only where there are several slices.
    const int endOfMany = (tile.slices & ~1u) != 0u ? end.y : first.y;
    for (int y = first.y; y < endOfMany; ++y)
        for (int x = first.x; x < end.x; ++x)
            for (int s = 0; s < kSamples; ++s) {
                const float depth = texelFetch(depths, ivec2(x, y), s).x;
                if (holdsSurface(depth)) tile.slices |= 1u << sliceOf(depth, tile.farthest);
            }
#ifdef BLENDED
    // Any slice between the farthest and the nearest of them: they are many, and no two of them the same.
    if (blends)
        tile.slices |= bitfieldInsert(0u, ~0u, int(sliceOf(range.x, tile.farthest)), int(1u + sliceOf(range.y, tile.farthest) - sliceOf(range.x, tile.farthest)));
#endif
    tiles[index] = tile;
#ifdef CLUSTERED
    counts[index] = bitCount(tile.slices);
#endif
}
