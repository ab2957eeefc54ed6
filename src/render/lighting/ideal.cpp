#include "render/lighting/forward.hpp"
#include "render/lighting/light_index.hpp"

namespace luciole::render {

using frame::Access;

// The lower bound that techniques are measured against: each pixel gets exactly its lights, from lists that passes before it have made and
// that the benchmark does not count. The pass itself is deferred shading as any other: the G-buffer read once, a loop, a sum in registers.
// Lists do not know link groups, which the shader sorts out.
void addIdeal(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    addPixelLists(graph, in, [&](const PixelLists& lists, bool first) {
        auto pass = graph.addPass(in.phase + "ideal");
        in.readBy(pass);
        pass.read(lists.offsets, Access::fragmentStorageRead, shared::kIndexOffsets).read(lists.entries, Access::fragmentStorageRead, shared::kIndexEntries);
        first ? pass.write(sum, Access::colorWrite) : pass.update(sum, Access::colorBlend);
        std::vector<uint32_t> constants = in.constants;
        constants.push_back(first);
        pass.record([constants, first](frame::PassContext& context) {
            context.bind({.vertex = "render/shaders/full_screen.vert",
                          .fragment = "render/lighting/ideal.frag",
                          .blend = first ? gpu::Blend::replace : gpu::Blend::add,
                          .constants = constants});
            context.drawFullScreen();
        });
    });
    addBlendedLoop(graph, in, sum);
}

}  // namespace luciole::render
