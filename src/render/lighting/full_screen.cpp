#include "render/lighting/techniques.hpp"

namespace luciole::render {

using frame::Access;

// Calver 2003, "Full screen lights": a light shader runs at every pixel and its result is accumulated in the light
// buffer. One rounding per light: an RGBA16F buffer loses up to half a unit in the last place each (and drivers that
// truncate lose more; see docs/performance.md).
void addFullScreen(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    auto pass = graph.addPass(in.phase + "fullscreen");
    in.readBy(pass);
    pass.update(sum, Access::colorBlend)
        .record([constants = in.constants, lightCount = in.scene.lightCount()](frame::PassContext& context) {
            context.bind({.vertex = "render/shaders/full_screen.vert",
                          .fragment = "render/lighting/full_screen.frag",
                          .blend = gpu::Blend::add,
                          .constants = constants});
            context.depth(vk::CompareOp::eLess, false);
            for (uint32_t light = 0; light < lightCount; ++light) {
                context.push(light);
                context.drawFullScreen();
            }
        });
}

}  // namespace luciole::render
