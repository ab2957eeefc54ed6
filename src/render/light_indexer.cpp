#include <luciole/error.hpp>
#include <luciole/light_indexer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "frame/executor.hpp"
#include "gpu/errors.hpp"
#include "gpu/shaders.hpp"
#include "output/request.hpp"
#include "render/gpu_scene.hpp"
#include "render/lighting/light_index.hpp"
#include "render/lighting/light_index_self_test.hpp"

namespace luciole {

using frame::Access;
using gpu::translatingVulkanErrors;

namespace render {
namespace {

RenderSettings renderSettings(const LightIndexSettings& settings) {
    // More indices take a second pass, and a stencil that guards it.
    if (!std::has_single_bit(settings.overlap) || settings.overlap > 8)
        throw Error(ErrorKind::usage, fmt::format("overlap: expected 1, 2, 4 or 8, got {}", settings.overlap));
    return {.lidrPacking = LidrPacking::bitShift, .overlap = settings.overlap, .indices = settings.indices};
}

/// Of a scene what light indices are made from.
Scene lightsOf(const Scene& scene) {
    Scene lights{.functions = scene.functions, .lights = scene.lights, .linkGroups = scene.linkGroups, .lightVolumes = scene.lightVolumes};
    validate(lights);
    return lights;
}

struct IndexedFrame {
    gpu::Buffer lightsInView;  ///< by light a LucioleStoredLight (light_index.glsl), which shared::LightConstants is, too
    LightIndices indices;
    frame::Executor executor;
};

/// The pass that makes the table of lights as the host reads it, in view space.
frame::BufferId addLightsInView(frame::FrameGraph& graph, const LightingInputs& in, const gpu::Buffer& table) {
    const frame::BufferId inView = graph.importBuffer("lights in view", table.bytes, *table.handle);
    graph.addPass("lighting.lights-in-view")
        .read(in.lights, Access::computeTableRead)
        .write(inView, Access::computeStorageWrite, 0)
        .record([constants = in.constants, groups = (in.scene.lightCount() + 63) / 64](frame::PassContext& pass) {
            if (groups > 0) pass.dispatch("render/lighting/lights_in_view.comp", constants, groups);
        });
    return inView;
}

/// The passes of `light-indexed` up to the index images. The host's depth is attached, read-only, as well as sampled: the test against
/// it spares the shader the lights that end before the surface, and takes nothing away that the shader would let through.
IndexedFrame buildFrame(const gpu::Context& context, gpu::Pipelines& pipelines, const GpuScene& scene, const HostDepth& depth, const RenderSettings& settings) {
    checkRequest({{}, depth.extent}, {});
    const auto format = vk::Format(depth.format);
    if (format != vk::Format::eD32Sfloat && format != vk::Format::eD32SfloatS8Uint)
        throw Error(ErrorKind::usage, fmt::format("depth: expected format D32Sfloat or D32SfloatS8Uint, got {}", vk::to_string(format)));
    if (depth.layout == VK_IMAGE_LAYOUT_UNDEFINED) throw Error(ErrorKind::usage, "depth: expected the layout that it is kept in, got Undefined");
    frame::FrameGraph graph;
    const GBuffer noGBuffer;
    const LightingInputs in{.gbuffer = noGBuffer,
                            .scene = scene,
                            .constants = {uint32_t(GBufferLayout::compact), scene.equations(), scene.lightFeatures()},
                            .lights = graph.importBuffer("lights", scene.lightTableBytes(), scene.lightTable()),
                            .depth = graph.importImage("depth", {format, {depth.extent.x, depth.extent.y}}, depth.image, vk::ImageLayout(depth.layout)),
                            .settings = settings};
    LightIndices indices = addLightIndices(graph, in);
    if (indices.layout.mostIndex < scene.lightCount())
        throw Error(ErrorKind::limit, fmt::format("lights: expected at most {}, as overlap {} and indices {} tell apart, got {}", indices.layout.mostIndex,
                                                  settings.overlap, getSetting(settings, "indices"), scene.lightCount()));
    gpu::Buffer lightsInView = gpu::makeBuffer(context, "lights in view", scene.lightCount() * sizeof(shared::LightConstants), vk::BufferUsageFlagBits::eStorageBuffer);
    graph.output(addLightsInView(graph, in, lightsInView), Access::tableRead);
    for (const frame::ImageId image : indices.images) graph.output(image, Access::fragmentSampled);
    graph.output(indices.counters);
    return {std::move(lightsInView), std::move(indices), frame::Executor(context, pipelines, std::move(graph))};
}

/// A command buffer of the host's, which stays his.
struct BorrowedCommands {
    vk::raii::CommandBuffer commands;
    ~BorrowedCommands() { (void)commands.release(); }
};

}  // namespace
}  // namespace render

struct LightIndexer::Impl {
    Impl(const HostDevice& host, const Scene& lights, const HostDepth& hostDepth, const LightIndexSettings& indexSettings)
        : context(host),
          pipelines(context, gpu::shaderCode),
          sampler(context.device(), vk::SamplerCreateInfo{}),
          settings(render::renderSettings(indexSettings)),
          depth(hostDepth) {
        setLights(lights);
    }

    // What fails leaves all as it was.
    void setLights(const Scene& lights) {
        auto newScene = std::make_unique<render::GpuScene>(context, pipelines, render::lightsOf(lights));
        auto newOne = newFrame(*newScene, depth);
        const render::IndexLayout& layout = newOne->indices.layout;
        if (const uint32_t wrong = selfTest.of(layout).wrong; wrong > 0)
            throw Error(ErrorKind::device, fmt::format("device: {} blends {} values of bit-shift {}x{} inexactly", context.info().name, wrong, layout.overlap, layout.mostIndex));
        frame = std::move(newOne);
        gpuScene = std::move(newScene);
    }

    void setDepth(const HostDepth& hostDepth) {
        frame = newFrame(*gpuScene, hostDepth);
        depth = hostDepth;
    }

    std::unique_ptr<render::IndexedFrame> newFrame(const render::GpuScene& scene, const HostDepth& hostDepth) {
        return std::make_unique<render::IndexedFrame>(render::buildFrame(context, pipelines, scene, hostDepth, settings));
    }

    void record(VkCommandBuffer commands, const Camera& camera) {
        const View view{camera, depth.extent};
        checkRequest(view, {});
        gpuScene->setView(view, settings, GBufferLayout::compact);
        const render::BorrowedCommands borrowed{{context.device(), commands, VK_NULL_HANDLE}};
        frame->executor.record(borrowed.commands, gpuScene->frameSet());
    }

    gpu::Context context;
    gpu::Pipelines pipelines;
    render::LightIndexSelfTest selfTest{context, pipelines, {}};
    vk::raii::Sampler sampler;
    RenderSettings settings;
    HostDepth depth;
    std::unique_ptr<render::GpuScene> gpuScene;
    std::unique_ptr<render::IndexedFrame> frame;
};

mat4 clipFromView(const Camera& camera, uvec2 extent) { return mat4(render::clipFromView(camera, double(extent.x) / extent.y)); }

void LightIndexer::enableFeatures(VkPhysicalDeviceFeatures& v10, VkPhysicalDeviceVulkan12Features& v12, VkPhysicalDeviceVulkan13Features& v13) {
    gpu::enableFeatures(v10, v12, v13);
}

LightIndexer::LightIndexer(const HostDevice& host, const Scene& scene, const HostDepth& depth, const LightIndexSettings& settings)
    : impl_(translatingVulkanErrors([&] { return std::make_unique<Impl>(host, scene, depth, settings); })) {}
LightIndexer::~LightIndexer() = default;
LightIndexer::LightIndexer(LightIndexer&&) noexcept = default;
LightIndexer& LightIndexer::operator=(LightIndexer&&) noexcept = default;

void LightIndexer::setLights(const Scene& scene) {
    translatingVulkanErrors([&] { impl_->setLights(scene); });
}

void LightIndexer::setDepth(const HostDepth& depth) {
    translatingVulkanErrors([&] { impl_->setDepth(depth); });
}

LightIndexDescriptors LightIndexer::descriptors() const {
    const auto& [lightsInView, indices, executor] = *impl_->frame;
    const auto sampled = [&](vk::ImageView view) { return VkDescriptorImageInfo{*impl_->sampler, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}; };
    LightIndexDescriptors descriptors{.lights = {*lightsInView.handle, 0, VK_WHOLE_SIZE}};
    // Four bindings whatever the packing: there the last image stands in for those that are not.
    for (size_t i = 0; i < 4; ++i) descriptors.images[i] = sampled(executor.view(indices.images[std::min(i, indices.images.size() - 1)]));
    descriptors.images[4] = sampled(impl_->gpuScene->functionImage());
    return descriptors;
}

std::array<uint32_t, 4> LightIndexer::packing() const {
    const shared::IndexPacking& packing = impl_->frame->indices.layout.packing;
    return {packing.indexBits, packing.entryBits, packing.perPass, packing.images};
}

uint32_t LightIndexer::lightCount() const { return impl_->gpuScene->lightCount(); }

void LightIndexer::record(VkCommandBuffer commands, const Camera& camera) {
    translatingVulkanErrors([&] { impl_->record(commands, camera); });
}

uint32_t LightIndexer::pixelsOver() const {
    return impl_->frame->executor.read<uint32_t>(impl_->frame->indices.counters)[shared::kCounterPixels];
}

}  // namespace luciole
