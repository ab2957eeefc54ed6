#include "render/lighting/light_volumes.hpp"

#include "render/lighting/light_volume.shared.h"

namespace luciole::render {
namespace {

using frame::Access;
using frame::PassContext;

/// Stencil counting (Calver 2003, "Concave Light Volume"; the z-fail method of stencil shadow volumes, Everitt and Kilgard 2002,
/// "Practical and Robust Stenciled Shadow Volumes"): of the faces behind a surface, as many are front faces as back faces
/// unless the surface is inside. Works from inside as well, and for any closed mesh that winds less than 256 times.
void drawMeshLights(PassContext& pass, const GpuScene& scene, const std::string& fragment, std::vector<uint32_t> constants) {
    constants[shared::kConstantLights] &= ~shared::kUsesVolumes;  // the stencil says who is inside
    const SortedLights& lights = scene.lights();
    const uint32_t first = lights.unbounded + lights.shaped;
    pass.commands.setStencilTestEnable(true);
    pass.commands.setStencilReference(vk::StencilFaceFlagBits::eFrontAndBack, 0);
    PassContext::Draw draw{.vertex = "render/lighting/volume_mesh.vert", .blend = gpu::Blend::add, .depthClamp = clampsDepth(scene), .constants = constants};
    const PassContext::Prepared count = pass.prepare(draw);
    draw.fragment = fragment;
    const PassContext::Prepared lit = pass.prepare(draw);
    pass.commands.setCullMode(vk::CullModeFlagBits::eNone);
    for (uint32_t light = first; light < first + lights.meshes; ++light) {
        const shared::VolumeConstants& volume = scene.volumeOf(lights.at(light));
        const vec4 bounds = shared::projectedBounds(scene.view(), shared::volumeBall(scene.view(), volume));
        if (scene.view().cullLights != 0 && !shared::coversPixel(bounds, scene.view().extent)) continue;
        pass.bind(count);
        pass.depth(vk::CompareOp::eGreaterOrEqual, false);
        pass.stencil(vk::StencilFaceFlagBits::eFront, {.depthFail = vk::StencilOp::eDecrementAndWrap});
        pass.stencil(vk::StencilFaceFlagBits::eBack, {.depthFail = vk::StencilOp::eIncrementAndWrap});
        pass.draw(volume.vertexCount, 1, volume.firstVertex, light);

        // Some face lies behind every marked pixel; the first one drawn there lights it and takes the mark away.
        pass.bind(lit);
        pass.depth(vk::CompareOp::eAlways, false);
        pass.stencil(vk::StencilFaceFlagBits::eFrontAndBack,
                     {.compare = vk::CompareOp::eNotEqual, .pass = vk::StencilOp::eZero});
        pass.draw(volume.vertexCount, 1, volume.firstVertex, light);
    }
    pass.commands.setStencilTestEnable(false);
}

}  // namespace

VolumeShading deferredShading(const LightingInputs& in, frame::ImageId sum) {
    return {.shaped = "render/lighting/shaped.frag",
            .everywhere = "render/lighting/brute_force.frag",
            .declare = [&in, sum](frame::PassBuilder& pass, Access depth) {
                in.readBy(pass, depth);
                pass.update(sum, Access::colorBlend);
            }};
}

frame::PassBuilder addVolumePass(frame::FrameGraph& graph, const LightingInputs& in, const VolumeShading& shading, const std::string& name,
                                 bool stencil, std::function<void(PassContext&, const std::vector<uint32_t>&)> drawShaped) {
    auto pass = graph.addPass(in.phase + name);
    const bool marks = stencil || in.scene.lights().meshes > 0;
    shading.declare(pass, marks ? Access::stencilWrite : Access::depthTest);
    pass.record([&scene = in.scene, constants = in.constants, shaped = shading.shaped, everywhere = shading.everywhere,
                 drawShaped = std::move(drawShaped)](PassContext& context) {
        if (scene.lights().unbounded > 0) drawAtEveryPixel(context, scene, constants, 0, scene.lights().unbounded, everywhere);
        if (scene.lights().shaped > 0) {
            context.commands.bindIndexBuffer(scene.volumeIndices(), 0, vk::IndexType::eUint32);
            drawShaped(context, constants);
        }
        if (scene.lights().meshes > 0) drawMeshLights(context, scene, shaped, constants);
    });
    return pass;
}

bool clampsDepth(const GpuScene& scene) { return scene.view().orthographic != 0; }

void setFaces(PassContext& pass, bool frontFaces) {
    pass.commands.setCullMode(frontFaces ? vk::CullModeFlagBits::eBack : vk::CullModeFlagBits::eFront);
    pass.depth(frontFaces ? vk::CompareOp::eGreaterOrEqual : vk::CompareOp::eLessOrEqual, false);
}

}  // namespace luciole::render
