#include <luciole/error.hpp>
#include <luciole/renderer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "frame/executor.hpp"
#include "frame/pass_context.hpp"
#include "gpu/shaders.hpp"
#include "output/request.hpp"
#include "render/geometry/gbuffer.hpp"
#include "render/gpu_scene.hpp"
#include "render/lighting/techniques.hpp"
#include "render/post/post.hpp"

namespace luciole {

using frame::Access;

namespace render {
namespace {

/// What the structure of the frame depends on; everything else is data.
struct FrameKey {
    uvec2 extent;
    std::string lighting;
    GBufferLayout gbuffer;
    LightBufferFormat lightBuffer;
    bool depthPrepass;
    bool aovs;
    bool counts;  ///< the technique runs a second time and counts
    bool operator==(const FrameKey&) const = default;
};

struct BuiltFrame {
    FrameKey key;
    FrameOutputs outputs;
    frame::Executor executor;
    bool warm = false;
};

void addDepthPrepass(frame::FrameGraph& graph, const GpuScene& scene, const FrameKey& key, const GBuffer& gbuffer) {
    graph.addPass("geometry.depth")
        .clear(gbuffer.depth, Access::depthWrite, vk::ClearDepthStencilValue{0.0f, 0})
        .record([&scene, layout = key.gbuffer](frame::PassContext& pass) {
            pass.depth(vk::CompareOp::eGreaterOrEqual, true);
            scene.draw(pass, layout, true);
        });
}

/// Phase 1 (Calver 2003, "Geometry phase"): fills the G-buffer. Material 0 of the cleared targets means "no surface".
void addGeometry(frame::FrameGraph& graph, const GpuScene& scene, const FrameKey& key, const GBuffer& gbuffer) {
    auto pass = graph.addPass("geometry.gbuffer");
    for (const frame::ImageId target : gbuffer.targets)
        pass.clear(target, Access::colorWrite, vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f));
    if (key.depthPrepass)
        pass.read(gbuffer.depth, Access::depthTest);
    else
        pass.clear(gbuffer.depth, Access::depthWrite, vk::ClearDepthStencilValue{0.0f, 0});
    pass.record([&scene, layout = key.gbuffer, after = key.depthPrepass](frame::PassContext& context) {
        // Of surfaces that coincide the last one drawn is seen, with the set-up pass and without.
        context.depth(after ? vk::CompareOp::eEqual : vk::CompareOp::eGreaterOrEqual, !after);
        scene.draw(context, layout, false);
    });
}

bool needsStencil(const LightingTechnique& technique, const GpuScene& scene) {
    using Stencil = LightingTechnique::Stencil;
    return technique.stencil == Stencil::always || (technique.stencil == Stencil::forMeshes && scene.lights().meshes > 0);
}

/// The whole frame, in order.
BuiltFrame buildFrame(const gpu::Context& context, gpu::Pipelines& pipelines, const GpuScene& scene, const FrameKey& key) {
    const vk::Extent2D extent{key.extent.x, key.extent.y};
    frame::FrameGraph graph;
    const LightingTechnique& technique = techniqueNamed(key.lighting);
    const GBuffer gbuffer = createGBuffer(graph, key.gbuffer, extent, needsStencil(technique, scene));
    const auto radianceFormat = key.lightBuffer == LightBufferFormat::rgba32f ? vk::Format::eR32G32B32A32Sfloat
                                                                              : vk::Format::eR16G16B16A16Sfloat;
    const frame::ImageId radiance = graph.createImage("radiance", {radianceFormat, extent});
    if (key.depthPrepass) addDepthPrepass(graph, scene, key, gbuffer);
    addGeometry(graph, scene, key, gbuffer);
    const LightingInputs lighting{
        gbuffer, scene, {uint32_t(key.gbuffer), scene.equations(), scene.lightFeatures()}, addLightsInView(graph, scene)};
    addInitialLight(graph, lighting, radiance);
    technique.add(graph, lighting, radiance);
    const frame::ImageId display = addToneMap(graph, radiance, extent);
    FrameOutputs outputs = addOutputs(graph, lighting, radiance, display, extent, key.aovs);
    if (key.counts) outputs.counts = addCounts(graph, lighting, technique);
    return {.key = key, .outputs = outputs, .executor = frame::Executor(context, pipelines, std::move(graph))};
}

void checkAgainstDevice(const gpu::Context& context, uvec2 extent) {
    const auto& limits = context.limits();
    const uint32_t limit = std::min({limits.maxImageDimension2D, limits.maxFramebufferWidth, limits.maxFramebufferHeight});
    if (std::max(extent.x, extent.y) > limit)
        throw Error(ErrorKind::limit, fmt::format("size: expected at most {0}x{0} pixels on {1}, got {2}x{3}", limit,
                                                  context.info().name, extent.x, extent.y));
}

}  // namespace
}  // namespace render

struct Renderer::Impl {
    explicit Impl(const RendererOptions& options) : context(options), pipelines(context, gpu::shaderCode) { setScene({}); }

    void setScene(const Scene& scene) {
        frame.reset();
        gpuScene.reset();  // before the new one is made: both may not fit
        try {
            gpuScene = std::make_unique<render::GpuScene>(context, pipelines, scene);
        } catch (...) {
            gpuScene = std::make_unique<render::GpuScene>(context, pipelines, Scene{});
            throw;
        }
    }

    Frame render(const View& view, const RenderSettings& settings, const std::vector<std::string>& aovs) {
        checkRequest(view, aovs);
        render::checkAgainstDevice(context, view.extent);
        const bool counts = std::ranges::any_of(aovs, render::isCount);
        const bool others = !std::ranges::all_of(aovs, render::isCount);
        const render::FrameKey key{view.extent,          settings.lighting,     settings.gbuffer,
                                   settings.lightBuffer, settings.depthPrepass, others, counts};
        if (!frame || frame->key != key) {
            frame.reset();
            context.resetPeak();
            frame = std::make_unique<render::BuiltFrame>(render::buildFrame(context, pipelines, *gpuScene, key));
        }
        gpuScene->setView(view, settings);
        // Drivers compile shaders at their first use; that is no part of a frame's time.
        if (settings.measure && !frame->warm) frame->executor.run(gpuScene->frameSet(), false);
        frame->warm = true;
        const auto start = std::chrono::steady_clock::now();
        frame->executor.run(gpuScene->frameSet(), settings.measure);
        const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;

        Frame result = render::readOutputs(frame->executor, frame->outputs, view.extent, settings.lightBuffer, aovs);
        result.stats = {.passes = frame->executor.stats(),
                        .wallMs = wall.count(),
                        .recordMs = frame->executor.recordMs(),
                        .peakBytes = context.peakBytes(),
                        .triangles = gpuScene->triangles(),
                        .lights = gpuScene->lightCount(),
                        .deviceName = context.info().name,
                        .driver = context.info().driver};
        result.graph = frame->executor.dot();
        return result;
    }

    gpu::Context context;
    gpu::Pipelines pipelines;
    std::unique_ptr<render::GpuScene> gpuScene;
    std::unique_ptr<render::BuiltFrame> frame;
};

namespace {

/// Runs `work`; what Vulkan throws becomes an Error.
template <typename Work>
auto translatingVulkanErrors(const Work& work) {
    try {
        return work();
    } catch (const vk::InitializationFailedError& error) {
        throw Error(ErrorKind::device, fmt::format("Vulkan: {}", error.what()));
    } catch (const vk::SystemError& error) {
        throw Error(ErrorKind::deviceLost, fmt::format("Vulkan: {}", error.what()));
    }
}

}  // namespace

Renderer::Renderer(const RendererOptions& options)
    : impl_(translatingVulkanErrors([&] { return std::make_unique<Impl>(options); })) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

const DeviceInfo& Renderer::device() const { return impl_->context.info(); }

void Renderer::setScene(const Scene& scene) {
    translatingVulkanErrors([&] { impl_->setScene(scene); });
}

Frame Renderer::render(const View& view, const RenderSettings& settings, const std::vector<std::string>& aovs) {
    return translatingVulkanErrors([&] { return impl_->render(view, settings, aovs); });
}

}  // namespace luciole
