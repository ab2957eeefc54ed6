#include <algorithm>

#include "frame/pass_context.hpp"
#include "render/lighting/techniques.hpp"

namespace luciole::render {

using frame::Access;

// Every light at every pixel in one pass, whatever its range: no bound that could be wrong, nothing to overflow. A draw
// sums up to kLightsPerDraw of them in registers; so many are rounded once.
void addBruteForce(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId radiance) {
    auto pass = graph.addPass("lighting.brute-force");
    readGBuffer(pass, in.gbuffer);
    pass.update(radiance, Access::colorBlend).record([constants = in.constants, lightCount = in.scene.lightCount()](frame::PassContext& context) {
        context.bind({.vertex = "render/shaders/full_screen.vert",
                      .fragment = "render/lighting/brute_force.frag",
                      .additive = true,
                      .constants = constants});
        context.depth(vk::CompareOp::eLess, false);
        for (uint32_t first = 0; first < lightCount; first += shared::kLightsPerDraw) {
            context.push(shared::LightSlice{first, std::min(shared::kLightsPerDraw, lightCount - first)});
            context.drawFullScreen();
        }
    });
}

}  // namespace luciole::render
