#include "halls.hpp"

#include <luciole/scene_io.hpp>

#include <fmt/format.h>

#include <cmath>

namespace luciole::bench {
namespace {

/// Point `i` of a sequence that fills the unit cube evenly, however many are taken (Roberts 2018, "The Unreasonable Effectiveness of
/// Quasirandom Sequences").
vec3 spread(uint32_t i) {
    const dvec3 step(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
    return vec3(glm::fract(0.5 + double(i) * step));
}

double meanOverlap(Renderer& renderer, const Scene& scene) {
    renderer.setScene(scene);
    const Frame frame = renderer.render({scene.cameras.at(0), {160, 120}}, {}, {"light-count", "depth"});
    double reached = 0, covered = 0;
    for (const float count : frame.aovs.at("light-count").data) reached += count;
    for (const float depth : frame.aovs.at("depth").data) covered += depth > 0;
    return reached / covered;
}

void scaleRanges(Scene& scene, const std::vector<Light>& lights, float factor) {
    for (size_t i = 0; i < lights.size(); ++i) scene.lights[i].range = factor * lights[i].range;
}

}  // namespace

Scene builtinHall(uint32_t lights, double overlap) {
    return loadScene(fmt::format("builtin:hall?lights={}&overlap={}&triangles=40000&seed=1&gltf=1", lights, overlap));
}

Scene hallOfFile(Renderer& renderer, const std::string& folder, uint32_t lights, double overlap) {
    Scene scene = loadScene(fmt::format("{}/hall-{}-o4.glb", folder, lights > 255 ? 1024 : 255));
    const std::vector<Light> own = scene.lights;
    while (scene.lights.size() < lights) {
        const auto i = uint32_t(scene.lights.size());
        Light light = own[i % own.size()];
        light.positionWorld += light.range * (spread(i) - 0.5f);
        scene.lights.push_back(light);
    }
    if (overlap == 4 && scene.lights.size() == own.size()) return scene;
    const std::vector<Light> before = scene.lights;
    float low = 0.01f, high = 4;
    while (high / low > 1.001f) {
        const float middle = std::sqrt(low * high);
        scaleRanges(scene, before, middle);
        (meanOverlap(renderer, scene) < overlap ? low : high) = middle;
    }
    return scene;
}

Scene hallInWorld(uint32_t visible, uint32_t lights) {
    Scene scene = builtinHall(visible, 4);
    const float range = scene.lights.front().range;
    for (uint32_t i = 0; scene.lights.size() < lights; ++i) {
        // As dense as in the hall, if there are a million; the walls and some air stay free.
        const vec3 position = (spread(i) - vec3(0.5f, 0, 0.5f)) * vec3(800, 10, 800);
        const vec3 low(-10, 0, -50), high(10, 12, 2);
        const vec3 away = position - glm::clamp(position, low, high);
        if (glm::length(away) <= range) continue;
        Light light = scene.lights[i % visible];
        light.name.clear();
        light.positionWorld = position;
        scene.lights.push_back(light);
    }
    return scene;
}

}  // namespace luciole::bench
