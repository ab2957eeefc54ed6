#include "render/post/post.hpp"

#include <algorithm>
#include <glm/gtc/packing.hpp>

#include "frame/pass_context.hpp"
#include "render/lighting/forward.hpp"
#include "render/lighting/forward.shared.h"

namespace luciole::render {

using frame::Access;

namespace {

constexpr vk::Format kFloat = vk::Format::eR32G32B32A32Sfloat;

/// Copies an image into a buffer that the host reads. The pass resolves the handles when it runs.
frame::BufferId addReadback(frame::FrameGraph& graph, const std::string& name, frame::ImageId image) {
    const frame::Resource& source = graph.resources()[image.index];
    const vk::Extent2D extent = source.image.extent;
    const frame::BufferId buffer = graph.createBuffer(name, source.bytes());
    graph.addPass("output." + name)
        .read(image, Access::transferRead)
        .write(buffer, Access::transferWrite)
        .record([image, buffer, extent](frame::PassContext& pass) {
            pass.commands.copyImageToBuffer(
                pass.image(image), vk::ImageLayout::eTransferSrcOptimal, pass.buffer(buffer),
                vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                    .imageExtent = {extent.width, extent.height, 1}});
        });
    graph.output(buffer);
    return buffer;
}

std::array<frame::ImageId, 4> addAovs(frame::FrameGraph& graph, const LightingInputs& in, vk::Extent2D extent) {
    std::array<frame::ImageId, 4> images;
    auto pass = graph.addPass("output.aov");
    in.readBy(pass);
    const char* names[] = {"aov.scalars", "aov.normal", "aov.cs0", "aov.cs1"};
    for (size_t i = 0; i < images.size(); ++i) {
        images[i] = graph.createImage(names[i], {kFloat, extent});
        // Where nothing is: depth 0, material -1, object ID -1, no light.
        const auto empty = i == 0 ? vk::ClearColorValue(0.0f, -1.0f, -1.0f, 0.0f) : vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f);
        pass.clear(images[i], Access::colorWrite, empty);
    }
    pass.record([&scene = in.scene, constants = in.constants](frame::PassContext& context) {
        context.depth(vk::CompareOp::eLess, false);
        std::vector<shared::LightSlice> slices = scene.slices(0, scene.lightCount());
        if (slices.empty()) slices.push_back({0, 0});  // there are layers without light, too
        for (const shared::LightSlice& slice : slices) {
            context.bind({.vertex = "render/shaders/full_screen.vert",
                          .fragment = "render/post/aov.frag",
                          .blend = slice.first > 0 ? gpu::Blend::add : gpu::Blend::replace,
                          .constants = constants});
            context.push(slice);
            context.drawFullScreen();
        }
    });
    return images;
}

/// Channels [first, first + count) of RGBA texels.
Image channels(std::span<const float> texels, uvec2 extent, uint32_t first, uint32_t count) {
    Image image(extent.x, extent.y, count);
    for (size_t pixel = 0; pixel < size_t(extent.x) * extent.y; ++pixel)
        std::copy_n(&texels[pixel * 4 + first], count, &image.data[pixel * count]);
    return image;
}

Image radianceImage(const frame::Executor& executor, frame::BufferId buffer, uvec2 extent, LightBufferFormat format) {
    if (format == LightBufferFormat::rgba32f) return channels(executor.read<float>(buffer), extent, 0, 3);
    std::vector<float> texels;
    for (const uint16_t half : executor.read<uint16_t>(buffer)) texels.push_back(glm::unpackHalf1x16(half));
    return channels(texels, extent, 0, 3);
}

}  // namespace

frame::ImageId addToneMap(frame::FrameGraph& graph, frame::ImageId radiance, vk::Extent2D extent, ToneMap toneMap) {
    const frame::ImageId display = graph.createImage("display", {kFloat, extent});
    graph.addPass("post.tone-map")
        .read(radiance, Access::fragmentSampled, 0)
        .write(display, Access::colorWrite)
        .record([toneMap](frame::PassContext& pass) {
            pass.bind({.vertex = "render/shaders/full_screen.vert", .fragment = "render/post/tone_map.frag", .constants = {0, 0, 0, uint32_t(toneMap)}});
            pass.drawFullScreen();
        });
    return display;
}

void addResolve(frame::FrameGraph& graph, frame::ImageId samples, frame::ImageId resolved) {
    const vk::Extent2D extent = graph.descOf(resolved).extent;
    graph.addPass("post.resolve")
        .read(samples, Access::transferRead)
        .write(resolved, Access::transferWrite)
        .record([=](frame::PassContext& pass) {
            const vk::ImageSubresourceLayers color{vk::ImageAspectFlagBits::eColor, 0, 0, 1};
            pass.commands.resolveImage(pass.image(samples), vk::ImageLayout::eTransferSrcOptimal, pass.image(resolved),
                                       vk::ImageLayout::eTransferDstOptimal,
                                       vk::ImageResolve{.srcSubresource = color, .dstSubresource = color, .extent = {extent.width, extent.height, 1}});
        });
}

FrameOutputs addOutputs(frame::FrameGraph& graph, const LightingInputs& lighting, frame::ImageId radiance,
                        frame::ImageId display, vk::Extent2D extent, bool aovs) {
    FrameOutputs outputs{addReadback(graph, "radiance", radiance), addReadback(graph, "display", display)};
    if (aovs) {
        const auto images = addAovs(graph, lighting, extent);
        outputs.aovs = {addReadback(graph, "aov.scalars", images[0]), addReadback(graph, "aov.normal", images[1]),
                        addReadback(graph, "aov.cs0", images[2]), addReadback(graph, "aov.cs1", images[3])};
    }
    if (lighting.listLayers) outputs.lists = addReadback(graph, "aov.lists", *lighting.listLayers);
    return outputs;
}

bool isCount(const std::string& aov) {
    return aov == "evaluations" || aov == "useful-evaluations" || aov == "light-fingerprint";
}

frame::BufferId addCounts(frame::FrameGraph& graph, const LightingInputs& lighting, const LightingTechnique& technique) {
    const vk::Extent2D extent = graph.descOf(lighting.gbuffer.depth).extent;
    const frame::ImageId counts = graph.createImage("counts", {kFloat, extent});
    LightingInputs counting = lighting;
    counting.constants[shared::kConstantLights] |= shared::kCountsLights;
    counting.phase = "counting.";
    counting.attempt.report = false;
    counting.report = nullptr;
    counting.listLayers.reset();
    graph.addPass("counting.clear").clear(counts, Access::colorWrite, vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f));
    counting.counts = graph.createBuffer("counts.forward", uint64_t(extent.width) * extent.height * shared::kForwardCounters * 4);
    graph.addPass("counting.zero").write(counting.counts, Access::transferWrite).record([buffer = counting.counts](frame::PassContext& pass) {
        pass.commands.fillBuffer(pass.buffer(buffer), 0, VK_WHOLE_SIZE, 0);
    });
    technique.add(graph, counting, counts);
    if (!technique.forward && !technique.whole) addBlendedLoop(graph, counting, counts);
    graph.addPass("counting.sum")
        .read(counting.counts, Access::fragmentStorageRead, shared::kForwardCounts)
        .update(counts, Access::colorBlend)
        .record([](frame::PassContext& pass) {
            pass.bind({.vertex = "render/shaders/full_screen.vert", .fragment = "render/lighting/forward_counts.frag", .blend = gpu::Blend::add});
            pass.drawFullScreen();
        });
    return addReadback(graph, "counts", counts);
}

Frame readOutputs(const frame::Executor& executor, const FrameOutputs& outputs, uvec2 extent, LightBufferFormat format,
                  const std::vector<std::string>& aovs) {
    struct Source {
        const char* name;
        uint32_t image, first, count;
    };
    constexpr uint32_t kCounts = 4, kLists = 5;
    constexpr Source kSources[] = {{"depth", 0, 0, 1},  {"material", 0, 1, 1}, {"id", 0, 2, 1}, {"light-count", 0, 3, 1},
                                   {"normal", 1, 0, 3}, {"cs0", 2, 0, 3},      {"cs1", 3, 0, 3},
                                   {"evaluations", kCounts, 0, 1}, {"useful-evaluations", kCounts, 1, 1}, {"light-fingerprint", kCounts, 2, 1},
                                   {"list-length", kLists, 0, 1}, {"list-slice", kLists, 1, 1}};
    const auto bufferOf = [&](uint32_t image) { return image == kCounts ? *outputs.counts : image == kLists ? *outputs.lists : (*outputs.aovs)[image]; };
    Frame frame;
    frame.radiance = radianceImage(executor, outputs.radiance, extent, format);
    frame.display = channels(executor.read<float>(outputs.display), extent, 0, 3);
    for (const Source& source : kSources)
        if (std::ranges::find(aovs, source.name) != aovs.end())
            frame.aovs[source.name] =
                channels(executor.read<float>(bufferOf(source.image)), extent, source.first, source.count);
    return frame;
}

}  // namespace luciole::render
