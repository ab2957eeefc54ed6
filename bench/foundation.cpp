// The figures of docs/performance.md: what a frame of the hall costs, pass by pass, and what one light costs at one pixel.
//   luciole_bench [FRAMES] [WIDTHxHEIGHT]      defaults: 10 frames, 1024x768
#include <luciole/error.hpp>
#include <luciole/renderer.hpp>
#include <luciole/scene_io.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>

namespace {

using namespace luciole;

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

/// Milliseconds by pass, one entry per frame.
using Samples = std::map<std::string, std::vector<double>>;

double sumOf(const Samples& samples, double (*reduce)(std::vector<double>)) {
    double sum = 0;
    for (const auto& [name, values] : samples) sum += reduce(values);
    return sum;
}

double least(std::vector<double> values) { return *std::ranges::min_element(values); }

void printPasses(const Samples& samples) {
    for (const auto& [name, values] : samples)
        fmt::print("  {:<24} {:>10.2f} {:>10.2f}\n", name, median(values), least(values));
}

void benchLights(Renderer& renderer, uint32_t lights, int frames, uvec2 extent) {
    const Scene scene = loadScene(fmt::format("builtin:hall?lights={}&overlap=4&triangles=40000&seed=1", lights));
    renderer.setScene(scene);
    const View view{scene.cameras.at(0), extent};
    std::vector<std::string> techniques;
    for (const LightingTechniqueInfo& technique : lightingTechniques())
        if (technique.name != "reference") techniques.emplace_back(technique.name);
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

int main(int argc, char** argv) {
    try {
        int frames = 10;
        uvec2 extent(1024, 768);
        char rest = 0;
        if (argc > 1 && (std::sscanf(argv[1], "%d%c", &frames, &rest) != 1 || frames < 1))
            throw Error(ErrorKind::usage, fmt::format("expected a number of frames >= 1, got \"{}\"", argv[1]));
        if (argc > 2 && std::sscanf(argv[2], "%5ux%5u%c", &extent.x, &extent.y, &rest) != 2)
            throw Error(ErrorKind::usage, fmt::format("expected WIDTHxHEIGHT, got \"{}\"", argv[2]));
        Renderer renderer;
        fmt::print("{}, {}; {}x{}; builtin:hall, overlap 4, 40,000 triangles; {} frames, interleaved\n", renderer.device().name,
                   renderer.device().driver, extent.x, extent.y, frames);
        for (const uint32_t lights : {16u, 64u, 255u}) benchLights(renderer, lights, frames, extent);
        return 0;
    } catch (const Error& error) {
        fmt::print(stderr, "luciole_bench: error: {}\n", error.what());
        return int(error.kind());
    } catch (const std::exception& error) {
        fmt::print(stderr, "luciole_bench: error: {}\n", error.what());
        return 1;
    }
}
