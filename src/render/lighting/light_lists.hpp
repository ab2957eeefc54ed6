#pragma once
#include "render/lighting/techniques.hpp"

/// Lists of lights by tile or by cluster, of any length, in the order of the table of lights.
namespace luciole::render {

struct LightLists {
    frame::BufferId tiles;
    bool clustered;
    frame::BufferId firstClusters = {};  ///< if they are clustered
    frame::BufferId offsets, entries;
    uint32_t tileSize;  ///< pixels
    uint32_t tileCount;
    uint32_t parts;     ///< of each list, one after the other
    uint32_t pages;     ///< of the table of lights, with lists of its own each
};

enum class ListsOf { tiles, clusters };

/// Pixels a side of a tile.
uint32_t tileSizeOf(const RenderSettings& settings);

/// The lights that the lists of one page hold, and how a page is cut.
struct ListPage {
    uint32_t first, count;  ///< in the table of lights
    uint32_t rootLevel;     ///< light_tree.shared.h; `first` is a multiple of 8^rootLevel
    uint32_t parts;         ///< of 8^rootLevel lights, that make up `count`
};

/// Lights [0, count) as at least `pages` pages, each cut into parts, `mostParts` or fewer, that a loop can go through.
std::vector<ListPage> listPages(uint32_t count, uint32_t pages, uint64_t mostParts);

/// Declares that a pass's fragment shaders read lists (light_lists.glsl).
void readLists(frame::PassBuilder& pass, const LightLists& lists);

/// Adds, page by page, what makes the lists and what `addShading` adds to use them. The light that is there without lights belongs to the
/// first page. Lists that find no room are counted; the frame's report asks for another attempt then. Clusters hold surfaces that blend,
/// too.
void addLightLists(frame::FrameGraph& graph, const LightingInputs& in, ListsOf which,
                   const std::function<void(const LightLists& lists, bool first, bool last)>& addShading);

}  // namespace luciole::render
