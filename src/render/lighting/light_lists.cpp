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
void addBlendedExtent(FrameGraph& graph, const LightingInputs& in, const std::string& name, uint32_t tileSize, BufferId blended) {
    addZero(graph, name + "zero", blended);
    graph.addPass(name + "blended")
        .read(in.depth, Access::depthTest)
        .update(blended, Access::fragmentStorageWrite, kListBlended)
        .record([&scene = in.scene, constants = in.constants, tileSize,
                 fragment = std::string("render/lighting/light_list_extent.frag") + (in.settings.msaa != Msaa::x1 ? "+MULTISAMPLED" : "")](PassContext& pass) {
            testDepth(pass, Surfaces::blended);
            scene.drawBlended(pass, {{.fragment = fragment, .frame = constants, .own = {tileSize}}});
        });
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

/// Adds a page's lists to the layers that show them.
void addListLayers(FrameGraph& graph, const LightingInputs& in, const LightLists& lists, bool first) {
    std::string fragment = "render/lighting/list_layers.frag";
    auto pass = graph.addPass("output.lists");
    pass.read(in.depth, Access::fragmentSampled, kListDepth);
    readLists(pass, lists);
    if (lists.clustered) fragment += "+CLUSTERED";
    if (in.settings.msaa != Msaa::x1) fragment += "+MULTISAMPLED";
    first ? pass.write(*in.listLayers, Access::colorWrite) : pass.update(*in.listLayers, Access::colorBlend);
    pass.record([fragment, first, constants = with(in.constants, {lists.tileSize, lists.parts, first})](PassContext& context) {
        context.bind({.vertex = "render/shaders/full_screen.vert", .fragment = fragment, .blend = first ? gpu::Blend::replace : gpu::Blend::add, .constants = constants});
        context.drawFullScreen();
    });
}

/// What the loop over a list goes through, at most: lights, and triangles of the meshes that bound them.
struct LoopWork {
    uint64_t meshes = 0, triangles = 0;  ///< lights that a mesh bounds; of the largest mesh
    uint64_t rounds(uint64_t lights) const { return lights + std::min(lights, meshes) * triangles; }
};

LoopWork loopWork(const GpuScene& scene) {
    LoopWork work{.meshes = scene.lights().meshes};
    for (const VolumeConstants& mesh : scene.volumes().volumes) work.triangles = std::max<uint64_t>(work.triangles, mesh.vertexCount / 3);
    return work;
}

/// What the counters say of the frame.
std::optional<LightingAttempt> judge(LightListStats stats, LightingAttempt attempt, uint64_t largestBuffer, const LoopWork& work,
                                     std::span<const uint32_t> counters, FrameStats& frame) {
    stats.entries = uint64_t(counters[kListAllEntriesHigh]) << 32 | counters[kListAllEntries];
    stats.longest = counters[kListLongest];
    stats.lists = counters[kListFound];
    frame.lightLists = stats;
    const uint64_t needed = counters[kResultTotal];
    // The sum of all lengths is of 32 bits, as each length is.
    const bool mayOverflow = uint64_t(stats.lists) * stats.longest > ~0u;
    if (mayOverflow || work.rounds(stats.longest) > kLightsPerDraw) {
        attempt.slices *= 2;
        return attempt;
    }
    if (needed > attempt.entries) {
        // A quarter more, so that a moving view does not ask for more each time.
        attempt.entries = needed + needed / 4;
        if (attempt.entries * 4 > largestBuffer) attempt.slices *= 2, attempt.entries = largestBuffer / 4;
        return attempt;
    }
    return std::nullopt;
}

}  // namespace

void readLists(frame::PassBuilder& pass, const LightLists& lists) {
    pass.read(lists.tiles, Access::fragmentStorageRead, kListTiles)
        .read(lists.offsets, Access::fragmentStorageRead, kListOffsets)
        .read(lists.entries, Access::fragmentStorageRead, kListEntries);
    if (lists.clustered) pass.read(lists.firstClusters, Access::fragmentStorageRead, kListFirstClusters);
}

uint32_t tileSizeOf(const RenderSettings& settings) {
    switch (settings.tileSize) {
        case TileSize::n8: return 8;
        case TileSize::n32: return 32;
        default: return 16;
    }
}

std::vector<ListPage> listPages(uint32_t count, uint32_t pages, uint64_t mostParts) {
    const uint32_t each = std::max(1u, (count + pages - 1) / pages);
    uint32_t level = 0;
    while (level < kTreeLevels && 1u << (kTreeBits * (level + 1)) <= each) ++level;
    // A table that fits below one root is one part.
    if (level < kTreeLevels && pages == 1) ++level;
    const uint32_t part = 1u << (kTreeBits * level);
    const auto parts = uint32_t(std::min<uint64_t>((each + part - 1) / part, mostParts));
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
    const uint64_t samples = in.settings.msaa != Msaa::x1 ? 4 : 1;
    const auto mostLists = [&]() -> uint64_t {
        lists.tileCount = tilesAcross(extent.width, lists.tileSize) * tilesAcross(extent.height, lists.tileSize);
        if (!clustered) return lists.tileCount;
        const uint64_t clusters = uint64_t(lists.tileCount) * kSlices;
        return blends ? clusters : std::min(clusters, uint64_t(extent.width) * extent.height * samples);
    };
    // Where the lists of all parts begin has to fit a buffer, too: larger tiles, and then more pages of fewer parts, see to that.
    uint64_t most = mostLists();
    for (; (most + 1) * 4 > in.largestBuffer; most = mostLists()) lists.tileSize *= 2;
    const uint64_t mostParts = (in.largestBuffer / 4 - 1) / most;
    uint64_t bytes = 0;
    const auto createBuffer = [&](const std::string& what, uint64_t size) {
        bytes += size;
        return graph.createBuffer("light-lists." + what, size);
    };
    lists.tiles = createBuffer("tiles", lists.tileCount * sizeof(Tile));
    const BufferId counters = createBuffer("counters", kListCounters * 4);
    addZero(graph, name + "zero", counters);
    std::optional<BufferId> clusterCounts, clusters, extents;
    if (clustered) clusterCounts = createBuffer("clusters-by-tile", lists.tileCount * 4ull);
    if (blends) {
        extents = createBuffer("blended", lists.tileCount * 8ull);
        addBlendedExtent(graph, in, name, lists.tileSize, *extents);
    }
    addTiles(graph, in, name, lists, clusterCounts, extents);
    BufferId size = addKnownSize(graph, lists.tileCount);
    if (clustered) {
        lists.firstClusters = createBuffer("first-clusters", (lists.tileCount + 1) * 4ull);
        clusters = createBuffer("clusters", most * 4);
        const BufferId found = createBuffer("found", kResultCount * 4);
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
    const std::vector<ListPage> pages = listPages(in.scene.lightCount(), attempt.slices, mostParts);
    lists.pages = uint32_t(pages.size());
    for (const ListPage& page : pages) {
        lists.parts = page.parts;
        const BufferId counts = createBuffer("counts", most * page.parts * 4);
        lists.offsets = createBuffer("offsets", (most * page.parts + 1) * 4);
        lists.entries = createBuffer("entries", attempt.entries * 4);
        addLists(graph, in, name, lists, clusters, page, most, counts, counters, false);
        addPrefixSum(graph, name, {.counts = counts, .places = lists.offsets, .result = counters, .most = most * page.parts, .size = size, .factor = page.parts});
        addLists(graph, in, name, lists, clusters, page, most, counts, counters, true);
        if (in.listLayers) addListLayers(graph, in, lists, &page == &pages.front());
        addShading(lists, &page == &pages.front(), &page == &pages.back());
    }
    if (!in.report) return;
    graph.output(counters);
    in.report->counters = counters;
    const LightListStats stats{.tileSize = lists.tileSize, .pages = uint32_t(pages.size()), .bytes = bytes};
    in.report->judge = [=, largest = in.largestBuffer, work = loopWork(in.scene)](std::span<const uint32_t> counted, FrameStats& frame) {
        return judge(stats, attempt, largest, work, counted, frame);
    };
}

}  // namespace luciole::render
