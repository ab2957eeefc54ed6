// The hierarchy over the lights: a tree that no pointer is stored of. Read by both compilers.
#ifndef LUCIOLE_LIGHT_TREE_SHARED_H
#define LUCIOLE_LIGHT_TREE_SHARED_H
#include "shared.h"
SHARED_BEGIN
// Lights that are neighbours in the table are neighbours in space. Node i of level l encloses lights [8^l i, 8^l (i + 1)) of the table;
// level 0 are the lights themselves, the highest level has a root for every 8^5 of them. A node is a ball in world space, a texel: its
// centre and its radius. They lie in an image, row by row, each followed by its children and theirs: who goes through the tree depth first
// finds the next node right behind, or, if it leaves one out, treeSize further on.
//     level 2   |              0              | ...
//     level 1   |      0       |      1       | ...        16 / 8 + 16 / 64 + ... = 2.3 bytes a light
//     lights    0 1 2 3 4 5 6 7 8 9 ...
const uint kTreeBits = 3u;
const uint kTreeLevels = 5u;
const uint kTreeWidth = 2048u;  // texels of a row

// Nodes of a tree below a node of `level` >= 1, itself included: (8^level - 1) / 7.
SHARED_FN uint treeSize(uint level) { return ((1u << (kTreeBits * level)) - 1u) / 7u; }
// Where the node of `level` >= 1 that encloses a light lies.
SHARED_FN uint treePlace(uint level, uint light) {
    uint place = (light >> (kTreeBits * kTreeLevels)) * treeSize(kTreeLevels);
    for (uint l = level; l < kTreeLevels; ++l) place += 1u + (light >> (kTreeBits * l) & 7u) * treeSize(l);
    return place;
}
SHARED_END
#endif
