#include "render/lighting/light_volume.shared.h"
#include "render/lighting/light_volumes.hpp"

namespace luciole::render {

using frame::Access;
using frame::BufferId;
using frame::PassContext;

namespace {

struct VolumeLists {
    BufferId lists, arguments;
};

/// Sorts the shaped lights by how their meshes are drawn (volume_lists.comp).
VolumeLists addVolumeLists(frame::FrameGraph& graph, const LightingInputs& in, const std::string& name) {
    const shared::LightSlice shaped{in.scene.lights().unbounded, in.scene.lights().shaped};
    const uint32_t groups = (shaped.count + shared::kVolumeGroup - 1) / shared::kVolumeGroup;
    const BufferId classes = graph.createBuffer("volume.classes", shaped.count * 4ull);
    const BufferId counts = graph.createBuffer("volume.counts", groups * shared::kVolumeClasses * 4ull);
    const BufferId lists = graph.createBuffer("volume.lists", shared::kVolumeClasses * shaped.count * 4ull);
    const BufferId arguments = graph.createBuffer("volume.arguments", shared::kVolumeClasses * sizeof(shared::IndexedDraw));
    // Every stage is the same shader, which names all four buffers.
    for (uint32_t stage = 0; stage < 3; ++stage) {
        auto pass = graph.addPass(in.phase + name + std::array{".classes", ".places", ".lists"}[stage]);
        pass.read(in.lights, Access::computeTableRead);
        stage == 0 ? pass.write(classes, Access::computeStorageWrite, 0) : pass.update(classes, Access::computeStorageWrite, 0);
        stage == 0 ? pass.write(counts, Access::computeStorageWrite, 1) : pass.update(counts, Access::computeStorageWrite, 1);
        stage == 0 ? pass.write(lists, Access::computeStorageWrite, 2) : pass.update(lists, Access::computeStorageWrite, 2);
        stage == 0 ? pass.write(arguments, Access::computeStorageWrite, 3) : pass.update(arguments, Access::computeStorageWrite, 3);
        pass.record([=, constants = in.constants](PassContext& context) mutable {
            context.push(shaped);
            constants.push_back(stage);
            context.dispatch("render/lighting/volume_lists.comp", constants, stage == 1 ? 1 : groups);
        });
    }
    return {lists, arguments};
}

}  // namespace

// All volumes that are drawn alike in one instanced draw, as the note on volume deferred shading asks for, with lists and
// arguments made on the device: what the host does does not depend on the number of lights.
void addInstancedVolumes(frame::FrameGraph& graph, const LightingInputs& in, const VolumeShading& shading, const std::string& name) {
    const bool any = in.scene.lights().shaped > 0;
    const VolumeLists made = any ? addVolumeLists(graph, in, name) : VolumeLists{};
    auto pass = addVolumePass(graph, in, shading, name, false,
                              [scene = &in.scene, arguments = made.arguments, fragment = shading.shaped](PassContext& context, const std::vector<uint32_t>& constants) {
                                  context.bind({.vertex = "render/lighting/volume_listed.vert",
                                                .fragment = fragment,
                                                .blend = gpu::Blend::add,
                                                .depthClamp = clampsDepth(*scene),
                                                .constants = constants});
                                  for (uint32_t c = 0; c < shared::kVolumeClasses; ++c) {
                                      setFaces(context, c & 1);
                                      // Not as the arguments' first instance, which devices need not know.
                                      context.push(std::array{c >> 1, c * scene->lights().shaped});
                                      context.drawIndexedIndirect(arguments, c * sizeof(shared::IndexedDraw));
                                  }
                              });
    if (any) pass.read(made.lists, Access::fragmentStorageRead, 0).read(made.arguments, Access::indirectRead);
}

void addVolumeInstanced(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    addInstancedVolumes(graph, in, deferredShading(in, sum), "volume-instanced");
}

}  // namespace luciole::render
