#include <fmt/format.h>

#include "halls.hpp"
#include "suites.hpp"

namespace luciole::bench {
namespace {

constexpr uint32_t kLights[] = {255, 1024, 4096, 16384, 65536, 262144, 1048576};
constexpr uint32_t kVisible = 1024;

/// \param compared rows end with what a light adds
void printHeader(std::string_view title, bool compared) {
    fmt::print("\n{}\n\n| lights | technique | frame, ms: median (least) | lists, ms | shading, ms | entries | longest list | lists, MiB | device, MiB |{}\n", title,
               compared ? " bytes a light |" : "");
    fmt::print("| ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |{}\n", compared ? " ---: |" : "");
}

double mebibytes(uint64_t bytes) { return double(bytes) / (1 << 20); }

uint64_t bytesBesidesLists(const Measured& result) { return result.stats.peakBytes - result.stats.lightLists->bytes; }

void printRow(const Measured& result) {
    const LightListStats& lists = *result.stats.lightLists;
    fmt::print("| {} | {} | {} | {} | {} | {} | {} | {:.2f} | {:.1f} |", result.stats.lights, result.name, milliseconds(result.wallMs), milliseconds(result.listsMs),
               milliseconds(result.shadingMs), lists.entries, lists.longest, mebibytes(lists.bytes), mebibytes(result.stats.peakBytes));
}

/// \param base the same scene and technique with fewer lights
std::string bytesALight(const Measured& result, const Measured& base) {
    if (result.stats.lights == base.stats.lights) return "-";
    return fmt::format("{:.1f}", (double(bytesBesidesLists(result)) - double(bytesBesidesLists(base))) / (result.stats.lights - base.stats.lights));
}

std::vector<Measured> measureScene(Renderer& renderer, const Scene& scene, const Options& options) {
    renderer.setScene(scene);
    return measure(renderer, {scene.cameras.at(0), options.extent}, listContenders(), {.frames = options.frames});
}

}  // namespace

void benchScaling(Renderer& renderer, const Options& options) {
    printHeader("`builtin:hall?gltf=1`, 40,000 triangles. Overlap 4, so that the more lights there are the smaller they are:", false);
    for (const uint32_t lights : kLights)
        for (const Measured& result : measureScene(renderer, builtinHall(lights, 4), options)) {
            printRow(result);
            fmt::print("\n");
            std::fflush(stdout);
        }
    printHeader(fmt::format("{} lights in the hall, all others around it, where they light nothing that is seen:", kVisible), true);
    std::vector<Measured> base;
    for (const uint32_t lights : kLights) {
        if (lights < kVisible) continue;
        const std::vector<Measured> results = measureScene(renderer, hallInWorld(kVisible, lights), options);
        if (base.empty()) base = results;
        for (size_t i = 0; i < results.size(); ++i) {
            printRow(results[i]);
            fmt::print(" {} |\n", bytesALight(results[i], base[i]));
            std::fflush(stdout);
        }
    }
}

}  // namespace luciole::bench
