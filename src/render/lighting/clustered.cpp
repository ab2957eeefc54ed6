#include "render/lighting/forward.hpp"
#include "render/lighting/light_lists.hpp"
#include "render/lighting/light_lists.shared.h"

namespace luciole::render {

using frame::Access;
using frame::PassContext;

namespace {

/// The surfaces of the G-buffer, each with the lights of its list.
void addListedSurfaces(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum, const LightLists& lists, bool first) {
    auto pass = graph.addPass(in.phase + in.settings.lighting);
    in.readBy(pass);
    readLists(pass, lists);
    first ? pass.write(sum, Access::colorWrite) : pass.update(sum, Access::colorBlend);
    std::vector<uint32_t> constants = in.constants;
    constants.insert(constants.end(), {lists.tileSize, lists.parts, first});
    pass.record([fragment = std::string("render/lighting/light_lists.frag") + (lists.clustered ? "+CLUSTERED" : ""), constants, first](PassContext& context) {
        context.bind({.vertex = "render/shaders/full_screen.vert",
                      .fragment = fragment,
                      .blend = first ? gpu::Blend::replace : gpu::Blend::add,
                      .constants = constants});
        context.drawFullScreen();
    });
}

/// Surfaces that are drawn, each with the lights of its cluster.
void addListedForward(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum, const LightLists& lists, Surfaces which, bool first) {
    auto [pass, target] = addForwardPass(graph, in, sum, in.settings.lighting + (which == Surfaces::blended ? ".blended" : ""), which, first);
    readLists(pass, lists);
    const SurfaceShading shading = forwardShading(in, "render/lighting/forward_clustered.frag", which, first, {lists.tileSize, lists.parts});
    pass.record([&scene = in.scene, shading, which](PassContext& context) {
        testDepth(context, which);
        which == Surfaces::blended ? scene.drawBlended(context, {shading}) : scene.drawSurfaces(context, shading);
    });
    addToSum(graph, in, target, sum);
}

/// What blends is drawn once with all its lights: with lists if one page holds them.
void addListedBlended(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum, const LightLists& lists) {
    if (!in.scene.hasBlended()) return;
    lists.pages == 1 ? addListedForward(graph, in, sum, lists, Surfaces::blended, true) : addBlendedLoop(graph, in, sum);
}

}  // namespace

void addTiled(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    addLightLists(graph, in, ListsOf::tiles, [&](const LightLists& lists, bool first, bool) { addListedSurfaces(graph, in, sum, lists, first); });
    addBlendedLoop(graph, in, sum);
}

void addClustered(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    addLightLists(graph, in, ListsOf::clusters, [&](const LightLists& lists, bool first, bool last) {
        addListedSurfaces(graph, in, sum, lists, first);
        if (last) addListedBlended(graph, in, sum, lists);
    });
}

void addClusteredForward(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    addLightLists(graph, in, ListsOf::clusters, [&](const LightLists& lists, bool first, bool last) {
        addListedForward(graph, in, sum, lists, Surfaces::opaque, first);
        if (last) addListedBlended(graph, in, sum, lists);
    });
}

}  // namespace luciole::render
