#include "render/lighting/light_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <luciole/error.hpp>

#include "render/lighting/forward.hpp"
#include "render/lighting/light_index_self_test.hpp"
#include "render/lighting/light_texels.shared.h"
#include "render/lighting/light_volumes.hpp"
#include "render/lighting/prefix_sum.hpp"

namespace luciole::render {

using frame::Access;
using frame::BufferId;
using frame::FrameGraph;
using frame::ImageId;
using frame::PassContext;

namespace {

constexpr shared::IndexPacking kNoPacking{
    .kind = shared::kPackedBits, .indexBits = 8, .entryBits = 8, .perPass = 1, .passes = 1, .images = 1, .unit = 255};

/// What all passes of a frame have in common.
struct Indexing {
    const LightingInputs& in;
    IndexLayout layout;
    IndexPlan plan;
    bool surfaces;         ///< lights that reach the surface, not all before it
    ImageId depth;         ///< that decides
    bool samples;          ///< an index for each sample
    bool guarded;          ///< the stencil counts a pixel's lights, so that those beyond the overlap change nothing
    ImageId numbers = {};  ///< else, unless sorted: of each pixel's lights, 255 and more as 255
    bool counted() const { return !guarded && !layout.sorted; }
    /// Trebilco 2009, "Buffer Sharing": the light buffer is the index image.
    bool shared() const { return in.settings.lidrShare && !in.counting(); }
    BufferId order, shapes, counters;
    uint32_t shadowed = shared::kIndexLitOrNot;
    bool soft = false;  ///< a second set of images has how much of each light arrives
    std::vector<ImageId> tables = {};  ///< of light data, if surfaces read it out of textures

    /// Specialization constants of the passes that draw lights.
    std::vector<uint32_t> drawConstants(bool shares = false) const {
        const shared::IndexPacking& p = layout.packing;
        std::vector<uint32_t> constants = in.constants;
        constants.insert(constants.end(), {p.kind, p.indexBits, p.entryBits, p.perPass, p.passes, p.images, p.unit,
                                           uint32_t(surfaces), uint32_t(plan.remapped), uint32_t(guarded), shares ? shared::kIndexShare : shadowed});
        return constants;
    }
};

/// Declares what light_index.vert and light_index_draw.glsl read.
void readByLights(frame::PassBuilder& pass, const Indexing& x) {
    x.in.readLightsBy(pass);
    pass.read(x.depth, Access::fragmentSampled, shared::kIndexDepth)
        .read(x.order, Access::fragmentStorageRead, shared::kIndexOrder)
        .read(x.shapes, Access::fragmentStorageRead, shared::kIndexShapes);
}

/// Draws the volumes of a slice of the order (light_index.vert). Blending and the stencil are the caller's.
void drawLights(PassContext& pass, const GpuScene& scene, shared::LightSlice slice, bool surfaces) {
    if (slice.count == 0) return;
    pass.commands.bindIndexBuffer(scene.volumeIndices(), 0, vk::IndexType::eUint32);
    setFaces(pass, !surfaces);
    pass.push(slice);
    pass.drawIndexed(shared::volumeIndexCount(shared::kIndexLod), slice.count,
                     shared::volumeFirstIndex(shared::kIndexLod), 0, 0);
}

BufferId addShapes(FrameGraph& graph, const LightingInputs& in) {
    const uint32_t count = in.scene.lightCount();
    const BufferId shapes = graph.createBuffer("light-index.shapes", count * 4ull);
    graph.addPass(in.phase + "light-indexed.shapes")
        .read(in.lights, Access::computeTableRead)
        .write(shapes, Access::computeStorageWrite, shared::kIndexShapes)
        .record([constants = in.constants, groups = (count + 63) / 64](PassContext& pass) {
            if (groups > 0) pass.dispatch("render/lighting/light_index_shapes.comp", constants, groups);
        });
    return shapes;
}

void addZero(FrameGraph& graph, const std::string& name, BufferId buffer) {
    graph.addPass(name).write(buffer, Access::transferWrite).record([buffer](PassContext& pass) {
        pass.commands.fillBuffer(pass.buffer(buffer), 0, VK_WHOLE_SIZE, 0);
    });
}

/// The farthest of each pixel's samples, for lights before any of them (Trebilco 2009, "MSAA Technique 2").
ImageId addFarthestDepth(FrameGraph& graph, const LightingInputs& in) {
    const ImageId farthest =
        graph.createImage("depth.farthest", {graph.descOf(in.depth).format, graph.descOf(in.depth).extent});
    graph.addPass(in.phase + "light-indexed.farthest-depth")
        .read(in.depth, Access::fragmentSampled, shared::kIndexDepth)
        .clear(farthest, Access::depthWrite, vk::ClearDepthStencilValue{0.0f, 0})
        .record([](PassContext& pass) {
            pass.bind(
                {.vertex = "render/shaders/full_screen.vert", .fragment = "render/lighting/light_index_farthest.frag"});
            pass.depth(vk::CompareOp::eAlways, true);
            pass.drawFullScreen();
        });
    return farthest;
}

/// Lights of a pixel are counted in its stencil, and those from `first` on, `count` of them, are let through.
void guard(PassContext& pass, uint32_t first, uint32_t count) {
    const auto faces = vk::StencilFaceFlagBits::eFrontAndBack;
    pass.commands.clearAttachments(vk::ClearAttachment{.aspectMask = vk::ImageAspectFlagBits::eStencil},
                                   vk::ClearRect{.rect = {{}, pass.extent()}, .layerCount = 1});
    pass.commands.setStencilTestEnable(true);
    pass.commands.setStencilReference(faces, first);
    pass.commands.setStencilCompareMask(faces, 0xff & ~(count - 1));
    pass.stencil(faces, {.compare = vk::CompareOp::eEqual,
                         .fail = vk::StencilOp::eIncrementAndClamp,
                         .pass = vk::StencilOp::eIncrementAndClamp});
}

/// Step 2 (Trebilco 2009): light volumes write light indices. Fills `images` with one round of the plan.
/// \param shares how much of each light arrives, instead of its index
void addIndexPasses(FrameGraph& graph, const Indexing& x, const IndexRound& round, const std::vector<ImageId>& images, bool shares = false) {
    const shared::IndexPacking& packing = x.layout.packing;
    const gpu::Blend blend = packing.kind == shared::kPackedBits       ? gpu::Blend::shift
                             : packing.kind == shared::kPackedExtremes ? gpu::Blend::max
                                                                       : gpu::Blend::replace;
    std::vector<bool> cleared(images.size());
    // Draws into the same images are one pass.
    for (size_t begin = 0, end = 0; begin < round.size(); begin = end) {
        const IndexDraw& first = round[begin];
        while (end < round.size() && round[end].firstImage == first.firstImage) ++end;
        const std::vector<IndexDraw> draws(round.begin() + ptrdiff_t(begin), round.begin() + ptrdiff_t(end));
        auto pass = graph.addPass(x.in.phase + (shares ? "light-indexed.shadows" : "light-indexed.index"));
        readByLights(pass, x);
        if (x.guarded)
            pass.update(x.depth, Access::stencilWrite);
        else
            pass.read(x.depth, Access::depthTest);
        for (uint32_t i = first.firstImage; i < first.firstImage + first.images; ++i) {
            pass.clear(images[i], Access::colorBlend, vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f));
            cleared[i] = true;
        }
        if (x.counted()) pass.clear(x.numbers, Access::colorBlend, vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f));
        std::string fragment = "render/lighting/light_index.frag";
        if (first.images > 1) fragment += first.images > 2 ? "+FOUR" : "+TWO";
        if (x.counted()) fragment += "+COUNTED";
        if (x.samples) fragment += "+MULTISAMPLED";
        pass.record([&scene = x.in.scene, draws, fragment, blend, packing, guarded = x.guarded, counted = x.counted(),
                     surfaces = x.surfaces, constants = x.drawConstants(shares)](PassContext& context) {
            // Moves what is there down by the digits of one index.
            const float shift = blendShift(packing);
            context.commands.setBlendConstants(std::array{shift, shift, shift, shift}.data());
            for (const IndexDraw& draw : draws) {
                context.bind({.vertex = "render/lighting/light_index.vert",
                              .fragment = fragment,
                              .blend = blend,
                              .lastAdds = counted,
                              .channels = draw.channels,
                              .depthClamp = clampsDepth(scene),
                              .constants = constants});
                if (guarded) guard(context, draw.pass * packing.perPass, packing.perPass);
                drawLights(context, scene, draw.slice, surfaces);
            }
        });
    }
    for (uint32_t i = 0; i < images.size(); ++i)
        if (!cleared[i])
            graph.addPass(x.in.phase + "light-indexed.clear")
                .clear(images[i], Access::colorWrite, vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f));
}

/// Declares the index images as those of one set.
void readImages(frame::PassBuilder& pass, const std::vector<ImageId>& images, uint32_t slot) {
    for (uint32_t i = 0; i < 4; ++i)
        pass.read(images[std::min<size_t>(i, images.size() - 1)], Access::fragmentSampled, slot + i);
}

/// Counts the pixels that are hit by more lights than fit.
void addSaturated(FrameGraph& graph, const Indexing& x) {
    std::string fragment = "render/lighting/light_index_saturated.frag";
    if (x.counted()) fragment += "+COUNTED";
    if (x.samples) fragment += "+MULTISAMPLED";
    auto pass = graph.addPass(x.in.phase + "light-indexed.saturated");
    if (x.counted())
        pass.read(x.numbers, Access::fragmentSampled, shared::kIndexImages).read(x.depth, Access::depthTest);
    else
        pass.update(x.depth, Access::stencilWrite);
    pass.update(x.counters, Access::fragmentStorageWrite, shared::kIndexCounters)
        .record([fragment, overlap = x.layout.overlap, stencil = x.guarded](PassContext& context) {
            context.bind({.vertex = "render/shaders/full_screen.vert", .fragment = fragment});
            context.push(overlap);
            context.commands.setStencilTestEnable(stencil);
            context.commands.setStencilReference(vk::StencilFaceFlagBits::eFrontAndBack, overlap);
            context.stencil(vk::StencilFaceFlagBits::eFrontAndBack, {.compare = vk::CompareOp::eLess});
            context.drawFullScreen();
        });
}

/// Finds out which lights the images lack, and where.
void addLost(FrameGraph& graph, const Indexing& x, const std::vector<ImageId>& images,
             std::vector<shared::LightSlice> slices) {
    const vk::Extent2D extent = graph.descOf(x.depth).extent;
    const BufferId seen =
        graph.createBuffer("light-index.seen", uint64_t(extent.width) * extent.height * (x.samples ? 4 : 1) * 4);
    addZero(graph, x.in.phase + "light-indexed.zero", seen);
    auto pass = graph.addPass(x.in.phase + "light-indexed.lost");
    readByLights(pass, x);
    readImages(pass, images, shared::kIndexImages);
    readImages(pass, images, shared::kIndexMoreImages);
    const std::string fragment =
        std::string("render/lighting/light_index_lost.frag") + (x.samples ? "+INDEXSAMPLES+MULTISAMPLED" : "");
    pass.read(x.depth, Access::depthTest)
        .update(x.counters, Access::fragmentStorageWrite, shared::kIndexCounters)
        .update(seen, Access::fragmentStorageWrite, shared::kIndexOffsets)
        .record([&scene = x.in.scene, fragment, slices, surfaces = x.surfaces,
                 constants = x.drawConstants()](PassContext& context) {
            context.bind({.vertex = "render/lighting/light_index.vert",
                          .fragment = fragment,
                          .depthClamp = clampsDepth(scene),
                          .constants = constants});
            for (const shared::LightSlice& slice : slices) drawLights(context, scene, slice, surfaces);
        });
}

uint32_t tableRows(const Indexing& x) { return (x.in.scene.lightCount() + 256) / 256; }  // the null light is one more

/// Light data as textures, 256 lights a row, a block of rows of colours for each class of objects.
void addTables(FrameGraph& graph, Indexing& x) {
    using namespace shared;
    const LightingInputs& in = x.in;
    const uint32_t rows = tableRows(x);
    const auto classes =
        (in.constants[kConstantLights] & kUsesLinks) != 0 ? uint32_t(in.scene.objectClasses().objectOfClass.size()) : 1;
    const bool all = texelsOfLight(in.constants[kConstantLights]) > 2;
    const auto image = [&](const char* name, uint32_t blocks) {
        return graph.createImage(name, {vk::Format::eR32G32B32A32Sfloat, {256, rows * blocks}});
    };
    x.tables = {image("light-table.positions", 1), image("light-table.colors", classes)};
    if (all)
        for (const char* name : {"light-table.directions", "light-table.kinds", "light-table.rows"})
            x.tables.push_back(image(name, 1));
    const BufferId objects = graph.createConstantBuffer("light-table.objects", in.scene.objectClasses().objectOfClass);
    std::vector<uint32_t> constants = in.constants;
    constants.insert(constants.end(), {rows, uint32_t(x.plan.remapped)});
    for (const bool colors : {false, true}) {
        auto pass = graph.addPass(in.phase + (colors ? "light-indexed.colors" : "light-indexed.tables"));
        pass.read(in.lights, Access::tableRead)
            .read(x.order, Access::fragmentStorageRead, kIndexOrder)
            .read(objects, Access::fragmentStorageRead, kIndexShapes);
        for (uint32_t i = 0; i < x.tables.size(); ++i)
            if ((i == 1) == colors) pass.write(x.tables[i], Access::colorWrite);
        const std::string fragment = std::string("render/lighting/light_tables.frag") + (colors ? "+COLORS"
                                                                                         : all  ? "+ALL"
                                                                                                : "");
        pass.record([fragment, constants](PassContext& context) {
            context.bind({.vertex = "render/shaders/full_screen.vert", .fragment = fragment, .constants = constants});
            context.drawFullScreen();
        });
    }
}

/// Specialization constants of forward_indexed.frag.
std::vector<uint32_t> surfaceConstants(const Indexing& x, uint32_t sets) {
    const shared::IndexPacking& p = x.layout.packing;
    return {
        p.kind,      p.indexBits, p.entryBits, p.perPass, p.passes, p.images, p.unit, sets, uint32_t(x.plan.remapped),
        tableRows(x), uint32_t(x.soft)};
}

/// The same with the indices in `sum`: each pixel is read once, before it is written; of surfaces that coincide the
/// first one drawn is seen, as the stencil sees to.
void addSharedSurfaces(FrameGraph& graph, const Indexing& x, ImageId sum) {
    if (!x.counted())
        graph.addPass(x.in.phase + "light-indexed.clear")
            .clear(x.numbers, Access::colorWrite, vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f));
    auto pass = graph.addPass(x.in.phase + "light-indexed.surfaces");
    x.in.readLightsBy(pass);
    pass.update(x.in.depth, Access::stencilWrite)
        .update(sum, Access::colorFeedback, shared::kIndexImages)
        .read(x.order, Access::fragmentStorageRead, shared::kIndexOrder);
    for (const uint32_t slot : {1u, 2u, 3u})
        pass.read(x.numbers, Access::fragmentSampled, shared::kIndexImages + slot);  // not looked at
    readImages(pass, {x.numbers}, shared::kIndexMoreImages);
    SurfaceShading shading =
        forwardShading(x.in, "render/lighting/forward_indexed.frag", Surfaces::opaque, true, surfaceConstants(x, 1));
    shading.slice = x.plan.rest;
    pass.record([&scene = x.in.scene, shading](PassContext& context) {
        testDepth(context, Surfaces::opaque);
        guard(context, 0, 1);
        scene.drawSurfaces(context, shading);
    });
}

/// Step 3: surfaces look their lights up.
void addSurfaces(FrameGraph& graph, const Indexing& x, ImageId sum, const std::vector<std::vector<ImageId>>& images,
                 const std::vector<ImageId>& shares, Surfaces which, bool first) {
    if (x.shared()) return addSharedSurfaces(graph, x, sum);
    auto [pass, target] =
        addForwardPass(graph, x.in, sum,
                       which == Surfaces::blended ? "light-indexed.blended" : "light-indexed.surfaces", which, first);
    readImages(pass, images.front(), shared::kIndexImages);
    readImages(pass, x.soft ? shares : images.back(), shared::kIndexMoreImages);
    pass.read(x.order, Access::fragmentStorageRead, shared::kIndexOrder);
    std::string fragment = "render/lighting/forward_indexed.frag";
    if (!x.tables.empty()) {
        fragment += "+TABLES";
        for (uint32_t i = 0; i < 5; ++i)
            pass.read(x.tables[i < x.tables.size() ? i : 0], Access::fragmentSampled, shared::kIndexTables + i);
        pass.read(graph.createConstantBuffer("light-table.classes", x.in.scene.objectClasses().classOfObject),
                  Access::fragmentStorageRead, shared::kIndexShapes);
    }
    if (x.samples) fragment += "+INDEXSAMPLES";
    SurfaceShading shading = forwardShading(x.in, fragment, which, first, surfaceConstants(x, uint32_t(images.size())));
    if (first) shading.slice = x.plan.rest;
    pass.record([&scene = x.in.scene, shading, which](PassContext& context) {
        testDepth(context, which);
        which == Surfaces::blended ? scene.drawBlended(context, {shading}) : scene.drawSurfaces(context, shading);
    });
    addToSum(graph, x.in, target, sum);
}

void addImages(FrameGraph& graph, Indexing& x, ImageId sum) {
    const LightingInputs& in = x.in;
    const frame::ImageDesc desc{x.layout.format, graph.descOf(x.depth).extent, graph.descOf(x.depth).samples};
    std::vector<std::vector<ImageId>> images(x.plan.sets.size());
    x.numbers = graph.createImage("light-index.numbers", {vk::Format::eR8Unorm, desc.extent, desc.samples});
    for (auto& set : images)
        for (uint32_t i = 0; i < x.layout.imageCount(); ++i)
            set.push_back(x.shared() ? sum : graph.createImage("light-index", desc));
    std::vector<ImageId> shares;
    for (uint32_t i = 0; x.soft && i < x.layout.imageCount(); ++i) shares.push_back(graph.createImage("light-index-shadows", desc));
    for (size_t r = 0; r < x.plan.rounds(); ++r) {
        for (size_t s = 0; s < images.size(); ++s) {
            const auto& rounds = x.plan.sets[s];
            const IndexRound round = r < rounds.size() ? rounds[r] : IndexRound{};
            if (x.soft) addIndexPasses(graph, x, round, shares, true);
            addIndexPasses(graph, x, round, images[s]);
            if (in.report && !x.layout.sorted && !in.attempt.report) addSaturated(graph, x);
            if (in.report && in.attempt.report) {
                std::vector<shared::LightSlice> slices;
                if (!round.empty()) slices.push_back(round.front().slice);
                if (x.layout.sorted) slices.clear();  // none of those that were drawn is lost
                if (s == 0 && r == 0) slices.push_back(x.plan.dropped);
                addLost(graph, x, images[s], slices);
            }
        }
        addSurfaces(graph, x, sum, images, shares, Surfaces::opaque, r == 0);
    }
    if (!in.scene.hasBlended()) return;
    x.surfaces ? addBlendedLoop(graph, in, sum) : addSurfaces(graph, x, sum, images, shares, Surfaces::blended, true);
}

/// Per-pixel lists of any length: count, place, fill, sort; slice by slice of the lights, each followed by what `addShading` adds.
void addLists(FrameGraph& graph, const Indexing& x, uint32_t slices, uint64_t capacity, const AddPixelShading& addShading) {
    const LightingInputs& in = x.in;
    const vk::Extent2D extent = graph.descOf(x.depth).extent;
    const uint32_t pixels = extent.width * extent.height;
    const BufferId counts = graph.createBuffer("light-index.counts", pixels * 4ull),
                   offsets = graph.createBuffer("light-index.offsets", (pixels + 1) * 4ull);
    const BufferId entries = graph.createBuffer("light-index.entries", capacity * 4);
    const BufferId size = addKnownSize(graph, pixels);
    const auto indexed = uint32_t(x.plan.order.size()) - x.plan.rest.count;
    const std::string name = in.phase + "light-indexed.";
    const auto addRaster = [&](const std::string& what, shared::LightSlice slice) {
        auto pass = graph.addPass(name + what);
        readByLights(pass, x);
        pass.read(x.depth, Access::depthTest).update(counts, Access::fragmentStorageWrite, shared::kIndexCounts);
        if (what == "fill")
            pass.read(offsets, Access::fragmentStorageRead, shared::kIndexOffsets)
                .write(entries, Access::fragmentStorageWrite, shared::kIndexEntries);
        pass.record([&scene = in.scene, slice, shader = "render/lighting/light_index_" + what + ".frag",
                     surfaces = x.surfaces, constants = x.drawConstants()](PassContext& context) {
            context.bind({.vertex = "render/lighting/light_index.vert",
                          .fragment = shader,
                          .depthClamp = clampsDepth(scene),
                          .constants = constants});
            drawLights(context, scene, slice, surfaces);
        });
    };
    for (uint32_t s = 0; s < slices; ++s) {
        const auto from = uint32_t(uint64_t(indexed) * s / slices), to = uint32_t(uint64_t(indexed) * (s + 1) / slices);
        const shared::LightSlice slice{from, to - from};
        addZero(graph, name + "zero", counts);
        addRaster("count", slice);
        addPrefixSum(graph, name,
                     {.counts = counts,
                      .places = offsets,
                      .result = x.counters,
                      .most = pixels,
                      .size = size,
                      .capacity = x.layout.overlap});
        addRaster("fill", slice);
        graph.addPass(name + "sort")
            .read(offsets, Access::computeStorageRead, shared::kIndexOffsets)
            .update(entries, Access::computeStorageWrite, shared::kIndexEntries)
            .record([constants = in.constants, groups = (pixels + 63) / 64](PassContext& context) {
                context.dispatch("render/lighting/light_index_sort.comp", constants, groups);
            });
        addShading({offsets, entries}, s == 0);
    }
}

/// Step 3 with per-pixel lists.
void addListedSurfaces(FrameGraph& graph, const Indexing& x, ImageId sum, const PixelLists& lists, Surfaces which, bool first) {
    auto [pass, target] =
        addForwardPass(graph, x.in, sum, which == Surfaces::blended ? "light-indexed.blended" : "light-indexed.surfaces", which, first);
    pass.read(x.order, Access::fragmentStorageRead, shared::kIndexOrder)
        .read(lists.offsets, Access::fragmentStorageRead, shared::kIndexOffsets)
        .read(lists.entries, Access::fragmentStorageRead, shared::kIndexEntries);
    SurfaceShading shading = forwardShading(x.in, "render/lighting/forward_listed.frag", which, first);
    if (first) shading.slice = x.plan.rest;
    pass.record([&scene = x.in.scene, shading, which](PassContext& context) {
        testDepth(context, which);
        which == Surfaces::blended ? scene.drawBlended(context, {shading}) : scene.drawSurfaces(context, shading);
    });
    addToSum(graph, x.in, target, sum);
}

void addListed(FrameGraph& graph, const Indexing& x, ImageId sum, uint32_t slices, uint64_t capacity) {
    const bool blends = x.in.scene.hasBlended(), blendsByLists = blends && !x.surfaces && slices == 1;
    addLists(graph, x, slices, capacity, [&](const PixelLists& lists, bool first) {
        addListedSurfaces(graph, x, sum, lists, Surfaces::opaque, first);
        if (blendsByLists) addListedSurfaces(graph, x, sum, lists, Surfaces::blended, true);
    });
    if (blends && !blendsByLists) addBlendedLoop(graph, x.in, sum);
}

/// Adds what lights are drawn from once there is a plan, and the counters, with `words` more after them.
void addDrawing(FrameGraph& graph, Indexing& x, uint64_t words = 0) {
    x.order = graph.createConstantBuffer("light-index.order", x.plan.order);
    x.shapes = addShapes(graph, x.in);
    x.counters = graph.createBuffer("light-index.counters", (shared::kCounterCount + words) * 4);
    addZero(graph, x.in.phase + "light-indexed.zero", x.counters);
}

/// The report of a frame, which its counters go to.
void report(FrameGraph& graph, const Indexing& x, LightIndexFrame frame) {
    graph.output(x.counters);
    x.in.report->counters = x.counters;
    x.in.report->judge = [frame = std::move(frame)](std::span<const uint32_t> counters, FrameStats& stats) {
        return judge(frame, counters, stats.lightIndex.emplace());
    };
}

/// Entries that lists have room for.
uint64_t listCapacity(const FrameGraph& graph, const LightingInputs& in) {
    const vk::Extent2D extent = graph.descOf(in.depth).extent;
    return in.attempt.entries ? in.attempt.entries : uint64_t(extent.width) * extent.height * 8;
}

}  // namespace

void addLightIndexed(FrameGraph& graph, const LightingInputs& in, ImageId sum) {
    const RenderSettings& settings = in.settings;
    const uint32_t lights = in.scene.lightCount();
    const bool multisampled = settings.msaa != Msaa::x1;
    const bool exact = settings.onOverflow == OnOverflow::exact;
    bool list = settings.lidrPacking == LidrPacking::list || in.attempt.list;
    std::optional<IndexLayout> layout;
    if (settings.lidrPacking != LidrPacking::list) layout = indexLayout(settings, lights);
    if (layout && layout->mostIndex < lights && exact) list = true;

    const bool surfaces = settings.lidrCover == LidrCover::surface ||
                          (settings.lidrCover == LidrCover::automatic && !in.scene.hasBlended());
    if (settings.lidrShare && (!surfaces || multisampled || settings.lidrTypes == LidrTypes::targets ||
                               settings.lidrTables == LidrTables::textures))
        throw Error(ErrorKind::usage,
                    "lidr-share: expected lidr-cover surface, no surface that blends, msaa 1, one target for all "
                    "types, and lidr-tables buffers");
    const bool early = settings.shadows != Shadows::off && (settings.lidrShadows == LidrShadows::index || settings.lidrShadows == LidrShadows::indexSoft);
    const bool soft = early && settings.lidrShadows == LidrShadows::indexSoft;
    if (early && !(surfaces && !(list && multisampled)))
        throw Error(ErrorKind::usage, "lidr-shadows: index and index-soft expect lidr-cover surface and no surface that blends, as indices of all lights before a surface "
                                      "know of no place that a shadow could fall on (final takes them)");
    if (soft && (settings.lidrPacking == LidrPacking::maxBlend || settings.lidrPacking == LidrPacking::maxBlendSorted || settings.lidrPacking == LidrPacking::list ||
                 settings.lidrTypes == LidrTypes::targets || settings.lidrShare))
        throw Error(ErrorKind::usage, "lidr-shadows: index-soft expects lidr-packing bit-shift or cpu-sort, one target for all types, and no lidr-share: shadows are packed as "
                                      "indices are, in images of their own");
    LightingInputs own = in;
    // Lists that stand in for a packing meet soft shadows at surfaces.
    if (settings.lidrShadows != LidrShadows::finalPass && !(soft && list)) own.constants[shared::kConstantLights] |= shared::kShadowsByIndex;
    Indexing x{.in = own,
               .layout = layout.value_or(IndexLayout{kNoPacking, vk::Format::eR8Unorm, 0, ~0u, false}),
               .surfaces = surfaces && !(list && multisampled)};
    if (early && !soft) x.shadowed = shared::kIndexIfLit;
    x.soft = soft && !list;
    const auto plan = [&] {
        IndexLayout asList = x.layout;
        asList.sorted = false;
        const bool onScreen = !x.surfaces && x.layout.sorted;
        return planIndices(settings, list ? asList : x.layout, in.scene.lights(), in.scene.volumes(),
                           onScreen ? &in.scene.view() : nullptr, settings.onOverflow != OnOverflow::exact);
    };
    x.plan = plan();
    // A surface that blends takes all of its lights at once.
    if (!list && x.plan.rounds() > 1 && in.scene.hasBlended() && !x.surfaces) {
        list = true;
        x.plan = plan();
    }
    x.depth = multisampled && !x.surfaces ? addFarthestDepth(graph, in) : in.depth;
    x.samples = multisampled && x.surfaces;
    // A guard costs the early depth test: it is there if what overflows is kept, and where a second pass goes on at its
    // count.
    x.guarded = !x.layout.sorted && (in.attempt.report || x.layout.packing.passes > 1);
    addDrawing(graph, x, uint64_t(lights) * (in.attempt.report ? shared::kLostWords : 0));

    const vk::Extent2D extent = graph.descOf(in.depth).extent;
    const uint64_t entries = listCapacity(graph, in);
    if (!list && settings.lidrTables == LidrTables::textures) addTables(graph, x);
    list ? addListed(graph, x, sum, in.attempt.slices, entries) : addImages(graph, x, sum);
    if (!in.report) return;

    LightIndexFrame frame{.layout = layout,
                          .attempt = in.attempt,
                          .drops = x.plan.dropped.count > 0,
                          .onOverflow = settings.onOverflow,
                          .largestBuffer = in.largestBuffer};
    frame.attempt.list = list;
    frame.attempt.entries = entries;
    if (in.attempt.report)
        for (const shared::PackedLight& light : in.scene.lights().sources) frame.sceneIndices.push_back(light.sceneIndex);
    frame.stats.fellBack = list && settings.lidrPacking != LidrPacking::list;
    frame.stats.rounds = list ? in.attempt.slices : uint32_t(x.plan.rounds());
    frame.stats.withoutIndex = x.plan.rest.count;
    frame.stats.tableBytes = lights * sizeof(shared::PackedLight);
    if (!x.tables.empty()) frame.stats.tableBytes = 0;
    for (const ImageId table : x.tables) frame.stats.tableBytes += graph.resources()[table.index].bytes();
    frame.stats.packing = "list";
    if (!list) {
        frame.stats.packing =
            fmt::format("{} {}x{}", getSetting(settings, "lidr-packing"), x.layout.overlap, x.layout.mostIndex);
        frame.stats.imageBytes = settings.lidrShare
                                     ? 0
                                     : uint64_t(extent.width) * extent.height * gpu::bytesPerTexel(x.layout.format) *
                                           x.layout.imageCount() * (x.plan.sets.size() + x.soft) * (x.samples ? 4 : 1);
    }
    report(graph, x, std::move(frame));
}

void addPixelLists(FrameGraph& graph, const LightingInputs& in, const AddPixelShading& addShading) {
    const IndexLayout layout{kNoPacking, vk::Format::eR8Unorm, 0, ~0u, false};
    Indexing x{.in = in, .layout = layout, .surfaces = true, .depth = in.depth, .samples = false, .guarded = false};
    x.plan = planIndices({}, layout, in.scene.lights(), in.scene.volumes(), nullptr, false);
    addDrawing(graph, x);
    const uint64_t entries = listCapacity(graph, in);
    addLists(graph, x, in.attempt.slices, entries, addShading);
    if (!in.report) return;
    LightIndexFrame frame{.attempt = in.attempt, .onOverflow = OnOverflow::exact, .largestBuffer = in.largestBuffer};
    frame.attempt.list = true;
    frame.attempt.entries = entries;
    frame.stats.packing = "list";
    frame.stats.rounds = in.attempt.slices;
    report(graph, x, std::move(frame));
}

LightIndices addLightIndices(FrameGraph& graph, const LightingInputs& in) {
    Indexing x{.in = in,
               .layout = indexLayout(in.settings, in.scene.lightCount()),
               .surfaces = true,
               .depth = in.depth,
               .samples = false,
               .guarded = false};
    x.plan = planIndices(in.settings, x.layout, in.scene.lights(), in.scene.volumes(), nullptr, false);
    addDrawing(graph, x);
    const vk::Extent2D extent = graph.descOf(in.depth).extent;
    x.numbers = graph.createImage("light-index.numbers", {vk::Format::eR8Unorm, extent});
    std::vector<ImageId> images;
    for (uint32_t i = 0; i < x.layout.imageCount(); ++i)
        images.push_back(graph.createImage("light-index", {x.layout.format, extent}));
    addIndexPasses(graph, x, x.plan.sets.front().front(), images);
    addSaturated(graph, x);
    return {x.layout, images, x.counters};
}

}  // namespace luciole::render
