#include "render/lighting/techniques.hpp"

namespace luciole::render {

using frame::Access;

frame::BufferId addLightsInView(frame::FrameGraph& graph, const GpuScene& scene) {
    const frame::BufferId lights = graph.importBuffer("lights", scene.lightTableBytes(), scene.lightTable());
    graph.addPass("lighting.lights")
        .write(lights, Access::computeStorageWrite, 0)
        .record([groups = (scene.lightCount() + 63) / 64](frame::PassContext& pass) {
            if (groups > 0) pass.dispatch("render/lighting/lights.comp", {}, groups);
        });
    if (scene.bounce()) addBounce(graph, scene, lights);
    return lights;
}

}  // namespace luciole::render
