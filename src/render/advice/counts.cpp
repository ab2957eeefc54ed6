#include "render/advice/counts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "frame/pass_context.hpp"
#include "render/lighting/light_volume.shared.h"
#include "render/lighting/techniques.hpp"

namespace luciole::render {

using frame::Access;
using frame::BufferId;
using frame::FrameGraph;
using frame::ImageId;
using frame::PassContext;
using namespace shared;

namespace {

constexpr uint32_t kReduction = 4;      // of width and height
constexpr uint32_t kTile = 4;           // pixels of the small picture a side: 16 of the picture
constexpr double kSlicesPerOctave = 4;
constexpr uint32_t kTilesCounted = 600; // about; all tiles' surfaces are known, pairs are counted in so many

/// A light's shape where it is seen.
struct SeenShape {
    LightShape shape;
    vec4 ball;       ///< around it
    vec4 rectangle;  ///< in the picture, [0, 1]: low x, low y, high x, high y
    float nearest;   ///< depth along the view axis, metres, of its closest point
    bool ballOnly;   ///< or a sector of it
    bool frontFaces; ///< are drawn, not back faces
};

struct SeenShapes {
    std::vector<SeenShape> shapes;
    double triangles = 0;
};

vec4 inPicture(vec4 bounds) { return clamp(bounds * 0.5f + 0.5f, 0.0f, 1.0f); }

SeenShapes seenShapes(const SmallPicture& picture, const ViewConstants& view, const SortedLights& sorted, const VolumeTables& volumes) {
    SeenShapes seen;
    for (uint32_t i = sorted.unbounded; i < picture.lightsInView.size(); ++i) {
        const LightConstants& light = picture.lightsInView[i];
        if (light.volume != kNoIndex) {
            const vec4 ball = volumeBall(view, volumes.volumes[light.volume]);
            const vec4 bounds = projectedBounds(view, ball);
            if (!coversPixel(bounds, view.extent)) continue;
            seen.shapes.push_back({{vec3(ball), vec3(0, 0, 1), ball.w, kHalfTurn}, ball, inPicture(bounds), -ball.z - ball.w, true, false});
            seen.triangles += volumes.volumes[light.volume].vertexCount / 3.0;
            continue;
        }
        const LightShape plain = lightShape(light);
        const LightShape shape = inflate(plain, slackOf(view, plain));
        const ShapeBounds bounds = shapeBounds(view, shape);
        if (!coversPixel(bounds.rectangle, view.extent)) continue;
        const VolumeDraw draw = volumeDraw(view, light);
        seen.shapes.push_back({shape, boundingBall(shape), inPicture(bounds.rectangle), bounds.depth, shape.angle >= kHalfTurn, draw.frontFaces});
        seen.triangles += volumeIndexCount(draw.lod) / 3.0;
    }
    return seen;
}

bool holds(const LightShape& shape, vec3 p) {
    const vec3 toPoint = p - shape.apex;
    const float distance = length(toPoint);
    return distance < shape.radius && dot(toPoint, shape.axis) >= distance * std::cos(shape.angle);
}

struct Ray {
    vec3 origin, direction;
};

/// Where the ray is in the shape, from `x` to `y`; x > y: nowhere. In a sector as far as a few points tell.
vec2 within(const SeenShape& light, const Ray& ray) {
    const vec2 nowhere(1, -1);
    const vec3 toCenter = vec3(light.ball) - ray.origin;
    const float middle = dot(toCenter, ray.direction);
    const float half2 = light.ball.w * light.ball.w - dot(toCenter, toCenter) + middle * middle;
    if (half2 <= 0 || middle + std::sqrt(half2) <= 0) return nowhere;
    const float half = std::sqrt(half2);
    if (light.ballOnly) return {middle - half, middle + half};
    constexpr int kSteps = 8;
    vec2 inside = nowhere;
    for (int i = 0; i < kSteps; ++i) {
        const float t = middle + half * (2 * (float(i) + 0.5f) / kSteps - 1);
        if (!holds(light.shape, ray.origin + t * ray.direction)) continue;
        const float end = half / kSteps;
        inside = inside.x > inside.y ? vec2(t - end, t + end) : vec2(inside.x, t + end);
    }
    return inside;
}

/// Around the surfaces of some pixels.
struct Box {
    vec3 low{INFINITY}, high{-INFINITY};
    uint32_t pixels = 0;

    void add(vec3 p) {
        low = min(low, p);
        high = max(high, p);
        ++pixels;
    }
    /// The pixels, if the ball meets the box.
    uint32_t pixelsMet(vec4 ball) const {
        const vec3 center(ball);
        return pixels > 0 && distance(center, clamp(center, low, high)) < ball.w ? pixels : 0;
    }
};

/// Pixels of the small picture, and lights that may matter there.
struct Tile {
    uvec2 low, high;  ///< pixels [low, high)
    std::vector<const SeenShape*> shapes = {};
};

class Counting {
public:
    Counting(const SmallPicture& picture, const ViewConstants& view, const SortedLights& sorted, const VolumeTables& volumes)
        : picture_(picture), view_(view), seen_(seenShapes(picture, view, sorted, volumes)) {}

    SceneCounts count() {
        const uvec2 tiles = (picture_.extent + kTile - 1u) / kTile;
        const uint32_t all = tiles.x * tiles.y, stride = (all / kTilesCounted) | 1u;  // odd, to meet all columns
        uint64_t counted = 0;
        for (uint32_t i = stride / 2; i < all; i += stride) counted += countTile({i % tiles.x, i / tiles.x});
        // Pairs are known where they were counted, surfaces everywhere.
        const double pixels = double(view_.extent.x) * view_.extent.y;
        const double pairScale = counted > 0 ? pixels / double(counted) : 0;
        for (double SceneCounts::*pairs : {&SceneCounts::inRectangle, &SceneCounts::behindNearest, &SceneCounts::onShape, &SceneCounts::behindFront,
                                           &SceneCounts::beforeBack, &SceneCounts::behindFace, &SceneCounts::surfaceBehindFront,
                                           &SceneCounts::blendedBehindFront, &SceneCounts::reaching, &SceneCounts::inTile, &SceneCounts::inCluster})
            counts_.*pairs *= pairScale;
        const double scale = pixels / double(picture_.depth.size());
        for (uint32_t i = 0; i < picture_.depth.size(); ++i) {
            counts_.covered += scale * (picture_.depth[i] > 0);
            if (picture_.depth[i] > 0)
                counts_.meanDistance -= scale * positionAt({i % picture_.extent.x, i / picture_.extent.x}, picture_.depth[i]).z;
            counts_.fragments += scale * picture_.fragments[i];
            counts_.blended += scale * picture_.blended[i];
        }
        if (counts_.covered > 0) counts_.meanDistance /= counts_.covered;
        counts_.pixels = pixels;
        counts_.visible = double(seen_.shapes.size());
        counts_.shapeTriangles = seen_.triangles;
        return counts_;
    }

private:
    vec3 positionAt(uvec2 pixel, float depth) const {
        // Shading space has its origin at the eye and the world's axes.
        const vec4 p = view_.shadingFromGBuffer * vec4((vec2(pixel) + 0.5f) / vec2(picture_.extent), depth, 1);
        return transpose(mat3(view_.worldFromView)) * (vec3(p) / p.w);
    }

    float depthAt(uvec2 pixel) const { return picture_.depth[size_t(pixel.y) * picture_.extent.x + pixel.x]; }

    template <typename Visit>
    static void forEachPixel(const Tile& tile, const Visit& visit) {
        for (uint32_t y = tile.low.y; y < tile.high.y; ++y)
            for (uint32_t x = tile.low.x; x < tile.high.x; ++x) visit(uvec2(x, y));
    }

    /// \return pixels
    uint64_t countTile(uvec2 at) {
        Tile tile{at * kTile, min((at + 1u) * kTile, picture_.extent)};
        Box whole;
        std::map<int, Box> slices;
        forEachPixel(tile, [&](uvec2 pixel) {
            if (!(depthAt(pixel) > 0)) return;
            const vec3 p = positionAt(pixel, depthAt(pixel));
            whole.add(p);
            slices[view_.orthographic != 0 ? 0 : int(std::floor(kSlicesPerOctave * std::log2(std::max(-p.z, 1e-20f))))].add(p);
        });
        const vec2 low = vec2(tile.low) / vec2(picture_.extent), high = vec2(tile.high) / vec2(picture_.extent);
        for (const SeenShape& light : seen_.shapes) {
            if (light.rectangle.x >= high.x || light.rectangle.z <= low.x || light.rectangle.y >= high.y || light.rectangle.w <= low.y) continue;
            tile.shapes.push_back(&light);
            counts_.inTile += whole.pixelsMet(light.ball);
            for (const auto& [index, slice] : slices) counts_.inCluster += slice.pixelsMet(light.ball);
        }
        forEachPixel(tile, [&](uvec2 pixel) { countPixel(tile, pixel); });
        return uint64_t(tile.high.x - tile.low.x) * (tile.high.y - tile.low.y);
    }

    void countPixel(const Tile& tile, uvec2 pixel) {
        const vec3 near = positionAt(pixel, 1);
        const Ray ray = view_.orthographic != 0 ? Ray{near, vec3(0, 0, -1)} : Ray{vec3(0), normalize(near)};
        const bool covered = depthAt(pixel) > 0;
        const vec3 surface = covered ? positionAt(pixel, depthAt(pixel)) : vec3(0, 0, -INFINITY);
        const float far = covered ? dot(surface - ray.origin, ray.direction) : INFINITY;
        const vec2 uv = (vec2(pixel) + 0.5f) / vec2(picture_.extent);
        uint32_t reaching = 0, before = 0;
        for (const SeenShape* light : tile.shapes) {
            const vec4 r = light->rectangle;
            if (uv.x < r.x || uv.x > r.z || uv.y < r.y || uv.y > r.w) continue;
            ++counts_.inRectangle;
            counts_.behindNearest += -surface.z >= light->nearest;
            const vec2 inside = within(*light, ray);
            if (inside.x > inside.y) continue;
            ++counts_.onShape;
            before += inside.x <= far;
            counts_.beforeBack += inside.y >= far;
            counts_.behindFace += light->frontFaces ? inside.x <= far : inside.y >= far;
            reaching += covered && holds(light->shape, surface);
        }
        counts_.behindFront += before;
        counts_.surfaceBehindFront += covered ? before : 0;
        counts_.blendedBehindFront += float(before) * picture_.blended[size_t(pixel.y) * picture_.extent.x + pixel.x];
        counts_.reaching += reaching;
        counts_.mostBefore = std::max(counts_.mostBefore, before);
        counts_.mostReaching = std::max(counts_.mostReaching, reaching);
    }

    const SmallPicture& picture_;
    const ViewConstants& view_;
    const SeenShapes seen_;
    SceneCounts counts_;
};

}  // namespace

SceneCounts countPairs(const SmallPicture& picture, const ViewConstants& view, const SortedLights& sorted, const VolumeTables& volumes) {
    SceneCounts counts = Counting(picture, view, sorted, volumes).count();
    counts.lights = double(sorted.sources.size());
    counts.unbounded = sorted.unbounded;
    counts.meshBounded = sorted.meshes;
    return counts;
}

namespace {

/// Copies one component of an image, 32 bits, into a buffer that the host reads.
BufferId addReadback(FrameGraph& graph, const std::string& name, ImageId image, vk::ImageAspectFlags aspect) {
    const vk::Extent2D extent = graph.descOf(image).extent;
    const BufferId buffer = graph.createBuffer(name, uint64_t(extent.width) * extent.height * sizeof(float));
    graph.addPass("counting." + name)
        .read(image, Access::transferRead)
        .write(buffer, Access::transferWrite)
        .record([=](PassContext& pass) {
            pass.commands.copyImageToBuffer(pass.image(image), vk::ImageLayout::eTransferSrcOptimal, pass.buffer(buffer),
                                            vk::BufferImageCopy{.imageSubresource = {aspect, 0, 0, 1}, .imageExtent = {extent.width, extent.height, 1}});
        });
    graph.output(buffer);
    return buffer;
}

}  // namespace

SceneCounts countScene(const gpu::Context& context, gpu::Pipelines& pipelines, GpuScene& scene, const View& view,
                       const RenderSettings& settings, GBufferLayout layout) {
    const uvec2 small = max(view.extent / kReduction, uvec2(1));
    const vk::Extent2D extent{small.x, small.y};
    FrameGraph graph;
    const ImageId depth = graph.createImage("depth", {vk::Format::eD32Sfloat, extent});
    const ImageId fragments = graph.createImage("fragments", {vk::Format::eR32Sfloat, extent});
    const ImageId blended = graph.createImage("blended", {vk::Format::eR32Sfloat, extent});
    const vk::ClearValue none = vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f);
    const SurfaceShading counting{.fragment = "render/geometry/fragment_count.frag",
                                  .frame = {uint32_t(layout), scene.equations(), scene.lightFeatures()},
                                  .blend = gpu::Blend::add};
    graph.addPass("counting.surfaces")
        .clear(fragments, Access::colorBlend, none)
        .clear(depth, Access::depthWrite, vk::ClearDepthStencilValue{0.0f, 0})
        .record([&scene, counting](PassContext& pass) {
            pass.depth(vk::CompareOp::eGreaterOrEqual, true);
            scene.drawSurfaces(pass, counting);
        });
    graph.addPass("counting.blended")
        .clear(blended, Access::colorBlend, none)
        .read(depth, Access::depthTest)
        .record([&scene, counting](PassContext& pass) {
            pass.depth(vk::CompareOp::eGreaterOrEqual, false);
            if (scene.hasBlended()) scene.drawBlended(pass, {counting});
        });
    const BufferId depthRead = addReadback(graph, "read-depth", depth, vk::ImageAspectFlagBits::eDepth);
    const BufferId fragmentsRead = addReadback(graph, "read-fragments", fragments, vk::ImageAspectFlagBits::eColor);
    const BufferId blendedRead = addReadback(graph, "read-blended", blended, vk::ImageAspectFlagBits::eColor);
    // From the device, where the lights of a bounce are made.
    const BufferId lights = graph.importBuffer("lights", scene.lightTableBytes(), scene.lightTable());
    if (scene.bounce()) addBounce(graph, scene, lights);
    const BufferId lightsInView = graph.createBuffer("lights-in-view", std::max<uint64_t>(scene.lightCount(), 1) * sizeof(LightConstants));
    graph.addPass("counting.lights-in-view")
        .read(lights, Access::computeTableRead)
        .write(lightsInView, Access::computeStorageWrite, 0)
        .record([constants = counting.frame, groups = (scene.lightCount() + 63) / 64](PassContext& pass) {
            if (groups > 0) pass.dispatch("render/lighting/lights_in_view.comp", constants, groups);
        });
    graph.output(lightsInView);

    frame::Executor executor(context, pipelines, std::move(graph));
    scene.setView({view.camera, small}, settings, layout);
    executor.run(scene.frameSet(), false);
    scene.setView(view, settings, layout);
    const SmallPicture picture{.extent = small,
                               .depth = executor.read<float>(depthRead),
                               .fragments = executor.read<float>(fragmentsRead),
                               .blended = executor.read<float>(blendedRead),
                               .lightsInView = executor.read<LightConstants>(lightsInView).first(scene.lightCount())};
    SceneCounts counts = countPairs(picture, scene.view(), scene.lights(), scene.volumes());
    counts.triangles = double(scene.triangles());
    return counts;
}

}  // namespace luciole::render
