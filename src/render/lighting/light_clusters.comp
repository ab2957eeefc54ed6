#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_tiles.glsl"

// The clusters that hold a surface, tile by tile, the farthest of a tile first (Olsson et al. 2012, "Clustered Deferred and Forward
// Shading", section 4.3: finding unique clusters, by a bit for each slice instead of by sorting).
layout(constant_id = 3) const uint kTileSize = 16u;
layout(local_size_x = 64) in;
layout(set = 1, binding = kPassStorage + kListTiles, scalar) readonly buffer Tiles { Tile tiles[]; };
layout(set = 1, binding = kPassStorage + kListFirstClusters, scalar) readonly buffer FirstClusters { uint firstClusters[]; };
layout(set = 1, binding = kPassStorage + kListClusters, scalar) writeonly buffer Clusters { uint clusters[]; };

void main() {
    const uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
    const uvec2 across = tilesOf(kTileSize);
    if (tile >= across.x * across.y) return;
    uint cluster = firstClusters[tile];
    for (uint slices = tiles[tile].slices; slices != 0u; slices &= slices - 1u) clusters[cluster++] = tile << kSliceBits | findLSB(slices);
}
