#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_tiles.glsl"
#include "render/lighting/tiled_points.shared.h"

// Cuts the tiles' lists into batches: as many as are full, and one for the rest. Variant FILL, the second time: when each has its place.
layout(constant_id = 3) const uint kTileSize = 16u;
layout(constant_id = 4) const uint kParts = 1u;
layout(constant_id = 5) const uint kMost = 12u;   // lights of a full batch
layout(constant_id = 6) const uint kFirst = 1u;   // page of the lights
layout(local_size_x = 64) in;
layout(set = 1, binding = kPassStorage + kListOffsets, scalar) readonly buffer Offsets { uint offsets[]; };
#ifdef FILL
layout(set = 1, binding = kPassStorage + kBatches, scalar) writeonly buffer Batches { Batch batches[]; };
layout(set = 1, binding = kPassStorage + kBatchPlaces, scalar) readonly buffer Places { uint places[]; };
layout(set = 1, binding = kPassStorage + kBatchDraws, scalar) writeonly buffer Draws { PointDraw draws[]; };
#else
layout(set = 1, binding = kPassStorage + kListTiles, scalar) readonly buffer Tiles { Tile tiles[]; };
layout(set = 1, binding = kPassStorage + kBatchCounts, scalar) writeonly buffer Counts { uint counts[]; };
#endif

void main() {
    const uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
    const uvec2 across = tilesOf(kTileSize);
    const uint all = across.x * across.y;
    if (tile >= all) return;
    const uint begin = offsets[tile * kParts];
    const uint lights = offsets[(tile + 1u) * kParts] - begin;
    const uint full = lights / kMost;
    const uint rest = lights - full * kMost;
#ifdef FILL
    const uint last = kBatchSizes - 1u;
    if (tile == 0u)
        for (uint size = 0u; size < kBatchSizes; ++size) draws[size] = PointDraw(places[(size + 1u) * all] - places[size * all], 1u, places[size * all], 0u);
    const uint place = places[last * all + tile];
    for (uint i = 0u; i < full && place + i < uint(batches.length()); ++i)
        batches[place + i] = Batch(tile, begin + i * kMost, kMost, uint(kFirst != 0u && i == 0u));
    const uint size = batchSize(rest, kMost);
    // Whether there is a batch of the rest its place tells: an empty tile has none.
    const uint restPlace = places[size * all + tile] + (size == last ? full : 0u);
    if (restPlace < places[size * all + tile + 1u] && restPlace < uint(batches.length()))
        batches[restPlace] = Batch(tile, begin + full * kMost, rest, uint(kFirst != 0u && full == 0u));
#else
    const bool restCounts = rest > 0u || (lights == 0u && kFirst != 0u && tiles[tile].slices != 0u);
    for (uint size = 0u; size < kBatchSizes; ++size)
        counts[size * all + tile] = (size == kBatchSizes - 1u ? full : 0u) + uint(restCounts && size == batchSize(rest, kMost));
#endif
}
