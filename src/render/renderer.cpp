#include <luciole/error.hpp>
#include <luciole/renderer.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "frame/executor.hpp"
#include "frame/pass_context.hpp"
#include "gpu/errors.hpp"
#include "gpu/shaders.hpp"
#include "output/request.hpp"
#include "render/advice/advice.hpp"
#include "render/advice/calibration.hpp"
#include "render/advice/counts.hpp"
#include "render/driver_cache.hpp"
#include "render/geometry/gbuffer.hpp"
#include "render/gpu_scene.hpp"
#include "render/lighting/forward.hpp"
#include "render/lighting/light_index.hpp"
#include "render/lighting/light_index_self_test.hpp"
#include "render/lighting/light_lists.hpp"
#include "render/lighting/tiled_points.shared.h"
#include "render/lighting/techniques.hpp"
#include "render/post/post.hpp"

namespace luciole {

using frame::Access;
using shared::kPassedOn;

namespace render {
namespace {

/// What the structure of the frame depends on; everything else is data.
struct FrameKey {
    uvec2 extent;
    RenderSettings settings;  ///< without those that are data
    bool aovs;
    bool counts;  ///< the technique runs a second time and counts
    bool lists;   ///< its lists of lights become layers
    LightingAttempt attempt = {};
    uint32_t version = 0;               ///< of the scene, where the host looked at single lights or objects
    std::optional<Camera> camera = {};  ///< where lights are sorted by where they are seen
    bool operator==(const FrameKey&) const = default;
};

struct BuiltFrame {
    FrameKey key;
    FrameOutputs outputs;
    LightingReport report;
    frame::Executor executor;
    bool warm = false;
    bool excessive = false;  ///< lists were not needed any more
};

void addDepth(frame::FrameGraph& graph, const GpuScene& scene, const std::string& name, frame::ImageId depth) {
    graph.addPass(name)
        .clear(depth, Access::depthWrite, vk::ClearDepthStencilValue{0.0f, 0})
        .record([&scene](frame::PassContext& pass) {
            pass.depth(vk::CompareOp::eGreaterOrEqual, true);
            scene.drawDepth(pass);
        });
}

/// Phase 1 (Calver 2003, "Geometry phase"): fills the G-buffer. Material 0 of the cleared targets means "no surface".
void addGeometry(frame::FrameGraph& graph, const GpuScene& scene, const GBuffer& gbuffer, const std::vector<uint32_t>& constants, bool depthIsThere) {
    auto pass = graph.addPass("geometry.gbuffer");
    for (const frame::ImageId target : gbuffer.targets)
        pass.clear(target, Access::colorWrite, vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f));
    if (depthIsThere)
        pass.read(gbuffer.depth, Access::depthTest);
    else
        pass.clear(gbuffer.depth, Access::depthWrite, vk::ClearDepthStencilValue{0.0f, 0});
    pass.record([&scene, constants, depthIsThere](frame::PassContext& context) {
        // Of surfaces that coincide the last one drawn is seen, with the set-up pass and without.
        context.depth(depthIsThere ? vk::CompareOp::eEqual : vk::CompareOp::eGreaterOrEqual, !depthIsThere);
        scene.drawSurfaces(context, {"render/geometry/surface.frag", constants});
    });
}

vk::SampleCountFlagBits samplesOf(Msaa msaa) { return msaa == Msaa::x4 ? vk::SampleCountFlagBits::e4 : vk::SampleCountFlagBits::e1; }

bool needsStencil(const LightingTechnique& technique, const GpuScene& scene) {
    using Stencil = LightingTechnique::Stencil;
    return technique.stencil == Stencil::always || (technique.stencil == Stencil::forMeshes && scene.lights().meshes > 0);
}

/// What lighting shaders have to know of shadows (types.shared.h).
uint32_t shadowFeatures(const RenderSettings& settings) {
    if (settings.shadows == Shadows::off) return 0;
    if (settings.shadows == Shadows::volumes) return shared::kUsesShadows | shared::kShadowsStencilled;
    const uint32_t filters[] = {0, shared::kShadowsJittered, shared::kShadowsSmooth};
    return shared::kUsesShadows | filters[size_t(settings.shadowFilter)] | (settings.shadowRedraws != 0 ? shared::kShadowsWait : 0);
}

/// The whole frame, in order.
BuiltFrame buildFrame(const gpu::Context& context, gpu::Pipelines& pipelines, const GpuScene& scene, const FrameKey& key) {
    const vk::Extent2D extent{key.extent.x, key.extent.y};
    frame::FrameGraph graph;
    const LightingTechnique& technique = techniqueNamed(key.settings.lighting);
    const bool volumes = key.settings.shadows == Shadows::volumes;
    const GBuffer gbuffer = createGBuffer(graph, key.settings.gbuffer, extent, needsStencil(technique, scene) || volumes);
    const auto radianceFormat = key.settings.lightBuffer == LightBufferFormat::rgba32f ? vk::Format::eR32G32B32A32Sfloat
                                                                                       : vk::Format::eR16G16B16A16Sfloat;
    const frame::ImageId radiance = graph.createImage("radiance", {radianceFormat, extent});
    const std::vector<uint32_t> constants{uint32_t(key.settings.gbuffer), scene.equations(), scene.lightFeatures() | shadowFeatures(key.settings)};
    const auto samples = samplesOf(key.settings.msaa);
    const bool multisampled = samples != vk::SampleCountFlagBits::e1;
    const bool depthFirst = key.settings.depthPrepass || (technique.forward && !multisampled);
    if (depthFirst) addDepth(graph, scene, "geometry.depth", gbuffer.depth);
    addGeometry(graph, scene, gbuffer, constants, depthFirst);
    const frame::BufferId lights = graph.importBuffer("lights", scene.lightTableBytes(), scene.lightTable());
    if (scene.bounce()) addBounce(graph, scene, lights);
    std::optional<frame::ImageId> shadowAtlas;
    std::optional<frame::BufferId> shadowMask;
    if (key.settings.shadows == Shadows::maps) {
        shadowAtlas = scene.shadows().import(graph);
        scene.shadows().addPasses(graph, scene, *shadowAtlas, key.settings.shadowCasters);
    }
    if (volumes) {
        shadowMask = scene.shadowVolumes().import(graph);
        scene.shadowVolumes().addPasses(graph, *shadowMask, gbuffer.depth, scene.volumeMeshes());
    }
    LightingReport report;
    LightingInputs lighting{.gbuffer = gbuffer,
                            .scene = scene,
                            .constants = constants,
                            .lights = lights,
                            .shadowAtlas = shadowAtlas,
                            .shadowMask = shadowMask,
                            .depth = gbuffer.depth,
                            .settings = key.settings,
                            .attempt = key.attempt,
                            .largestBuffer = context.limits().maxStorageBufferRange,
                            .report = &report};
    if (key.lists) lighting.listLayers = graph.createImage("list-layers", {vk::Format::eR32G32B32A32Sfloat, extent});
    if (multisampled) {
        lighting.depth = graph.createImage("depth.samples", {graph.descOf(gbuffer.depth).format, extent, samples});
        addDepth(graph, scene, "geometry.depth-samples", lighting.depth);
        const frame::ImageId lit = graph.createImage("radiance.samples", {radianceFormat, extent, samples});
        technique.add(graph, lighting, lit);
        addResolve(graph, lit, radiance);
    } else if (technique.forward || technique.whole) {
        technique.add(graph, lighting, radiance);
    } else {
        addInitialLight(graph, lighting, radiance);
        technique.add(graph, lighting, radiance);
        addBlendedLoop(graph, lighting, radiance);
    }
    const frame::ImageId display = addToneMap(graph, radiance, extent, key.settings.toneMap);
    FrameOutputs outputs = addOutputs(graph, lighting, radiance, display, extent, key.aovs);
    if (key.counts) outputs.counts = addCounts(graph, lighting, technique);
    return {.key = key, .outputs = outputs, .report = std::move(report), .executor = frame::Executor(context, pipelines, std::move(graph))};
}

bool sortsArrays(const RenderSettings& settings) {
    return settings.lighting == "light-indexed" && (settings.lidrPacking == LidrPacking::cpuSort || settings.lidrPacking == LidrPacking::maxBlendSorted);
}

/// Whether the frame's structure depends on single lights, not only on how many there are of each shape (planIndices).
bool plansLights(const RenderSettings& settings) {
    const bool orders = settings.lidrTypes != LidrTypes::flag || settings.onOverflow == OnOverflow::priority;
    return sortsArrays(settings) || (settings.lighting == "light-indexed" && orders);
}

/// Whether lights are sorted by where they are seen, and not once for all.
bool sortsByView(const RenderSettings& settings, const GpuScene& scene) {
    const bool onTheWay = settings.lidrCover == LidrCover::frontFaces || (settings.lidrCover == LidrCover::automatic && scene.hasBlended());
    return sortsArrays(settings) && onTheWay;
}

RenderSettings withoutData(RenderSettings settings) {
    const RenderSettings defaults;
    settings.cullLights = defaults.cullLights;
    settings.shadowMemory = defaults.shadowMemory;
    settings.shadowRedraws = std::min(settings.shadowRedraws, 1u);  // whether there is a budget
    settings.exposureEv = defaults.exposureEv;
    settings.measure = defaults.measure;
    return settings;
}

/// The settings that the frame's structure depends on. Forward techniques compute positions from depth, as the compact layout does.
RenderSettings structureOf(RenderSettings settings) {
    if (techniqueNamed(settings.lighting).forward) settings.gbuffer = GBufferLayout::compact;
    return withoutData(std::move(settings));
}

bool drawsPointsOfTiles(const gpu::Context& context, const RenderSettings& settings) {
    return context.largestPoint() >= float(tileSizeOf(settings)) && context.passedOn() >= kPassedOn;
}

void checkSettings(const gpu::Context& context, const RenderSettings& settings) {
    const LightingTechnique& technique = techniqueNamed(settings.lighting);
    if (settings.lidrShare && !context.feedbackLoops())
        throw Error(ErrorKind::usage, fmt::format("lidr-share: expected off, as {} can't sample the colour attachment that a pass writes "
                                                  "(VK_EXT_attachment_feedback_loop_layout)", context.info().name));
    const bool sorts = sortsArrays(settings);
    if (settings.bounceLight != "none" && (technique.onHost || sorts))
        throw Error(ErrorKind::usage, fmt::format("bounce-light: expected none with lighting {}, where the host looks at each light: the lights "
                                                  "of a bounce are made on the device", settings.lighting + (sorts ? " and a packing that sorts" : "")));
    if (technique.points && !drawsPointsOfTiles(context, settings))
        throw Error(ErrorKind::usage, fmt::format("lighting: expected another technique than {}, which needs points of {} pixels and {} values passed on to "
                                                  "fragment shaders; {} has {} and {}", settings.lighting, tileSizeOf(settings), kPassedOn,
                                                  context.info().name, context.largestPoint(), context.passedOn()));
    if (settings.msaa == Msaa::x1) return;
    if (!technique.samples)
        throw Error(ErrorKind::usage, fmt::format("msaa: expected 1 with lighting {}, which stores one surface a pixel; techniques that "
                                                  "light surfaces while they are drawn take 4", settings.lighting));
    if (!(context.sampleCounts() & samplesOf(settings.msaa)))
        throw Error(ErrorKind::usage, fmt::format("msaa: expected 1, as {} shades no samples", context.info().name));
}

void requireLists(const std::string& technique) {
    if (techniqueNamed(technique).info.lists) return;
    std::vector<std::string_view> names;
    for (const LightingTechnique& other : techniques())
        if (other.info.lists) names.push_back(other.info.name);
    throw Error(ErrorKind::usage, fmt::format("aov: list-length and list-slice expect a technique that makes lists of lights ({}), got \"{}\"", fmt::join(names, ", "), technique));
}

void checkAgainstDevice(const gpu::Context& context, uvec2 extent) {
    const auto& limits = context.limits();
    const uint32_t limit = std::min({limits.maxImageDimension2D, limits.maxFramebufferWidth, limits.maxFramebufferHeight});
    if (std::max(extent.x, extent.y) > limit)
        throw Error(ErrorKind::limit, fmt::format("size: expected at most {0}x{0} pixels on {1}, got {2}x{3}", limit,
                                                  context.info().name, extent.x, extent.y));
}

/// Whether counts that were taken with one camera still tell what another sees: it moved by less than a twentieth of the distance to what
/// is seen, turned by less than a tenth of the field of view, and sees as much.
bool seesAlike(const Camera& a, const Camera& b, double distance) {
    const dmat4 between = inverse(dmat4(a.worldFromView)) * dmat4(b.worldFromView);
    const double turn = std::acos(std::clamp(0.5 * (between[0][0] + between[1][1] + between[2][2] - 1), -1.0, 1.0));
    Camera moved = b;
    moved.worldFromView = a.worldFromView;
    moved.name = a.name;
    const double span = a.orthographic ? 2.0 * a.halfHeight / std::max(distance, 1e-9) : double(a.yFov);
    return moved == a && length(dvec3(between[3])) < distance / 20 && turn < span / 10;
}

/// Advice for the scene, and what it holds for.
struct Advised {
    View view;
    RenderSettings settings;  ///< without those that are data
    bool lists = false;       ///< Circumstances
    LightingAdvice advice;
    uint32_t lightsMoved = 0;  ///< times since then
};

constexpr uint32_t kMostLightMoves = 60;  ///< after so many of them what they reach is counted again

}  // namespace
}  // namespace render

struct Renderer::Impl {
    explicit Impl(const RendererOptions& options)
        : context(options), pipelines(context, gpu::shaderCode), selfTest(context, pipelines, options.cacheFolder),
          calibrations(options.cacheFolder, "lighting-costs", render::kCostModelVersion, context.info()) {
        setScene({});
    }

    void setScene(const Scene& scene) {
        frame.reset();
        advised.reset();
        gpuScene.reset();  // before the new one is made: both may not fit
        lightRules = {};
        try {
            gpuScene = std::make_unique<render::GpuScene>(context, pipelines, scene);
        } catch (...) {
            gpuScene = std::make_unique<render::GpuScene>(context, pipelines, Scene{});
            throw;
        }
        lightRules.functions = scene.functions;
        lightRules.linkGroups.resize(scene.linkGroups.size());
        lightRules.lightVolumes.resize(scene.lightVolumes.size());
    }

    void setLights(std::span<const Light> lights) {
        validate(lights, lightRules);
        const uint32_t before = gpuScene->lightCount();
        const bool changed = gpuScene->setLights(lights);
        if (changed) frame.reset();
        if (advised && (changed || gpuScene->lightCount() != before || ++advised->lightsMoved == render::kMostLightMoves)) advised.reset();
    }

    void moveObjects(std::span<const MovedObject> moved) {
        gpuScene->moveObjects(moved);
        if (advised && ++advised->lightsMoved == render::kMostLightMoves) advised.reset();
    }

    /// How the packing that the settings ask for fares on the device.
    render::LightIndexSelfTest::Outcome trial(const RenderSettings& settings) {
        if (settings.lighting != "light-indexed" || settings.lidrPacking == LidrPacking::list) return {};
        const render::IndexLayout layout = render::indexLayout(settings, gpuScene->lightCount());
        const render::LightIndexSelfTest::Outcome outcome = selfTest.of(layout);
        if (outcome.wrong > 0 && settings.onOverflow != OnOverflow::exact)
            throw Error(ErrorKind::device, fmt::format("lidr-packing: {} blends {} values of {} {}x{} inexactly (on-overflow exact takes lists instead)",
                                                       context.info().name, outcome.wrong, getSetting(settings, "lidr-packing"), layout.overlap, layout.mostIndex));
        return outcome;
    }

    /// Runs `frame`, made anew where the key asks for it, until what it counted says that no light was lost that should not be.
    /// \return what the technique and the clock say of the last run
    FrameStats runUntilHeld(render::FrameKey key, const RenderSettings& settings) {
        FrameStats stats;
        for (std::optional<render::LightingAttempt> attempt = key.attempt; attempt;) {
            key.attempt = *attempt;
            attempt.reset();
            if (!frame || frame->key != key) {
                frame.reset();
                context.resetPeak();
                frame = std::make_unique<render::BuiltFrame>(render::buildFrame(context, pipelines, *gpuScene, key));
            }
            // Drivers compile shaders at their first use; that is no part of a frame's time.
            if (settings.measure && !frame->warm) frame->executor.run(gpuScene->frameSet(), false);
            frame->warm = true;
            const auto start = std::chrono::steady_clock::now();
            frame->executor.run(gpuScene->frameSet(), settings.measure);
            stats.wallMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
            const render::LightingReport& report = frame->report;
            if (report.counters) attempt = report.judge(frame->executor.read<uint32_t>(*report.counters), stats);
        }
        frame->excessive = stats.lightIndex && stats.lightIndex->fellBack && stats.lightIndex->pixelsOver == 0;
        return stats;
    }

    /// What a frame costs on this device in this variant; measured if it isn't known yet, while the scene that was set waits.
    render::Coefficients coefficients(const render::CostVariant& variant, LightingAdvice& told) {
        const std::string key = variant.key();
        const std::string* kept = calibrations.find(key);
        if (const auto known = kept ? render::coefficientsFrom(*kept) : std::nullopt; known && render::coversModels(*known, variant.settings))
            return *known;
        const auto start = std::chrono::steady_clock::now();
        std::unique_ptr<render::GpuScene> waitingScene = std::exchange(gpuScene, nullptr);
        std::unique_ptr<render::BuiltFrame> waitingFrame = std::exchange(frame, nullptr);
        const auto goOn = [&] {
            frame = std::move(waitingFrame);
            gpuScene = std::move(waitingScene);
        };
        render::Coefficients coefficients;
        try {
            coefficients = render::fit(calibrate(variant, told.calibrationFrames), variant.settings);
        } catch (...) {
            frame.reset();
            goOn();
            throw;
        }
        frame.reset();
        goOn();
        calibrations.keep(key, render::textOf(coefficients));
        told.calibrationMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        return coefficients;
    }

    std::vector<render::CostSample> calibrate(const render::CostVariant& variant, uint32_t& frames) {
        RenderSettings settings = variant.settings;
        settings.bounceLight = "none";
        settings.shadows = Shadows::off;
        std::vector<render::CostSample> samples;
        for (const auto& [scene, view] : render::calibrationViews(variant)) {
            frame.reset();
            gpuScene = std::make_unique<render::GpuScene>(context, pipelines, scene);
            const SceneCounts counts = render::countScene(context, pipelines, *gpuScene, view, settings, settings.gbuffer);
            const bool many = counts.covered * counts.lights > render::kMostCalibrationPairs;
            std::map<std::string, double> least;
            for (uint32_t round = 0; round < render::kCalibrationRounds; ++round)
                for (const render::CostModel& model : render::costModels()) {
                    settings.lighting = model.technique;
                    if (many && model.evaluatesAll()) continue;
                    if (!render::whyNot(render::techniqueNamed(settings.lighting), settings, circumstances(settings)).empty()) continue;
                    render(view, settings, {});  // compiles shaders and touches new memory
                    ++frames;
                    double& best = least.try_emplace(settings.lighting, HUGE_VAL).first->second;
                    for (double spent = 0; spent < render::kCalibrationMs; ++frames) {
                        const double ms = render(view, settings, {}).stats.wallMs;
                        best = std::min(best, ms);
                        spent += ms;
                    }
                }
            for (const auto& [technique, ms] : least) samples.push_back({technique, counts, ms});
        }
        return samples;
    }

    render::Circumstances circumstances(const RenderSettings& settings, bool lists = false) const {
        return {.lights = gpuScene->lightCount(),
                .bounce = gpuScene->bounce().has_value(),
                .samples = bool(context.sampleCounts() & render::samplesOf(Msaa::x4)),
                .feedback = context.feedbackLoops(),
                .points = render::drawsPointsOfTiles(context, settings),
                .lists = lists};
    }

    /// The choice for a view, and what it rests on. What was found out for a view that is about the same holds on.
    LightingAdvice advise(const View& view, const RenderSettings& wanted, bool lists = false) {
        RenderSettings settings = render::withoutData(wanted);
        settings.lighting = render::kAutoLighting;
        settings.toneMap = RenderSettings{}.toneMap;  // which costs all techniques the same
        if (advised && advised->view.extent == view.extent && advised->settings == settings && advised->lists == lists &&
            render::seesAlike(advised->view.camera, view.camera, advised->advice.counts.meanDistance)) {
            advised->advice.countingFrames = advised->advice.calibrationFrames = 0;
            advised->advice.calibrationMs = 0;
            return advised->advice;
        }
        if (gpuScene->setBounce(settings)) frame.reset();  // it knows the tables that were
        const SceneCounts counts = render::countScene(context, pipelines, *gpuScene, view, settings, settings.gbuffer);
        LightingAdvice told;
        render::CostVariant variant{settings, gpuScene->equations() & shared::kEquationBits, (gpuScene->lightFeatures() & shared::kUsesUniformLights) != 0};
        variant.settings.bounceLight = RenderSettings{}.bounceLight;
        variant.settings.bounceGrid = RenderSettings{}.bounceGrid;
        variant.settings.shadows = Shadows::off;  // which cost all techniques about the same
        const render::Coefficients costs = coefficients(variant, told);
        LightingAdvice advice = render::advise(counts, settings, circumstances(settings, lists), costs);
        advice.countingFrames = 1;
        advice.calibrationFrames = told.calibrationFrames;
        advice.calibrationMs = told.calibrationMs;
        advised = {view, settings, lists, advice};
        return advice;
    }

    void check(const View& view, const std::vector<std::string>& aovs) const {
        checkRequest(view, aovs);
        render::checkAgainstDevice(context, view.extent);
    }

    /// Checked, and with lighting `auto` made into a technique.
    Frame renderChosen(const View& view, RenderSettings settings, const std::vector<std::string>& aovs) {
        check(view, aovs);
        if (settings.lighting != render::kAutoLighting) return render(view, settings, aovs);
        const LightingAdvice advice = advise(view, settings, std::ranges::any_of(aovs, isListLayer));
        settings.lighting = advice.technique;
        Frame result = render(view, settings, aovs);
        result.stats.choice = {advice.technique, advice.reason, advice.countingFrames, advice.calibrationFrames, advice.calibrationMs};
        return result;
    }

    std::vector<PassStats> ablate(const View& view, RenderSettings settings) {
        settings.measure = false;
        renderChosen(view, settings, {});
        const Frame whole = renderChosen(view, settings, {});  // warm from here on, and shadow maps are there
        std::vector<PassStats> passes = whole.stats.passes;
        using Clock = std::chrono::steady_clock;
        double before = 0;
        for (uint32_t cut = 0; cut <= passes.size(); ++cut) {
            const auto start = Clock::now();
            frame->executor.runFirst(gpuScene->frameSet(), cut);
            const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
            if (cut > 0) passes[cut - 1].ms = ms - before;
            before = ms;
        }
        return passes;
    }

    Frame render(const View& view, const RenderSettings& settings, const std::vector<std::string>& aovs) {
        render::checkSettings(context, settings);
        const bool counts = std::ranges::any_of(aovs, render::isCount);
        const bool lists = std::ranges::any_of(aovs, isListLayer);
        const bool others = std::ranges::any_of(aovs, [](const std::string& aov) { return !render::isCount(aov) && !isListLayer(aov); });
        if (lists) render::requireLists(settings.lighting);
        if (gpuScene->setBounce(settings)) frame.reset();  // it knows the tables that were
        if (settings.shadows == Shadows::volumes && settings.msaa != Msaa::x1)
            throw Error(ErrorKind::usage, "shadows: volumes expect msaa 1, as a pixel's stencil knows one surface (maps take several samples)");
        if (settings.shadows == Shadows::volumes && gpuScene->hasBlended())
            throw Error(ErrorKind::usage, "shadows: volumes expect a scene without surfaces that blend, as a pixel's stencil knows the one behind them (maps shadow all)");
        if (gpuScene->setShadows(view, settings)) frame.reset();
        gpuScene->setView(view, settings, render::structureOf(settings).gbuffer);
        render::FrameKey key{view.extent, render::structureOf(settings), others, counts, lists};
        if (render::plansLights(settings)) key.version = gpuScene->version();
        if (render::sortsByView(settings, *gpuScene)) key.camera = view.camera;
        // The attempt that did last time, if nothing else has changed and it was not more than needed.
        if (frame) key.attempt = frame->key.attempt;
        if (!frame || frame->key != key || frame->excessive) key.attempt = {.report = settings.onOverflow == OnOverflow::priority};
        const render::LightIndexSelfTest::Outcome tried = trial(settings);
        key.attempt.list |= tried.wrong > 0;
        FrameStats stats;
        try {
            stats = runUntilHeld(key, settings);
        } catch (...) {
            gpuScene->shadows().forget();
            throw;
        }
        if (settings.shadows == Shadows::maps) stats.shadows = gpuScene->shadows().stats();
        if (settings.shadows == Shadows::volumes) stats.shadows = gpuScene->shadowVolumes().stats();
        if (stats.lightIndex) stats.lightIndex->selfTestMs = tried.ms, stats.lightIndex->wrongValues = tried.wrong;

        Frame result = render::readOutputs(frame->executor, frame->outputs, view.extent, settings.lightBuffer, aovs);
        stats.passes = frame->executor.stats();
        for (const PassStats& pass : stats.passes)
            if (stats.shadows && pass.name.starts_with("shadow.")) stats.shadows->casterDraws += pass.draws;
        stats.recordMs = frame->executor.recordMs();
        stats.peakBytes = context.peakBytes();
        stats.triangles = gpuScene->triangles();
        stats.lights = gpuScene->lightCount();
        stats.deviceName = context.info().name;
        stats.driver = context.info().driver;
        result.stats = std::move(stats);
        result.graph = frame->executor.dot();
        return result;
    }

    gpu::Context context;
    gpu::Pipelines pipelines;
    render::LightIndexSelfTest selfTest;
    render::DriverCache calibrations;
    std::unique_ptr<render::GpuScene> gpuScene;
    Scene lightRules;  ///< what the rules of the scene's lights refer to, and nothing else of it
    std::unique_ptr<render::BuiltFrame> frame;
    std::optional<render::Advised> advised;
};

using gpu::translatingVulkanErrors;

Renderer::Renderer(const RendererOptions& options)
    : impl_(translatingVulkanErrors([&] { return std::make_unique<Impl>(options); })) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

const DeviceInfo& Renderer::device() const { return impl_->context.info(); }

void Renderer::setScene(const Scene& scene) {
    translatingVulkanErrors([&] { impl_->setScene(scene); });
}

void Renderer::moveObjects(std::span<const MovedObject> moved) {
    translatingVulkanErrors([&] { impl_->moveObjects(moved); });
}

void Renderer::setLights(std::span<const Light> lights) {
    translatingVulkanErrors([&] { impl_->setLights(lights); });
}

Frame Renderer::render(const View& view, const RenderSettings& settings, const std::vector<std::string>& aovs) {
    return translatingVulkanErrors([&] { return impl_->renderChosen(view, settings, aovs); });
}

std::vector<PassStats> Renderer::ablate(const View& view, const RenderSettings& settings) {
    return translatingVulkanErrors([&] { return impl_->ablate(view, settings); });
}

LightingAdvice Renderer::advise(const View& view, const RenderSettings& settings) {
    return translatingVulkanErrors([&] {
        impl_->check(view, {});
        return impl_->advise(view, settings);
    });
}

}  // namespace luciole
