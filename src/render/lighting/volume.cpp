#include "render/lighting/light_volume.shared.h"
#include "render/lighting/light_volumes.hpp"

namespace luciole::render {

using frame::PassContext;
using shared::VolumeDraw;

namespace {

/// Calls `draw` for each shaped light that is seen, with how its mesh is drawn.
template <typename Draw>
void forEachVolume(const GpuScene& scene, const Draw& draw) {
    const shared::ViewConstants& view = scene.view();
    const SortedLights& lights = scene.lights();
    for (uint32_t light = lights.unbounded; light < lights.unbounded + lights.shaped; ++light) {
        const VolumeDraw volume =
            shared::volumeDraw(view, shared::inView(lights.at(light), view.viewFromWorld, vec3(view.worldFromView[3])));
        if (volume.visible) draw(light, volume);
    }
}

PassContext::Prepared prepare(PassContext& pass, const GpuScene& scene, const char* fragment, const std::vector<uint32_t>& constants) {
    return pass.prepare({.vertex = "render/lighting/volume.vert",
                         .fragment = fragment,
                         .blend = gpu::Blend::add,
                         .depthClamp = clampsDepth(scene),
                         .constants = constants});
}

void drawVolume(PassContext& pass, uint32_t light, uint32_t lod) {
    pass.push(lod);
    pass.drawIndexed(shared::volumeIndexCount(lod), 1, shared::volumeFirstIndex(lod), 0, light);
}

/// Volume deferred shading with O'Donnell's two passes a light: front faces behind the surface mark the pixels that the light
/// can't reach; then back faces behind the surface light those that are not marked. A mark is 1, which the second pass takes away, or,
/// with `references`, a number of its own for each light, so that marks may stay.
void drawStencilled(PassContext& pass, const GpuScene& scene, const std::vector<uint32_t>& constants, bool references) {
    const auto faces = vk::StencilFaceFlagBits::eFrontAndBack;
    const auto clear = [&] {
        pass.commands.clearAttachments(vk::ClearAttachment{.aspectMask = vk::ImageAspectFlagBits::eStencil},
                                       vk::ClearRect{.rect = {{}, pass.extent()}, .layerCount = 1});
    };
    const PassContext::Prepared mark = prepare(pass, scene, "", constants);
    const PassContext::Prepared light = prepare(pass, scene, "render/lighting/shaped.frag", constants);
    uint32_t reference = 0;
    pass.commands.setStencilTestEnable(true);
    forEachVolume(scene, [&](uint32_t index, const VolumeDraw& volume) {
        if (references && ++reference == 256) clear(), reference = 1;
        pass.commands.setStencilReference(faces, reference);
        if (volume.frontFaces) {  // else the eye is inside, or nearly: no surface lies before the light
            pass.bind(mark);
            setFaces(pass, true);
            pass.stencil(faces, {.depthFail = references ? vk::StencilOp::eReplace : vk::StencilOp::eIncrementAndClamp});
            drawVolume(pass, index, volume.lod);
        }
        pass.bind(light);
        setFaces(pass, false);
        if (references)
            pass.stencil(faces, {.compare = vk::CompareOp::eNotEqual});
        else
            pass.stencil(faces, {.compare = vk::CompareOp::eEqual, .fail = vk::StencilOp::eZero});
        drawVolume(pass, index, volume.lod);
    });
    if (references) clear();
    pass.commands.setStencilTestEnable(false);
}

}  // namespace

// Calver 2003, "Convex Light Volumes", light by light.
void addVolume(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    addVolumePass(graph, in, deferredShading(in, sum), "volume", false,
                  [&scene = in.scene](PassContext& pass, const std::vector<uint32_t>& constants) {
                      pass.bind(prepare(pass, scene, "render/lighting/shaped.frag", constants));
                      forEachVolume(scene, [&](uint32_t light, const VolumeDraw& volume) {
                          setFaces(pass, volume.frontFaces);
                          drawVolume(pass, light, volume.lod);
                      });
                  });
}

void addVolumeStencil(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    addVolumePass(graph, in, deferredShading(in, sum), "volume-stencil", true,
                  [&scene = in.scene](PassContext& pass, const std::vector<uint32_t>& constants) {
                      drawStencilled(pass, scene, constants, false);
                  });
}

void addVolumeStencilReference(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    addVolumePass(graph, in, deferredShading(in, sum), "volume-stencil-reference", true,
                  [&scene = in.scene](PassContext& pass, const std::vector<uint32_t>& constants) {
                      drawStencilled(pass, scene, constants, true);
                  });
}

}  // namespace luciole::render
