// Tiles as points: what the shaders and the host code agree on. Read by both compilers.
#ifndef LUCIOLE_TILED_POINTS_SHARED_H
#define LUCIOLE_TILED_POINTS_SHARED_H
#include "render/lighting/light_texels.shared.h"
SHARED_BEGIN
// A batch is a few lights of a tile's list, which a point as large as the tile brings along.
struct Batch {
    uint tile;
    uint firstEntry;
    uint lights;  // 0: the tile has none, but the light that is there without lights
    uint first;   // of its tile: that light belongs to it
};
const uint kBatchTexels = 24u;  // that a point brings along
const uint kPassedOn = 4u * kBatchTexels + 8u;  // values: the texels, two numbers, the position
const uint kBatchSizes = 4u;    // batches are sorted by how many lights there is room for, so that none evaluates many too many

// Lights that a batch of a size has room for. \param most kBatchTexels / texelsOfLight
SHARED_FN uint batchLights(uint size, uint most) { return size == 0u ? (most + 5u) / 6u : size == 1u ? (most + 2u) / 3u : size == 2u ? (2u * most + 2u) / 3u : most; }
// The smallest that does.
SHARED_FN uint batchSize(uint lights, uint most) {
    uint size = 0u;
    while (batchLights(size, most) < lights) ++size;
    return size;
}

const uint kBatchCounts = 1u;  // storage buffers by slot: by size and tile; those of light_lists.shared.h besides
const uint kBatchPlaces = 2u;
const uint kBatches = 0u;      // when they are filled in and drawn
const uint kBatchDraws = 5u;
struct PointDraw {             // VkDrawIndirectCommand
    uint vertexCount;
    uint instanceCount;
    uint firstVertex;
    uint firstInstance;
};
SHARED_END
#endif
