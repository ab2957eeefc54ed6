#include "render/lighting/techniques.hpp"

namespace luciole::render {

using frame::Access;

void addInitialLight(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId radiance) {
    auto pass = graph.addPass("lighting.initial");
    in.readBy(pass);
    pass.clear(radiance, Access::colorWrite, vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f))
        .record([constants = in.constants](frame::PassContext& context) {
            context.bind({.vertex = "render/shaders/full_screen.vert",
                          .fragment = "render/lighting/initial.frag",
                          .constants = constants});
            context.depth(vk::CompareOp::eLess, false);
            context.drawFullScreen();
        });
}

}  // namespace luciole::render
