#include "render/lighting/forward.hpp"

#include "render/lighting/forward.shared.h"

namespace luciole::render {

using frame::Access;
using frame::PassContext;

ForwardPass addForwardPass(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum,
                           const std::string& name, Surfaces which, bool first) {
    const bool replaces = which == Surfaces::opaque && !in.counting();
    const frame::ImageId target = replaces && !first ? graph.createImage("radiance.more", graph.descOf(sum)) : sum;
    auto pass = graph.addPass(in.phase + name);
    in.readLightsBy(pass);
    pass.read(in.depth, Access::depthTest);
    if (graph.descOf(in.depth).samples != vk::SampleCountFlagBits::e1)
        pass.read(in.depth, Access::fragmentSampled, shared::kForwardDepth);
    if (in.counting())
        pass.update(in.counts, Access::fragmentStorageWrite, shared::kForwardCounts);
    else if (replaces)
        pass.clear(target, Access::colorWrite, vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f));
    else
        pass.update(target, Access::colorBlend);
    return {pass, target};
}

void addToSum(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId target, frame::ImageId sum) {
    if (target.index == sum.index) return;
    const std::string fragment =
        std::string("render/lighting/forward_add.frag") + (in.settings.msaa != Msaa::x1 ? "+MULTISAMPLED" : "");
    graph.addPass(in.phase + "add")
        .read(target, Access::fragmentSampled, 0)
        .update(sum, Access::colorBlend)
        .record([fragment](PassContext& pass) {
            pass.bind({.vertex = "render/shaders/full_screen.vert", .fragment = fragment, .blend = gpu::Blend::add});
            pass.drawFullScreen();
        });
}

SurfaceShading forwardShading(const LightingInputs& in, std::string fragment, Surfaces which, bool first,
                              std::vector<uint32_t> own) {
    if (in.settings.msaa != Msaa::x1) fragment += "+MULTISAMPLED";
    if (in.counting()) fragment += "+COUNTING";
    const bool blended = which == Surfaces::blended;
    own.insert(own.begin(), {first, blended});
    return {.fragment = std::move(fragment),
            .frame = in.constants,
            .own = std::move(own),
            .blend = which == Surfaces::opaque ? gpu::Blend::replace
                     : blended && first        ? gpu::Blend::over
                                               : gpu::Blend::add,
            .oneEquation = true};
}

void testDepth(PassContext& pass, Surfaces which) {
    // Of opaque surfaces that coincide the last one drawn is seen.
    pass.depth(which == Surfaces::blended ? vk::CompareOp::eGreaterOrEqual : vk::CompareOp::eEqual, false);
}

namespace {

/// All lights in a loop: one shading per slice.
std::vector<SurfaceShading> loops(const LightingInputs& in, Surfaces which) {
    std::vector<SurfaceShading> shadings;
    std::vector<shared::LightSlice> slices = in.scene.slices(0, in.scene.lightCount());
    if (slices.empty()) slices.push_back({0, 0});  // there is ambience, too
    for (const shared::LightSlice& slice : slices) {
        shadings.push_back(forwardShading(in, "render/lighting/forward_loop.frag", which, shadings.empty()));
        shadings.back().slice = slice;
    }
    return shadings;
}

}  // namespace

// One pass over the surfaces, every light at every fragment. Surfaces that do not fit one draw's loop are drawn once
// more.
void addForwardLoop(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    bool first = true;
    for (const SurfaceShading& shading : loops(in, Surfaces::opaque)) {
        ForwardPass loop = addForwardPass(graph, in, sum, "forward-loop", Surfaces::opaque, first);
        loop.pass.record([&scene = in.scene, shading](PassContext& pass) {
            testDepth(pass, Surfaces::opaque);
            scene.drawSurfaces(pass, shading);
        });
        addToSum(graph, in, loop.target, sum);
        first = false;
    }
    addBlendedLoop(graph, in, sum);
}

void addBlendedLoop(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    if (!in.scene.hasBlended()) return;
    addForwardPass(graph, in, sum, "blended", Surfaces::blended, true)
        .pass.record([&scene = in.scene, shadings = loops(in, Surfaces::blended)](PassContext& pass) {
            testDepth(pass, Surfaces::blended);
            scene.drawBlended(pass, shadings);
        });
}

}  // namespace luciole::render
