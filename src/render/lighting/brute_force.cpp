#include "render/lighting/techniques.hpp"

namespace luciole::render {

using frame::Access;

void drawAtEveryPixel(frame::PassContext& pass, const GpuScene& scene, const std::vector<uint32_t>& constants, uint32_t first,
                      uint32_t count, const std::string& fragment) {
    pass.bind({.vertex = "render/shaders/full_screen.vert",
               .fragment = fragment,
               .blend = gpu::Blend::add,
               .constants = constants});
    pass.depth(vk::CompareOp::eLess, false);
    for (const shared::LightSlice& slice : scene.slices(first, count)) {
        pass.push(slice);
        pass.drawFullScreen();
    }
}

// Every light at every pixel in one pass, whatever its range: no bound that could be wrong, nothing to overflow. A draw
// sums up a slice of the lights in registers; so many are rounded once.
void addBruteForce(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    auto pass = graph.addPass(in.phase + "brute-force");
    in.readBy(pass);
    pass.update(sum, Access::colorBlend).record([&scene = in.scene, constants = in.constants](frame::PassContext& context) {
        drawAtEveryPixel(context, scene, constants, 0, scene.lightCount());
    });
}

}  // namespace luciole::render
