#include <luciole/scene_io.hpp>

#include <fmt/format.h>

#include <chrono>
#include <random>

#include "suites.hpp"

namespace luciole::bench {

// Lights of 0.5 m in a cube that keeps their density, so that only their number differs from row to row.
void benchMovingLights(Renderer& renderer, const Options& options) {
    const Scene scene = loadScene("builtin:hall?lights=1&triangles=40000&seed=1");
    const View view{scene.cameras.at(0), options.extent};
    fmt::print("\n| lights | set all anew, ms: median (least) | the frame after it, tiled-points, ms |\n| ---: | ---: | ---: |\n");
    for (const size_t count : {1024, 65536, 1048576}) {
        renderer.setScene(scene);
        std::mt19937 random(1);
        std::uniform_real_distribution<float> place(0, float(std::cbrt(double(count))));
        std::vector<Light> lights(count, Light{.color = vec3(0.1f), .range = 0.5f});
        std::vector<double> setMs, frameMs;
        for (int frame = 0; frame <= options.frames; ++frame) {
            for (Light& light : lights) light.positionWorld = vec3(place(random), place(random), place(random));
            const auto start = std::chrono::steady_clock::now();
            renderer.setLights(lights);
            const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
            const Frame rendered = renderer.render(view, {.lighting = "tiled-points"});
            if (frame == 0) continue;  // makes the frame graph, and memory for so many lights
            setMs.push_back(taken.count());
            frameMs.push_back(rendered.stats.wallMs);
        }
        fmt::print("| {} | {:.1f} ({:.1f}) | {:.0f} ({:.0f}) |\n", count, median(setMs), least(setMs), median(frameMs), least(frameMs));
    }
}

}  // namespace luciole::bench
