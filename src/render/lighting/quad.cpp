#include "render/lighting/techniques.hpp"

namespace luciole::render {

using frame::Access;

// Calver 2003, "Shaped Lights": "a screen aligned quad just big enough to cover the light", here all of them in one instanced
// draw, whose vertex shader finds the bounds.
void addQuad(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    auto pass = graph.addPass(in.phase + "quad");
    in.readBy(pass);
    pass.update(sum, Access::colorBlend).record([&scene = in.scene, constants = in.constants](frame::PassContext& context) {
        const SortedLights& lights = scene.lights();
        if (lights.unbounded > 0) drawAtEveryPixel(context, scene, constants, 0, lights.unbounded);
        if (lights.shaped + lights.meshes == 0) return;
        context.bind({.vertex = "render/lighting/quad.vert",
                      .fragment = "render/lighting/shaped.frag",
                      .blend = gpu::Blend::add,
                      .constants = constants});
        context.depth(vk::CompareOp::eGreaterOrEqual, false);
        context.draw(6, lights.shaped + lights.meshes, 0, lights.unbounded);
    });
}

}  // namespace luciole::render
