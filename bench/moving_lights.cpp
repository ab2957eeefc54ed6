#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "halls.hpp"
#include "suites.hpp"

namespace luciole::bench {
namespace {

constexpr uint32_t kMoving = 65536;

/// All lights, each elsewhere on a circle around its place and in another brightness.
std::vector<Light> moved(std::vector<Light> lights, int frame) {
    for (size_t i = 0; i < lights.size(); ++i) {
        const float angle = float(i) + 0.4f * float(frame);
        lights[i].positionWorld += 0.2f * vec3(std::cos(angle), std::sin(2 * angle), std::sin(angle));
        lights[i].color *= 1 + 0.2f * std::sin(3 * angle);
    }
    return lights;
}

/// What it takes to hand over the lights: they are checked, sorted along the curve, put into the hierarchy and copied.
double setLightsMs(Renderer& renderer, const std::vector<Light>& lights) {
    const auto start = std::chrono::steady_clock::now();
    renderer.setLights(lights);
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

struct Motion {
    std::vector<double> setMs, frameMs, stillMs;
};

/// A frame before the lights move and one after, so that both meet the same machine.
Motion measureMotion(Renderer& renderer, const Scene& scene, const View& view, const RenderSettings& settings, int frames) {
    Motion motion;
    renderer.setLights(moved(scene.lights, 0));
    renderer.render(view, settings);
    for (int frame = 1; frame <= frames; ++frame) {
        const std::vector<Light> lights = moved(scene.lights, frame);
        motion.stillMs.push_back(renderer.render(view, settings).stats.wallMs);
        motion.setMs.push_back(setLightsMs(renderer, lights));
        motion.frameMs.push_back(renderer.render(view, settings).stats.wallMs);
    }
    return motion;
}

}  // namespace

void benchMovingLights(Renderer& renderer, const Options& options) {
    fmt::print("\n| lights | all set anew, ms: median (least) |\n| ---: | ---: |\n");
    for (const uint32_t lights : {1024u, 65536u, 1048576u}) {
        const Scene scene = builtinHall(lights, 4);
        renderer.setScene(scene);
        std::vector<double> ms;
        for (int frame = 0; frame < options.frames; ++frame) ms.push_back(setLightsMs(renderer, moved(scene.lights, frame)));
        fmt::print("| {} | {} |\n", lights, milliseconds(ms));
    }
    fmt::print("\n| {} lights, overlap 4 | all set anew, ms: median (least) | the frame after it, ms | a frame before it, ms |\n| --- | ---: | ---: | ---: |\n", kMoving);
    const Scene scene = builtinHall(kMoving, 4);
    renderer.setScene(scene);
    for (const Contender& contender : listContenders()) {
        const Motion motion = measureMotion(renderer, scene, {scene.cameras.at(0), options.extent}, contender.settings, options.frames);
        fmt::print("| {} | {} | {} | {} |\n", contender.name, milliseconds(motion.setMs), milliseconds(motion.frameMs), milliseconds(motion.stillMs));
        std::fflush(stdout);
    }
}

}  // namespace luciole::bench
