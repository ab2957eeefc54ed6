#include <array>

#include "render/lighting/forward.hpp"
#include "render/lighting/light_prepass.shared.h"
#include "render/lighting/light_volumes.hpp"

namespace luciole::render {

using frame::Access;
using frame::ImageId;
using frame::PassContext;

namespace {

const vk::ClearValue kZero = vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f);

/// What light terms need of the surfaces that are seen (light_prepass.shared.h).
struct StoredSurfaces {
    ImageId surface, object;
};
StoredSurfaces addSurfaces(frame::FrameGraph& graph, const LightingInputs& in) {
    const vk::Extent2D extent = graph.descOf(in.depth).extent;
    const StoredSurfaces stored{graph.createImage("light-prepass.surface", {vk::Format::eR16G16B16A16Unorm, extent}),
                                graph.createImage("light-prepass.object", {vk::Format::eR16Unorm, extent})};
    graph.addPass(in.phase + "light-prepass.surfaces")
        .clear(stored.surface, Access::colorWrite, kZero)
        .clear(stored.object, Access::colorWrite, kZero)
        .read(in.depth, Access::depthTest)
        .record([&scene = in.scene, constants = in.constants](PassContext& pass) {
            testDepth(pass, Surfaces::opaque);
            scene.drawSurfaces(pass, {"render/lighting/light_prepass_surface.frag", constants});
        });
    return stored;
}

}  // namespace

// Engel 2008, "Designing a Renderer for Multiple Lights: The Light Pre-Pass Renderer": surfaces are drawn for their normals; lights add
// up what depends on normals alone; surfaces are drawn again and give it their colours. Engel keeps the diffuse light in colour and of
// the highlight its strength, and gets back an approximation. We keep three colours, in which both equations are linear
// (illuminate.glsl), so that but for the rounding of normals and roughness the picture is that of forward rendering.
void addLightPrepass(frame::FrameGraph& graph, const LightingInputs& in, ImageId sum) {
    const StoredSurfaces stored = addSurfaces(graph, in);
    std::array<ImageId, 3> terms;
    for (uint32_t i = 0; i < terms.size() && !in.counting(); ++i)
        terms[i] = graph.createImage(std::string("light-prepass.") + std::array{"diffuse", "specular", "grazing"}[i], graph.descOf(sum));
    const std::string variant = in.counting() ? "+COUNTING" : "";
    const auto declare = [&](frame::PassBuilder& pass, Access depth) {
        pass.read(stored.surface, Access::fragmentSampled, shared::kPrepassSurface)
            .read(stored.object, Access::fragmentSampled, shared::kPrepassObject)
            .read(in.depth, Access::fragmentSampled, shared::kPrepassDepth);
        in.readLightsBy(pass);
        depth == Access::stencilWrite ? pass.update(in.depth, depth) : pass.read(in.depth, depth);
        if (in.counting()) pass.update(sum, Access::colorBlend);
        for (uint32_t i = 0; i < terms.size() && !in.counting(); ++i) pass.clear(terms[i], Access::colorBlend, kZero);
    };
    addInstancedVolumes(graph, in,
                        {.shaped = "render/lighting/light_prepass_terms.frag" + variant,
                         .everywhere = "render/lighting/light_prepass_terms.frag+EVERYWHERE" + variant,
                         .declare = declare},
                        "light-prepass");
    if (!in.counting()) {
        frame::PassBuilder pass = addForwardPass(graph, in, sum, "light-prepass.color", Surfaces::opaque, true).pass;
        for (uint32_t i = 0; i < terms.size(); ++i) pass.read(terms[i], Access::fragmentSampled, shared::kPrepassTerms + i);
        pass.record([&scene = in.scene, shading = forwardShading(in, "render/lighting/light_prepass.frag", Surfaces::opaque, true)](PassContext& context) {
            testDepth(context, Surfaces::opaque);
            scene.drawSurfaces(context, shading);
        });
    }
    addBlendedLoop(graph, in, sum);
}

}  // namespace luciole::render
