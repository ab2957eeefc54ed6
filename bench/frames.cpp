#include <luciole/scene_io.hpp>

#include <fmt/format.h>

#include <map>

#include "suites.hpp"

namespace luciole::bench {
namespace {

/// Milliseconds by pass, one entry per frame.
using Samples = std::map<std::string, std::vector<double>>;

template <typename Reduce>
double sumOf(const Samples& samples, const Reduce& reduce) {
    double sum = 0;
    for (const auto& [name, values] : samples) sum += reduce(values);
    return sum;
}

void printPasses(const Samples& samples) {
    for (const auto& [name, values] : samples)
        fmt::print("  {:<24} {:>10.2f} {:>10.2f}\n", name, median(values), least(values));
}

void benchLights(Renderer& renderer, uint32_t lights, int frames, uvec2 extent) {
    const Scene scene = loadScene(fmt::format("builtin:hall?lights={}&overlap=4&triangles=40000&seed=1", lights));
    renderer.setScene(scene);
    const View view{scene.cameras.at(0), extent};
    const std::string techniques[] = {"brute-force", "fullscreen"};
    std::map<std::string, Samples> samples;
    double covered = 0;
    const Frame depths = renderer.render(view, {}, {"depth"});
    for (const float depth : depths.aovs.at("depth").data) covered += depth > 0;
    // Interleaved, so that the machine's drift meets all. A change of technique makes the frame anew, and a measured frame
    // that was made anew is preceded by one that does not count.
    for (int frame = 0; frame < frames; ++frame)
        for (const std::string& technique : techniques) {
            const Frame measured = renderer.render(view, {.lighting = technique, .measure = true});
            for (const PassStats& pass : measured.stats.passes) samples[technique][pass.name].push_back(pass.ms.value());
        }
    for (const std::string& technique : techniques) {
        const Samples& rows = samples.at(technique);
        const auto& lighting = rows.at("lighting." + technique);
        const double perLightPixel = 1e6 / (double(lights) * covered);
        const double total = sumOf(rows, median);
        fmt::print("\n{} lights, {}, {:.0f} lit pixels: median, minimum in ms\n", lights, technique, covered);
        printPasses(rows);
        fmt::print("  {:<24} {:>10.2f} {:>10.2f}\n", "sum", total, sumOf(rows, least));
        fmt::print("  ns per light and pixel   {:>10.2f} {:>10.2f}\n", median(lighting) * perLightPixel, least(lighting) * perLightPixel);
        fmt::print("  outside lighting         {:>9.1f} %\n", 100 * (total - median(lighting)) / total);
    }
}

}  // namespace

void benchFrames(Renderer& renderer, const Options& options) {
    fmt::print("builtin:hall, overlap 4, 40,000 triangles\n");
    for (const uint32_t lights : {16u, 64u, 255u}) benchLights(renderer, lights, options.frames, options.extent);
}

}  // namespace luciole::bench
