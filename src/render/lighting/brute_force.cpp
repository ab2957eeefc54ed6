#include "frame/pass_context.hpp"
#include "render/lighting/techniques.hpp"

namespace luciole::render {

using frame::Access;

// Every light at every pixel in one pass, whatever its range: no bound that could be wrong, nothing to overflow.
void addBruteForce(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId radiance) {
    auto pass = graph.addPass("lighting.brute-force");
    readGBuffer(pass, in.gbuffer);
    pass.update(radiance, Access::colorBlend).record([constants = in.constants](frame::PassContext& context) {
        context.bind({.vertex = "render/shaders/full_screen.vert",
                      .fragment = "render/lighting/brute_force.frag",
                      .additive = true,
                      .constants = constants});
        context.depth(vk::CompareOp::eLess, false);
        context.drawFullScreen();
    });
}

}  // namespace luciole::render
