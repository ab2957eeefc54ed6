#include <luciole/reference.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <luciole/error.hpp>

#include "output/display.hpp"
#include "output/fingerprint.shared.h"
#include "output/request.hpp"
#include "parallel/parallel_rows.hpp"
#include "reference/bounce.hpp"
#include "reference/camera_rays.hpp"
#include "reference/lights.hpp"
#include "reference/surface.hpp"
#include "scene/visibility.hpp"

namespace luciole {
namespace reference {
namespace {

/// All that is known of a pixel; as made, where nothing is. Radiance, evaluations and fingerprint are of all that it
/// shows, the rest is of the surface that doesn't blend.
struct Pixel {
    dvec3 radiance{0};
    double depth = 0;
    dvec3 normal{0};
    dvec3 Cs0{0}, Cs1{0};
    double material = -1, id = -1;
    double lightCount = 0;
    double evaluations = 0, usefulEvaluations = 0, fingerprint = 0;
};

struct Aov {
    std::string_view name;
    uint32_t channels;
    dvec3 (*value)(const Pixel&);
};

constexpr std::array kAovs{
    Aov{"depth", 1, [](const Pixel& p) { return dvec3(p.depth); }},
    Aov{"normal", 3, [](const Pixel& p) { return p.normal; }},
    Aov{"cs0", 3, [](const Pixel& p) { return p.Cs0; }},
    Aov{"cs1", 3, [](const Pixel& p) { return p.Cs1; }},
    Aov{"material", 1, [](const Pixel& p) { return dvec3(p.material); }},
    Aov{"id", 1, [](const Pixel& p) { return dvec3(p.id); }},
    Aov{"light-count", 1, [](const Pixel& p) { return dvec3(p.lightCount); }},
    Aov{"evaluations", 1, [](const Pixel& p) { return dvec3(p.evaluations); }},
    Aov{"useful-evaluations", 1, [](const Pixel& p) { return dvec3(p.usefulEvaluations); }},
    Aov{"light-fingerprint", 1, [](const Pixel& p) { return dvec3(p.fingerprint); }},
};

/// \param name one of aovNames() that the reference has, checked
const Aov& aovNamed(const std::string& name) {
    return *std::find_if(kAovs.begin(), kAovs.end(), [&](const Aov& aov) { return aov.name == name; });
}

void store(Image& image, uint32_t x, uint32_t y, dvec3 value) {
    for (uint32_t c = 0; c < image.channels; ++c) image.at(x, y, c) = float(value[int(c)]);
}

/// The whole renderer: geometry phase and lighting phase of one pixel after the other.
class Picture {
public:
    Picture(const Scene& scene, const View& view, const RenderSettings& settings)
        : scene_(scene),
          rays_(view),
          visibility_(scene),
          tables_(scene),
          surfaces_(scene, tables_),
          volumes_(volumesOf(scene)),
          lights_(lightSources(scene, tables_, volumes_)),
          anyBlends_(std::ranges::count(scene.materials, AlphaMode::blend, &Material::alphaMode) > 0),
          shadows_(settings.shadows != Shadows::off),
          bounce_(bouncingLight(scene.lights, settings)) {
        constexpr uint32_t kFiner = 4;  // a side: patches are small against what they light, and the picture does not depend on them
        if (bounce_) patches_ = patchesOf(scene, visibility_, surfaces_, scene.lights[*bounce_], lights_[*bounce_], kFiner * settings.bounceGrid);
    }

    Pixel at(uint32_t x, uint32_t y) const {
        const Ray ray = rays_.through(x, y);
        const auto footprint = [&](const Hit& hit) {
            return footprintOf(rays_, x, y, hit, visibility_.triangleWorld(hit.object, hit.triangle));
        };
        const auto blends = [&](const Hit& hit) { return alphaModeOf(hit) == AlphaMode::blend; };
        const auto hides = [&](const Hit& hit) {
            const AlphaMode mode = alphaModeOf(hit);
            return mode == AlphaMode::opaque || (mode == AlphaMode::mask && surfaces_.isThere(hit, footprint(hit)));
        };
        const auto hit = visibility_.closest(ray.origin, ray.direction, rays_.nearest(), hides);
        const bool found = hit && hit->t <= rays_.farthest();
        Pixel pixel = found ? shaded(*hit, surfaces_.pointAt(*hit, footprint(*hit))) : Pixel{};
        if (!anyBlends_) return pixel;
        const double last = found ? hit->t : rays_.farthest();
        for (const Hit& layer : visibility_.allBetween(ray.origin, ray.direction, rays_.nearest(), last, blends)) {
            blend(pixel, layer, surfaces_.pointAt(layer, footprint(layer)));
        }
        return pixel;
    }

private:
    AlphaMode alphaModeOf(const Hit& hit) const {
        return scene_.materials[scene_.objects[hit.object].material].alphaMode;
    }

    /// Lays a surface that blends over what the pixel shows.
    void blend(Pixel& pixel, const Hit& hit, const SurfacePoint& surface) const {
        const Pixel layer = shaded(hit, surface);
        pixel.radiance = mix(pixel.radiance, layer.radiance, surface.alpha);
        pixel.evaluations += layer.evaluations;
        pixel.usefulEvaluations += layer.usefulEvaluations;
        pixel.fingerprint += layer.fingerprint;
    }

    Pixel shaded(const Hit& hit, const SurfacePoint& surface) const {
        const Object& object = scene_.objects[hit.object];
        Pixel pixel{.radiance = initialLight(surface, scene_.ambience),
                    .depth = hit.t,
                    .normal = surface.N,
                    .Cs0 = surface.Cs0,
                    .Cs1 = surface.Cs1,
                    .material = double(object.material),
                    .id = double(object.objectId),
                    .evaluations = double(lights_.size())};
        const dvec3 V = rays_.toEye(surface.P);
        for (uint32_t i = 0; i < lights_.size(); ++i) {
            const LightSource& light = lights_[i];
            if (!light.touches(object.objectId)) continue;
            const auto arrival = light.arrivalAt(surface.P);
            if (!arrival) continue;
            ++pixel.lightCount;
            ++pixel.usefulEvaluations;
            pixel.fingerprint += shared::fingerprint(i);
            if (shadows_ && light.castsShadows() && isShadowed(hit, surface.P, light)) continue;
            const bool farEye = light.infiniteViewer() && surface.equation == LightEquation::shaped;
            pixel.radiance += reflectedLight(surface, farEye ? rays_.backwards() : V, *arrival, light.contribution());
        }
        if (bounce_ && lights_[*bounce_].touches(object.objectId))
            for (const Patch& patch : patches_)
                pixel.radiance += reflectedLight(surface, V, patch.arrivalAt(surface.P), LightContribution::diffuseOnly);
        return pixel;
    }

    /// Whether something keeps the light off a point: a ray to the light meets a triangle that casts shadows, and that rises above the plane
    /// of the triangle that the point lies on, by more than rounding.
    bool isShadowed(const Hit& receiver, dvec3 P, const LightSource& light) const {
        const auto [path, tMax] = light.pathFrom(P);
        if (!(tMax > 0)) return false;
        const auto ground = visibility_.triangleWorld(receiver.object, receiver.triangle);
        dvec3 up = cross(ground[1] - ground[0], ground[2] - ground[0]);
        if (dot(up, path) < 0) up = -up;
        const double slack = 1e-6 * length(up) * std::max(length(P), length(ground[0]));
        const auto keepsOff = [&](const Hit& hit) {
            if (hit.object == receiver.object && hit.triangle == receiver.triangle) return false;
            const Object& object = scene_.objects[hit.object];
            const Material& material = scene_.materials[object.material];
            if (!material.castsShadows || material.alphaMode == AlphaMode::blend || !light.isCastBy(object.objectId)) return false;
            const auto rises = [&](dvec3 corner) { return dot(up, corner - P) > slack; };
            if (std::ranges::none_of(visibility_.triangleWorld(hit.object, hit.triangle), rises)) return false;
            const Footprint sharp{.weights = dvec3(1 - hit.u - hit.v, hit.u, hit.v), .dx = dvec3(0), .dy = dvec3(0)};
            return material.alphaMode != AlphaMode::mask || surfaces_.isThere(hit, sharp);
        };
        return visibility_.isBlocked(P, path, tMax, keepsOff);
    }

    const Scene& scene_;
    CameraRays rays_;
    Visibility visibility_;
    FunctionTables tables_;
    Surfaces surfaces_;
    std::vector<Volume> volumes_;
    std::vector<LightSource> lights_;
    bool anyBlends_, shadows_;
    std::optional<uint32_t> bounce_;  ///< the light that bounces
    std::vector<Patch> patches_;
};

}  // namespace
}  // namespace reference

Frame renderReference(const Scene& scene, const View& view, const RenderSettings& settings,
                      const std::vector<std::string>& aovs, const std::function<bool(double)>& progress) {
    using namespace reference;
    checkRequest(view, aovs);
    if (std::ranges::any_of(aovs, isListLayer)) throw Error(ErrorKind::usage, "aov: list-length and list-slice: the reference makes no lists of lights");
    const auto start = std::chrono::steady_clock::now();
    Frame frame;
    frame.radiance = Image(view.extent.x, view.extent.y, 3);
    std::vector<std::pair<const Aov*, Image*>> layers;
    for (const std::string& name : aovs) {
        const Aov& aov = aovNamed(name);
        Image& image = frame.aovs[name] = Image(view.extent.x, view.extent.y, aov.channels);
        layers.emplace_back(&aov, &image);
    }

    const Picture picture(scene, view, settings);
    const auto renderRow = [&](uint32_t y) {
        for (uint32_t x = 0; x < view.extent.x; ++x) {
            const Pixel pixel = picture.at(x, y);
            store(frame.radiance, x, y, pixel.radiance);
            for (const auto& [aov, image] : layers) store(*image, x, y, aov->value(pixel));
        }
    };
    if (!forEachRow(view.extent.y, renderRow, progress)) return {};

    frame.display = displayImage(frame.radiance, scene.exposureEv + settings.exposureEv, settings.toneMap);
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    frame.stats = {.passes = {{.name = "reference", .ms = wall.count()}},
                   .wallMs = wall.count(),
                   .triangles = triangleCount(scene),
                   .lights = uint32_t(scene.lights.size()),
                   .deviceName = "CPU",
                   .driver = Visibility::engine()};
    return frame;
}

}  // namespace luciole
