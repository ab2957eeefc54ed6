#include <luciole/scene_io.hpp>

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "suites.hpp"

namespace luciole::bench {
namespace {

/// What the settings and the scene of a row are; pixels as a share of the whole extent.
struct Configuration {
    std::string uri;
    bool blended = false;
    Msaa msaa = Msaa::x1;
    uint32_t divisor = 1;  ///< of the extent's sides
    bool outside = false;  ///< seen whole, from outside
};

std::vector<Configuration> grid() {
    std::vector<Configuration> rows;
    const auto hall = [](uint32_t lights, double overlap, uint32_t triangles) {
        return fmt::format("builtin:hall?lights={}&overlap={}&triangles={}&seed=2", lights, overlap, triangles);
    };
    // Lights and overlap; one light can't reach a surface more than once.
    for (const uint32_t lights : {1u, 16u, 64u, 255u, 1024u, 4096u})
        for (const double overlap : {1.0, 4.0, 16.0}) {
            if (lights == 1 && overlap > 1) continue;
            for (const uint32_t divisor : {1u, 2u}) {
                rows.push_back({.uri = hall(lights, overlap, 40'000), .divisor = divisor});
                if (overlap != 16) rows.push_back({.uri = hall(lights, overlap, 10'000), .blended = true, .divisor = divisor * 2});
            }
            if (overlap != 1 || lights == 1) rows.push_back({.uri = hall(lights, overlap, 10'000), .msaa = Msaa::x4, .divisor = 2});
        }
    for (const uint32_t lights : {16u, 255u, 1024u}) {
        rows.push_back({.uri = hall(lights, 4, 100'000), .divisor = 2});
        rows.push_back({.uri = hall(lights, 4, 10'000), .divisor = 2, .outside = true});
        rows.push_back({.uri = fmt::format("builtin:fireflies?lights={}", lights), .divisor = 2});
    }
    rows.push_back({.uri = "builtin:materials", .divisor = 1});
    rows.push_back({.uri = "builtin:materials", .divisor = 2});
    return rows;
}

Scene sceneOf(const Configuration& row) {
    Scene scene = loadScene(row.uri);
    for (size_t i = 0; row.blended && i < scene.materials.size(); i += 2) {
        scene.materials[i].alphaMode = AlphaMode::blend;
        scene.materials[i].baseColor.a = 0.5f;
    }
    return scene;
}

std::string nameOf(const Configuration& row) {
    return row.uri.substr(row.uri.find(':') + 1) + (row.blended ? ", half of the materials blend" : "") + (row.outside ? ", from outside" : "") +
           (row.msaa == Msaa::x4 ? ", msaa 4" : "");
}

constexpr double kHopeless = 4;  // times the predicted best: not measured

/// Milliseconds by technique: the least of `frames`, taken in turns.
std::map<std::string, double> measure(Renderer& renderer, const View& view, const RenderSettings& settings, const LightingAdvice& advice, int frames) {
    std::map<std::string, double> least;
    for (int i = 0; i < frames; ++i)
        for (const TechniqueAdvice& row : advice.techniques) {
            if (!row.predictedMs || *row.predictedMs > kHopeless * *advice.techniques.front().predictedMs) continue;
            RenderSettings with = settings;
            with.lighting = row.technique;
            renderer.render(view, with);  // compiles shaders, and finds out how many lights there are to index
            const double ms = renderer.render(view, with).stats.wallMs;
            double& best = least.try_emplace(row.technique, HUGE_VAL).first->second;
            best = std::min(best, ms);
        }
    return least;
}

}  // namespace

void benchAdvice(Renderer& renderer, const Options& options) {
    fmt::print("\nTechniques that are predicted to take more than {} times as long as the best are not measured.\n\n"
               "| scene | size | chosen | predicted, ms | measured, ms | best | measured, ms | off | error of the predictions |\n"
               "| --- | --- | --- | ---: | ---: | --- | ---: | ---: | ---: |\n",
               kHopeless);
    int rows = 0, within = 0;
    double calibrationMs = 0;
    uint32_t calibrationFrames = 0;
    for (const Configuration& row : grid()) {
        const Scene scene = sceneOf(row);
        renderer.setScene(scene);
        const View view{row.outside || scene.cameras.empty() ? autoCamera(scene) : scene.cameras[0], options.extent / row.divisor};
        const RenderSettings settings{.msaa = row.msaa};
        const LightingAdvice advice = renderer.advise(view, settings);
        calibrationMs += advice.calibrationMs;
        calibrationFrames += advice.calibrationFrames;
        const auto measured = measure(renderer, view, settings, advice, options.frames);
        const auto best = std::ranges::min_element(measured, {}, [](const auto& entry) { return entry.second; });
        const double chosen = measured.at(advice.technique), off = chosen / best->second - 1;
        double error = 0;
        for (const TechniqueAdvice& technique : advice.techniques)
            if (measured.contains(technique.technique)) error += std::abs(*technique.predictedMs / measured.at(technique.technique) - 1);
        ++rows;
        within += off <= 0.1;
        fmt::print("| {} | {}x{} | {} | {:.1f} | {:.1f} | {} | {:.1f} | {:.0f} % | {:.0f} % |\n", nameOf(row), view.extent.x, view.extent.y, advice.technique,
                   *advice.techniques.front().predictedMs, chosen, best->first, best->second, 100 * off, 100 * error / double(measured.size()));
        std::fflush(stdout);
    }
    fmt::print("\nThe choice is within 10 % of the measured best in {} of {} configurations, {:.0f} %. Calibration: {} frames, {:.1f} s.\n", within, rows,
               100.0 * within / rows, calibrationFrames, calibrationMs / 1000);
}

}  // namespace luciole::bench
