#include "render/lighting/forward.hpp"
#include "render/lighting/light_lists.hpp"
#include "render/lighting/light_lists.shared.h"
#include "render/lighting/prefix_sum.hpp"
#include "render/lighting/tiled_points.shared.h"

namespace luciole::render {

using frame::Access;
using frame::BufferId;
using frame::PassContext;
using namespace shared;

namespace {

void addBatches(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum, const LightLists& lists, bool first) {
    const std::string name = in.phase + in.settings.lighting;
    const uint32_t most = kBatchTexels / texelsOfLight(in.constants[kConstantLights]);
    const uint64_t entries = graph.resources()[lists.entries.index].bytes() / 4;
    const uint32_t counted = lists.tileCount * kBatchSizes;
    const BufferId counts = graph.createBuffer("tiled-points.counts", counted * 4ull), places = graph.createBuffer("tiled-points.places", (counted + 1) * 4ull),
                   result = graph.createBuffer("tiled-points.result", kResultCount * 4),
                   batches = graph.createBuffer("tiled-points.batches", (entries / most + lists.tileCount) * sizeof(Batch)),
                   draws = graph.createBuffer("tiled-points.draws", kBatchSizes * sizeof(PointDraw));
    std::vector<uint32_t> constants = in.constants;
    constants.insert(constants.end(), {lists.tileSize, lists.parts, most, first});
    const uint32_t groups = (lists.tileCount + 63) / 64;
    graph.addPass(name + ".zero").write(result, Access::transferWrite).record([result](PassContext& pass) {
        pass.commands.fillBuffer(pass.buffer(result), 0, VK_WHOLE_SIZE, 0);
    });
    graph.addPass(name + ".batches")
        .read(lists.tiles, Access::computeStorageRead, kListTiles)
        .read(lists.offsets, Access::computeStorageRead, kListOffsets)
        .write(counts, Access::computeStorageWrite, kBatchCounts)
        .record([constants, groups](PassContext& pass) { pass.dispatch("render/lighting/tiled_batches.comp", constants, groups); });
    addPrefixSum(graph, name + ".", {.counts = counts, .places = places, .result = result, .most = counted, .size = addKnownSize(graph, counted)});
    graph.addPass(name + ".batches")
        .read(lists.offsets, Access::computeStorageRead, kListOffsets)
        .read(places, Access::computeStorageRead, kBatchPlaces)
        .write(batches, Access::computeStorageWrite, kBatches)
        .write(draws, Access::computeStorageWrite, kBatchDraws)
        .record([constants, groups](PassContext& pass) { pass.dispatch("render/lighting/tiled_batches.comp+FILL", constants, groups); });
    auto pass = graph.addPass(name);
    in.readBy(pass);
    pass.read(batches, Access::fragmentStorageRead, kBatches).read(lists.entries, Access::fragmentStorageRead, kListEntries).read(draws, Access::indirectRead);
    first ? pass.clear(sum, Access::colorBlend, vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f)) : pass.update(sum, Access::colorBlend);
    pass.record([frame = in.constants, tileSize = lists.tileSize, most, draws](PassContext& context) {
        const vk::Extent2D extent = context.extent();
        const auto whole = [&](uint32_t pixels) { return float(tilesAcross(pixels, tileSize) * tileSize); };
        context.commands.setViewport(0, vk::Viewport{0, 0, whole(extent.width), whole(extent.height), 0, 1});
        for (uint32_t size = 0; size < kBatchSizes; ++size) {
            std::vector<uint32_t> drawn = frame;
            drawn.insert(drawn.end(), {tileSize, batchLights(size, most)});
            context.bind({.vertex = "render/lighting/tiled_points.vert", .fragment = "render/lighting/tiled_points.frag", .points = true, .blend = gpu::Blend::add, .constants = drawn});
            context.drawIndirect(draws, size * sizeof(PointDraw));
        }
    });
}

}  // namespace

// Tiled shading with each tile's lights brought along instead of looked up.
void addTiledPoints(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    addLightLists(graph, in, ListsOf::tiles, [&](const LightLists& lists, bool first, bool) { addBatches(graph, in, sum, lists, first); });
    addBlendedLoop(graph, in, sum);
}

}  // namespace luciole::render
