// The hierarchy over the lights: a tree that no pointer is stored of. Read by both compilers.
#ifndef LUCIOLE_LIGHT_TREE_SHARED_H
#define LUCIOLE_LIGHT_TREE_SHARED_H
#include "shared.h"
SHARED_BEGIN
// Lights that are neighbours in the table are neighbours in space. Node i of level l encloses lights [8^l i, 8^l (i + 1)) of the table;
// level 0 are the lights themselves, the highest level has a root for every 8^5 of them. A node is a ball in world space, a texel: its
// centre and its radius. Level by level they lie in rows of an image.
//     level 2   |              0              | ...
//     level 1   |      0       |      1       | ...        16 / 8 + 16 / 64 + ... = 2.3 bytes a light
//     lights    0 1 2 3 4 5 6 7 8 9 ...
const uint kTreeBits = 3u;
const uint kTreeLevels = 5u;
const uint kTreeWidth = 2048u;  // texels of a row
SHARED_FN uint treeNodes(uint level, uint lights) { return (lights + (1u << (kTreeBits * level)) - 1u) >> (kTreeBits * level); }
SHARED_FN uint treeFirst(uint level, uint lights) {
    uint first = 0u;
    for (uint l = 1u; l < level; ++l) first += treeNodes(l, lights);
    return first;
}
SHARED_END
#endif
