#include "reference/bounce.hpp"

#include <algorithm>
#include <cmath>

#include "reference/camera_rays.hpp"

namespace luciole::reference {
namespace {

/// The share of light that a surface throws back evenly.
dvec3 albedo(const SurfacePoint& surface) {
    switch (surface.equation) {
        case LightEquation::shaped: return surface.Cs0;
        case LightEquation::metallicRoughness: return surface.Cs0 * (1 - surface.metallic);
        case LightEquation::unlit: return dvec3(0);
    }
    return dvec3(0);
}

View viewOf(const Light& light, uint32_t side) {
    View view{.extent = uvec2(side)};
    view.camera.worldFromView = lookAt(vec3(0), light.directionWorld);
    view.camera.worldFromView[3] = vec4(light.positionWorld, 1);
    view.camera.yFov = 2 * light.outerConeAngle;
    view.camera.zNear = 0.01f;
    return view;
}

}  // namespace

Arrival Patch::arrivalAt(dvec3 pointWorld) const {
    const dvec3 toPatch = positionWorld - pointWorld;
    const double distanceSquared = dot(toPatch, toPatch);
    if (!(distanceSquared > 0)) return {dvec3(0), dvec3(0)};
    const dvec3 L = toPatch / std::sqrt(distanceSquared);
    return {L, intensity * (std::max(-dot(L, N), 0.0) / (distanceSquared + radiusSquared))};
}

std::vector<Patch> patchesOf(const Scene& scene, const Visibility& visibility, const Surfaces& surfaces, const Light& light,
                             const LightSource& source, uint32_t side) {
    const CameraRays rays(viewOf(light, side));
    const double width = 2 * std::tan(double(light.outerConeAngle)) / side;
    std::vector<Patch> patches;
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            const Ray ray = rays.through(x, y);
            const auto footprint = [&](const Hit& hit) {
                return footprintOf(rays, x, y, hit, visibility.triangleWorld(hit.object, hit.triangle));
            };
            const auto hides = [&](const Hit& hit) {
                const AlphaMode mode = scene.materials[scene.objects[hit.object].material].alphaMode;
                return mode != AlphaMode::blend && surfaces.isThere(hit, footprint(hit));
            };
            const auto hit = visibility.closest(ray.origin, ray.direction, rays.nearest(), hides);
            if (!hit || !source.touches(scene.objects[hit->object].objectId)) continue;
            const SurfacePoint surface = surfaces.pointAt(*hit, footprint(*hit));
            const auto arrival = source.arrivalAt(surface.P);
            const double cosIncidence = arrival ? dot(surface.N, arrival->L) : 0;
            if (!(cosIncidence > 0)) continue;
            const double solidAngle = width * width / std::pow(dot(ray.direction, ray.direction), 1.5);
            const dvec3 toSurface = surface.P - ray.origin;
            const double across = dot(toSurface, toSurface) * solidAngle;  // area of the patch as the light sees it
            patches.push_back({.positionWorld = surface.P,
                               .N = surface.N,
                               .intensity = albedo(surface) / kPi * arrival->E * across,
                               .radiusSquared = across / std::max(cosIncidence, 0.1) / kPi});
        }
    return patches;
}

}  // namespace luciole::reference
