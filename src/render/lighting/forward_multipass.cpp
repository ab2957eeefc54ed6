#include <optional>

#include "render/lighting/forward.hpp"
#include "render/lighting/light_volume.shared.h"

namespace luciole::render {

using frame::PassContext;
using shared::LightShape;

namespace {

/// What a light can touch, in world space, and where that is seen.
struct Reach {
    uint32_t light;
    uint32_t linkGroup;
    std::optional<LightShape> shape = {};  ///< neither this nor `box`: everything
    std::optional<Bounds> box = {};
    float slack = 0;  ///< metres; a surface may seem to be so far from where its object is
    vk::Rect2D scissor;
};

/// The pixels with a sample within bounds in normalized device coordinates. \param reach of a pixel's samples from its centre
vk::Rect2D scissorOf(vec4 bounds, vec2 extent, float reach) {
    const vec2 low = (vec2(bounds.x, bounds.y) * 0.5f + 0.5f) * extent - 0.5f - reach;
    const vec2 high = (vec2(bounds.z, bounds.w) * 0.5f + 0.5f) * extent - 0.5f + reach;
    const vec2 first = clamp(ceil(low), vec2(0), extent);
    const vec2 size = max(clamp(floor(high) + 1.0f, vec2(0), extent) - first, vec2(0));
    if (bounds.x > bounds.z || bounds.y > bounds.w) return {};
    return {{int32_t(first.x), int32_t(first.y)}, {uint32_t(size.x), uint32_t(size.y)}};
}

/// What the lights can touch, those left out that can touch nothing in the picture.
std::vector<Reach> reaches(const GpuScene& scene, bool multisampled) {
    const shared::ViewConstants& view = scene.view();
    const SortedLights& lights = scene.lights();
    const vec3 eyeWorld(view.worldFromView[3]);
    const float rounding = 1e-6f * length(eyeWorld);  // of the way from world to view: 16 units of roundoff
    std::vector<Reach> reaches;
    for (uint32_t i = 0; i < lights.sources.size(); ++i) {
        const shared::LightConstants source = lights.at(i);
        Reach reach{.light = i, .linkGroup = source.linkGroup, .scissor = {{}, {uint32_t(view.extent.x), uint32_t(view.extent.y)}}};
        if (i >= lights.unbounded) {
            vec4 bounds;
            if (i < lights.unbounded + lights.shaped) {
                const LightShape shapeView = shared::lightShape(shared::inView(source, view.viewFromWorld, eyeWorld));
                const float slack = shared::slackOf(view, shapeView);
                bounds = shared::shapeBounds(view, shared::inflate(shapeView, slack)).rectangle;
                reach.shape = shared::lightShape(source);
                reach.slack = slack + rounding;
            } else {
                const shared::VolumeConstants& volume = scene.volumeOf(source);
                const vec4 ball = shared::volumeBall(view, volume);
                bounds = shared::projectedBounds(view, ball);
                reach.box = Bounds{volume.low, volume.high};
                reach.slack = ball.w - 0.5f * distance(volume.low, volume.high) + rounding;
            }
            reach.scissor = scissorOf(bounds, view.extent, multisampled ? 0.5f : 0.0f);
            const bool nowhere = reach.scissor.extent.width == 0 || reach.scissor.extent.height == 0;
            if (nowhere && view.cullLights != 0) continue;
        }
        reaches.push_back(reach);
    }
    return reaches;
}

/// False only if the light reaches no point of the object.
bool touches(const Reach& reach, const GpuScene& scene, const OpaqueObject& object) {
    if (!scene.linked(reach.linkGroup, object.objectId)) return false;
    const vec3 low = object.boundsWorld.low - reach.slack, high = object.boundsWorld.high + reach.slack;
    if (reach.box && (any(lessThan(high, reach.box->low)) || any(greaterThan(low, reach.box->high)))) return false;
    if (!reach.shape) return true;
    const LightShape& shape = *reach.shape;
    const vec3 outside = max(max(low - shape.apex, shape.apex - high), vec3(0));
    if (dot(outside, outside) > shape.radius * shape.radius) return false;
    if (shape.angle >= shared::kHalfTurn) return true;
    // How far outside the cone the ball around the box begins, in the plane through its centre and the axis: seen from the cone's
    // edge, so that it holds for cones of more than a half space, too; and never more than it is.
    const vec3 toCenter = 0.5f * (low + high) - shape.apex;
    const float angle = std::min(shape.angle + shared::kTrigonometry, shared::kHalfTurn);
    return length(cross(toCenter, shape.axis)) * std::cos(angle) - dot(toCenter, shape.axis) * std::sin(angle) <= 0.5f * distance(low, high);
}

}  // namespace

// A pass over the surfaces for ambience and emission, then one for each light, added to it: the "multi-pass forward rendering" that
// Trebilco 2009, "Light-Indexed Deferred Rendering", compares with. As good implementations did, it draws for a light only the objects
// that it can touch, within a rectangle around it. The passes of all lights over one material come one after the other, so that its
// shader and textures are bound once.
void addForwardMultipass(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum) {
    constexpr const char* kFragment = "render/lighting/forward_loop.frag";
    addForwardPass(graph, in, sum, "forward-multipass.initial", Surfaces::opaque, true)
        .pass.record([&scene = in.scene, shading = forwardShading(in, kFragment, Surfaces::opaque, true)](PassContext& pass) {
            testDepth(pass, Surfaces::opaque);
            scene.drawSurfaces(pass, shading);
        });
    addForwardPass(graph, in, sum, "forward-multipass", Surfaces::added, false)
        .pass.record([&scene = in.scene, shading = forwardShading(in, kFragment, Surfaces::added, false),
                 multisampled = in.settings.msaa != Msaa::x1](PassContext& pass) {
            testDepth(pass, Surfaces::added);
            const std::vector<Reach> lights = reaches(scene, multisampled);
            const std::vector<OpaqueObject>& objects = scene.opaqueObjects();
            scene.drawSurfaces(pass, shading, [&](const Batch& batch) {
                const uint32_t end = batch.firstObject + batch.objectCount;
                for (const Reach& light : lights) {
                    Batch run = batch;
                    const auto draw = [&](uint32_t next) {
                        run.objectCount = next - run.firstObject;
                        if (run.objectCount > 0) scene.drawBatch(pass, run);
                        run.firstObject = next + 1;
                    };
                    pass.push(shared::LightSlice{light.light, 1});
                    pass.commands.setScissor(0, light.scissor);
                    for (uint32_t i = batch.firstObject; i < end; ++i)
                        if (!touches(light, scene, objects[i])) draw(i);
                    draw(end);
                }
            });
        });
    addBlendedLoop(graph, in, sum);
}

}  // namespace luciole::render
