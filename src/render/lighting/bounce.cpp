#include <cmath>

#include "gpu/bindings.shared.h"
#include "render/lighting/bounce.shared.h"
#include "render/lighting/techniques.hpp"

namespace luciole::render {

using frame::Access;

static_assert(sizeof(shared::BouncePush) == 16);

// One-bounce radiosity, faked by many small lights (Trebilco 2009, "Fake Radiosity"; the lights are those of Dachsbacher and Stamminger
// 2006, "Splatting Indirect Illumination", placed at every texel). Two passes: the scene from the light's own view, then a light for
// each texel, which takes the place that the table of lights keeps for it.
void addBounce(frame::FrameGraph& graph, const GpuScene& scene, frame::BufferId lights) {
    const Bounce& bounce = *scene.bounce();
    // Positions in halves are off by 0.05 % of the distance; colours have 16 bits, where compact would be off by the same on all of a wall.
    constexpr GBufferLayout kLayout = GBufferLayout::floatPosition;
    const std::vector<uint32_t> constants{uint32_t(kLayout), scene.equations(), scene.lightFeatures()};
    const GBuffer seen = createGBuffer(graph, kLayout, {bounce.grid, bounce.grid}, false, "bounce.");
    auto geometry = graph.addPass("bounce.gbuffer");
    for (const frame::ImageId target : seen.targets) geometry.clear(target, Access::colorWrite, vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f));
    geometry.clear(seen.depth, Access::depthWrite, vk::ClearDepthStencilValue{0.0f, 0}).record([&scene, constants](frame::PassContext& pass) {
        pass.bindSet(shared::kFrameSet, scene.bounceSet());
        pass.depth(vk::CompareOp::eGreaterOrEqual, true);
        scene.drawSurfaces(pass, {"render/geometry/surface.frag", constants});
    });

    auto place = graph.addPass("bounce.lights");
    for (uint32_t i = 0; i < seen.targets.size(); ++i) place.read(seen.targets[i], Access::computeSampled, i);
    place.read(seen.depth, Access::computeSampled, 4)
        .read(lights, Access::computeTableRead)
        .update(lights, Access::computeStorageWrite, 0)
        .record([&scene, constants](frame::PassContext& pass) {
            const Bounce& from = *scene.bounce();
            const auto tanOuter = float(std::tan(0.5 * double(from.camera.yFov)));
            pass.bindSet(shared::kFrameSet, scene.bounceSet());
            pass.push(shared::BouncePush{from.light, from.first, from.grid, tanOuter});
            pass.dispatch("render/lighting/bounce.comp", constants, (from.grid * from.grid + 63) / 64);
        });
}

}  // namespace luciole::render
