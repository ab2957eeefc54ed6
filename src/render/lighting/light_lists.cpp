#include "render/lighting/light_lists.hpp"

#include <algorithm>

#include "render/lighting/forward.hpp"
#include "render/lighting/light_lists.shared.h"
#include "render/lighting/light_tree.shared.h"
#include "render/lighting/prefix_sum.hpp"

namespace luciole::render {

using frame::Access;
using frame::BufferId;
using frame::FrameGraph;
using frame::PassContext;
using namespace shared;

namespace {

void addZero(FrameGraph& graph, const std::string& name, BufferId buffer) {
    graph.addPass(name).write(buffer, Access::transferWrite).record([buffer](PassContext& pass) {
        pass.commands.fillBuffer(pass.buffer(buffer), 0, VK_WHOLE_SIZE, 0);
    });
}

std::vector<uint32_t> with(std::vector<uint32_t> constants, std::initializer_list<uint32_t> more) {
    constants.insert(constants.end(), more);
    return constants;
}

/// Where surfaces that blend lie, by tile.
BufferId addBlendedExtent(FrameGraph& graph, const LightingInputs& in, const std::string& name, uint32_t tileSize, uint32_t tiles) {
    const BufferId blended = graph.createBuffer("light-lists.blended", tiles * 8ull);
    addZero(graph, name + "zero", blended);
    graph.addPass(name + "blended")
        .read(in.depth, Access::depthTest)
        .update(blended, Access::fragmentStorageWrite, kListBlended)
        .record([&scene = in.scene, constants = in.constants, tileSize,
                 fragment = std::string("render/lighting/light_list_extent.frag") + (in.settings.msaa != Msaa::x1 ? "+MULTISAMPLED" : "")](PassContext& pass) {
            testDepth(pass, Surfaces::blended);
            scene.drawBlended(pass, {{.fragment = fragment, .frame = constants, .own = {tileSize}}});
        });
    return blended;
}

void addTiles(FrameGraph& graph, const LightingInputs& in, const std::string& name, const LightLists& lists, std::optional<BufferId> clusterCounts,
              std::optional<BufferId> blended) {
    std::string shader = "render/lighting/light_tiles.comp";
    auto pass = graph.addPass(name + "tiles");
    pass.read(in.depth, Access::computeSampled, kListDepth).write(lists.tiles, Access::computeStorageWrite, kListTiles);
    if (clusterCounts) {
        shader += "+CLUSTERED";
        pass.write(*clusterCounts, Access::computeStorageWrite, kListCounts);
    }
    if (in.settings.msaa != Msaa::x1) shader += "+MULTISAMPLED";
    if (blended) {
        shader += "+BLENDED";
        pass.read(*blended, Access::computeStorageRead, kListBlended);
    }
    pass.record([shader, constants = with(in.constants, {lists.tileSize}), groups = (lists.tileCount + 63) / 64](PassContext& context) {
        context.dispatch(shader.c_str(), constants, groups);
    });
}

/// A page's lists, without places or with them.
void addLists(FrameGraph& graph, const LightingInputs& in, const std::string& name, const LightLists& lists, std::optional<BufferId> clusters,
              const ListPage& page, uint64_t mostLists, BufferId counts, BufferId counters, bool fill) {
    std::string shader = "render/lighting/light_lists.comp";
    auto pass = graph.addPass(name + (fill ? "fill" : "count"));
    pass.read(in.lights, Access::computeTableRead).read(lists.tiles, Access::computeStorageRead, kListTiles);
    if (clusters) {
        shader += "+CLUSTERED";
        pass.read(lists.firstClusters, Access::computeStorageRead, kListFirstClusters).read(*clusters, Access::computeStorageRead, kListClusters);
    }
    if (fill) {
        shader += "+FILL";
        pass.read(lists.offsets, Access::computeStorageRead, kListOffsets)
            .write(lists.entries, Access::computeStorageWrite, kListEntries)
            .update(counters, Access::computeStorageWrite, kListCounts);
    } else {
        pass.write(counts, Access::computeStorageWrite, kListCounts);
    }
    const ListPush push{page.first, page.count, page.rootLevel, lists.tileCount};
    pass.record([shader, push, constants = with(in.constants, {lists.tileSize, page.parts}),
                 groups = uint32_t((mostLists + 63) / 64) * page.parts](PassContext& context) {
        context.push(push);
        context.dispatch(shader.c_str(), constants, groups);
    });
}

/// What the counters say of the frame.
std::optional<LightingAttempt> judge(LightListStats stats, LightingAttempt attempt, uint64_t largestBuffer, std::span<const uint32_t> counters,
                                     FrameStats& frame) {
    stats.entries = counters[kListAllEntries];
    stats.longest = counters[kListLongest];
    stats.lists = counters[kListFound];
    frame.lightLists = stats;
    const uint64_t needed = counters[kResultTotal];
    if (needed > attempt.entries) {
        // A quarter more, so that a moving view does not ask for more each time.
        attempt.entries = needed + needed / 4;
        if (attempt.entries * 4 > largestBuffer) attempt.slices *= 2, attempt.entries = largestBuffer / 4;
        return attempt;
    }
    if (stats.longest > kLightsPerDraw) {
        attempt.slices *= 2;
        return attempt;
    }
    return std::nullopt;
}

}  // namespace

uint32_t tileSizeOf(const RenderSettings& settings) {
    switch (settings.tileSize) {
        case TileSize::n8: return 8;
        case TileSize::n32: return 32;
        default: return 16;
    }
}

std::vector<ListPage> listPages(uint32_t count, uint32_t pages) {
    const uint32_t each = std::max(1u, (count + pages - 1) / pages);
    uint32_t level = 0;
    while (level < kTreeLevels && 1u << (kTreeBits * (level + 1)) <= each) ++level;
    // A table that fits below one root is one part.
    if (level < kTreeLevels && pages == 1) ++level;
    const uint32_t part = 1u << (kTreeBits * level);
    const uint32_t parts = (each + part - 1) / part;
    std::vector<ListPage> result;
    for (uint32_t first = 0; first < count || first == 0; first += parts * part) {
        const uint32_t here = std::min(parts * part, count - first);
        result.push_back({first, here, level, std::max(1u, (here + part - 1) / part)});
    }
    return result;
}

void addLightLists(FrameGraph& graph, const LightingInputs& in, ListsOf which,
                   const std::function<void(const LightLists& lists, bool first, bool last)>& addShading) {
    const std::string name = in.phase + in.settings.lighting + ".";
    const vk::Extent2D extent = graph.descOf(in.depth).extent;
    const bool clustered = which == ListsOf::clusters;
    const bool blends = clustered && in.scene.hasBlended();
    LightLists lists{.clustered = clustered, .tileSize = tileSizeOf(in.settings)};
    lists.tileCount = tilesAcross(extent.width, lists.tileSize) * tilesAcross(extent.height, lists.tileSize);
    const uint64_t samples = in.settings.msaa != Msaa::x1 ? 4 : 1;
    const uint64_t most = clustered && !blends
                              ? std::min(uint64_t(lists.tileCount) * kSlices, uint64_t(extent.width) * extent.height * samples)
                              : uint64_t(lists.tileCount) * (clustered ? kSlices : 1);
    lists.tiles = graph.createBuffer("light-lists.tiles", lists.tileCount * sizeof(Tile));
    const BufferId counters = graph.createBuffer("light-lists.counters", kListCounters * 4);
    addZero(graph, name + "zero", counters);
    std::optional<BufferId> clusterCounts, clusters, extents;
    if (clustered) clusterCounts = graph.createBuffer("light-lists.clusters-by-tile", lists.tileCount * 4ull);
    if (blends) extents = addBlendedExtent(graph, in, name, lists.tileSize, lists.tileCount);
    addTiles(graph, in, name, lists, clusterCounts, extents);
    BufferId size = addKnownSize(graph, lists.tileCount);
    if (clustered) {
        lists.firstClusters = graph.createBuffer("light-lists.first-clusters", (lists.tileCount + 1) * 4ull);
        clusters = graph.createBuffer("light-lists.clusters", most * 4);
        const BufferId found = graph.createBuffer("light-lists.found", kResultCount * 4);
        addZero(graph, name + "zero", found);
        addPrefixSum(graph, name + "clusters.", {.counts = *clusterCounts, .places = lists.firstClusters, .result = found, .most = lists.tileCount, .size = size});
        graph.addPass(name + "clusters")
            .read(lists.tiles, Access::computeStorageRead, kListTiles)
            .read(lists.firstClusters, Access::computeStorageRead, kListFirstClusters)
            .write(*clusters, Access::computeStorageWrite, kListClusters)
            .record([constants = with(in.constants, {lists.tileSize}), groups = (lists.tileCount + 63) / 64](PassContext& pass) {
                pass.dispatch("render/lighting/light_clusters.comp", constants, groups);
            });
        size = found;
    }
    LightingAttempt attempt = in.attempt;
    const uint64_t usual = std::max<uint64_t>(uint64_t(lists.tileCount) * 64, 4096);
    if (attempt.entries == 0) attempt.entries = std::min<uint64_t>(usual, in.largestBuffer / 4);
    const std::vector<ListPage> pages = listPages(in.scene.lightCount(), attempt.slices);
    lists.pages = uint32_t(pages.size());
    uint64_t bytes = 0;
    for (const ListPage& page : pages) {
        lists.parts = page.parts;
        const BufferId counts = graph.createBuffer("light-lists.counts", most * page.parts * 4);
        lists.offsets = graph.createBuffer("light-lists.offsets", (most * page.parts + 1) * 4);
        lists.entries = graph.createBuffer("light-lists.entries", attempt.entries * 4);
        addLists(graph, in, name, lists, clusters, page, most, counts, counters, false);
        addPrefixSum(graph, name, {.counts = counts, .places = lists.offsets, .result = counters, .most = most * page.parts, .size = size, .factor = page.parts});
        addLists(graph, in, name, lists, clusters, page, most, counts, counters, true);
        addShading(lists, &page == &pages.front(), &page == &pages.back());
        for (const BufferId buffer : {counts, lists.offsets, lists.entries}) bytes += graph.resources()[buffer.index].bytes();
    }
    if (!in.report) return;
    for (const BufferId buffer : {lists.tiles, counters}) bytes += graph.resources()[buffer.index].bytes();
    graph.output(counters);
    in.report->counters = counters;
    const LightListStats stats{.tileSize = lists.tileSize, .pages = uint32_t(pages.size()), .bytes = bytes};
    in.report->judge = [=, largest = in.largestBuffer](std::span<const uint32_t> counted, FrameStats& frame) { return judge(stats, attempt, largest, counted, frame); };
}

}  // namespace luciole::render
