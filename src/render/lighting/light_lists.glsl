// The list of lights of a pixel, in shaders that use it. Variant CLUSTERED: that of the pixel's cluster, else that of its tile.
#ifndef LUCIOLE_LIGHT_LISTS_GLSL
#define LUCIOLE_LIGHT_LISTS_GLSL
#include "render/lighting/light_tiles.glsl"

layout(set = 1, binding = kPassStorage + kListTiles, scalar) readonly buffer Tiles { Tile tiles[]; };
layout(set = 1, binding = kPassStorage + kListOffsets, scalar) readonly buffer Offsets { uint offsets[]; };
layout(set = 1, binding = kPassStorage + kListEntries, scalar) readonly buffer Entries { uint entries[]; };
#ifdef CLUSTERED
layout(set = 1, binding = kPassStorage + kListFirstClusters, scalar) readonly buffer FirstClusters { uint firstClusters[]; };
#endif

// Begin and end of the list of a surface, among the entries. \param depth of the surface, as the depth buffer has it
uvec2 listAt(uvec2 pixel, float depth, uint tileSize, uint parts) {
    const uint tile = tileOf(pixel, tileSize);
    uint list = tile;
#ifdef CLUSTERED
    if (!holdsSurface(depth)) return uvec2(0);
    const uint slice = sliceOf(depth, tiles[tile].farthest);
    list = firstClusters[tile] + bitCount(tiles[tile].slices & ((1u << slice) - 1u));
#endif
    // The host sees what is missing, and makes room.
    return min(uvec2(offsets[list * parts], offsets[(list + 1u) * parts]), uint(entries.length()));
}
#endif
