#include <fmt/format.h>

#include "halls.hpp"
#include "suites.hpp"

namespace luciole::bench {
namespace {

/// The best of four engines on the same kind of machine, software driver, 2 cores, 1024 x 768: a frame of such a hall, ms.
struct Cell {
    uint32_t lights;
    double overlap, engineMs;
    bool all;  ///< every technique is measured
};
constexpr Cell kCells[] = {{255, 2, 128, false},  {255, 4, 227, true},    {255, 16, 382, true},  {1024, 4, 255, true},
                           {1024, 16, 580, true}, {4096, 4, 417, false}, {4096, 16, 1168, false}};

void append(std::vector<Measured>& results, Renderer& renderer, const View& view, const std::vector<Contender>& contenders, int frames) {
    std::vector<Measured> more = measure(renderer, view, contenders, frames);
    count(renderer, view, contenders, more);
    results.insert(results.end(), more.begin(), more.end());
}

}  // namespace

void benchTiles(Renderer& renderer, const Options& options) {
    fmt::print("Halls: {}\n", options.folder.empty() ? "builtin:hall?triangles=40000&gltf=1" : options.folder + "/hall-*.glb");
    for (const Cell& cell : kCells) {
        const Scene scene = options.folder.empty() ? builtinHall(cell.lights, cell.overlap)
                                                   : hallOfFile(renderer, options.folder, cell.lights, cell.overlap);
        renderer.setScene(scene);
        const View view{scene.cameras.at(0), options.extent};
        std::vector<Measured> results;
        append(results, renderer, view, fastContenders(), options.frames);
        fmt::print("\n{} lights, overlap {}; the best of the engines takes {} ms\n\n{}", cell.lights, cell.overlap, cell.engineMs,
                   frameTable(results, cell.engineMs));
        append(results, renderer, view, {ideal()}, options.frames);
        if (cell.all) append(results, renderer, view, otherContenders(), 1);
        if (cell.all && cell.lights == 255) append(results, renderer, view, slowContenders(), 1);
        fmt::print("\nLighting at {} lights, overlap {}\n\n{}", cell.lights, cell.overlap, lightingTable(results));
        std::fflush(stdout);
    }
}

}  // namespace luciole::bench
