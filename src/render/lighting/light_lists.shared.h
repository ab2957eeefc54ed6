// Lists of lights by tile or cluster: what their shaders and host code agree on. Read by both compilers.
#ifndef LUCIOLE_LIGHT_LISTS_SHARED_H
#define LUCIOLE_LIGHT_LISTS_SHARED_H
#include "render/lighting/prefix_sum.shared.h"
SHARED_BEGIN
// The picture is cut into square tiles, a tile's depth into slices. A cluster is a slice of a tile that holds a surface.
//     tile -> first cluster; range of depth, occupied slices
//             cluster -> where its list begins in each page of the table of lights
//                        entries: light indices in the order of the table
const uint kListTiles = 0u;         // storage buffers by slot: Tile
const uint kListFirstClusters = 1u; // by tile; at the end the number of clusters
const uint kListClusters = 2u;      // by cluster: tile << kSliceBits | slice
const uint kListOffsets = 3u;       // by cluster and part: where its list begins; one more at the end
const uint kListEntries = 4u;       // light indices
const uint kListCounts = 5u;        // while lists are made: by cluster and part their lengths; by tile its clusters; then the counters
const uint kListDepth = 15u;        // sampled image: the depth of the surfaces
const uint kListBlended = 2u;       // while clusters are found, storage buffer: by tile, the depths of surfaces that blend

// Depth as the depth buffer has it: 1 at the near plane, less where farther. Slices are counted from the farthest surface of the tile on, the last
// one takes what is nearer.
struct Tile {
    float farthest;  // depth
    float nearest;
    uint slices;     // bit i: slice i holds a surface; 0: there is no surface
};
const uint kSliceBits = 5u;
const uint kSlices = 32u;
const uint kSlicesPerOctaveBits = 2u;

// Lights [first, first + count) of the table are looked at. A list has parts, those of 8^rootLevel lights each, so that no loop is too long
// for a driver; an invocation makes one of them.
struct ListPush {
    uint first;
    uint count;
    uint rootLevel;
    uint tiles;      // in all
};

// Counters of a frame, after those of prefix_sum.shared.h.
const uint kListLongest = kResultCount;      // list, over all its parts
const uint kListAllEntries = kListLongest + 1u;  // of all pages; their high half is next
const uint kListAllEntriesHigh = kListLongest + 2u;
const uint kListFound = kListLongest + 3u;   // lists: tiles, or clusters
const uint kListCounters = kListLongest + 4u;

SHARED_FN uint tilesAcross(uint pixels, uint tileSize) { return (pixels + tileSize - 1u) / tileSize; }
SHARED_END
#endif
