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
    std::vector<Measured> results = {};
};
std::vector<Cell> cells() {
    return {{255, 2, 128, false},  {255, 4, 227, true},   {255, 16, 382, true},   {1024, 4, 255, true},
            {1024, 16, 580, true}, {4096, 4, 417, false}, {4096, 16, 1168, false}};
}

void append(std::vector<Measured>& results, Renderer& renderer, const View& view, const std::vector<Contender>& contenders, int frames) {
    std::vector<Measured> more = measure(renderer, view, contenders, {.frames = frames});
    count(renderer, view, contenders, more);
    results.insert(results.end(), more.begin(), more.end());
}

void measureCell(Renderer& renderer, const Options& options, Cell& cell) {
    const Scene scene = options.folder.empty() ? builtinHall(cell.lights, cell.overlap) : hallOfFile(renderer, options.folder, cell.lights, cell.overlap);
    renderer.setScene(scene);
    const View view{scene.cameras.at(0), options.extent};
    std::vector<Contender> contenders = fastContenders();
    contenders.push_back(ideal());
    append(cell.results, renderer, view, contenders, options.frames);
    // One frame each of those that are far behind.
    if (cell.all) append(cell.results, renderer, view, otherContenders(), 1);
    if (cell.all && cell.lights == 255) append(cell.results, renderer, view, slowContenders(), 1);
    fmt::print(stderr, "\n{} lights, overlap {}; the best of the engines takes {} ms\n\n{}\n{}", cell.lights, cell.overlap, cell.engineMs,
               frameTable(cell.results, cell.engineMs), lightingTable(cell.results));
}

/// The frames of the techniques with lists, of the best other one, and of the engines.
void printFrames(const std::vector<Cell>& all) {
    const std::vector<Contender> lists = listContenders();
    std::string header = "| lights | overlap | engines' best, ms |", line = "| ---: | ---: | ---: |";
    for (const Contender& contender : lists) header += " " + contender.name + ", ms |", line += " ---: |";
    fmt::print("\nWhole frames, ms: median (least); the engines' figures are the best of four known ones on a machine of this kind, software driver, 2 cores, and in such a hall:\n\n{} best other technique, ms | times faster | pairs missed |\n{} --- | ---: | ---: |\n", header, line);
    for (const Cell& cell : all) {
        std::string row = fmt::format("| {} | {} | {} |", cell.lights, cell.overlap, cell.engineMs);
        const Measured *other = nullptr, *best = nullptr;
        double missed = 0;
        for (const Measured& result : cell.results) {
            const bool list = std::ranges::find(lists, result.name, &Contender::name) != lists.end();
            if (list) row += fmt::format(" {} |", milliseconds(result.wallMs));
            missed += result.missed.value();
            const Measured*& place = list ? best : other;
            if (result.name != ideal().name && (!place || least(result.wallMs) < least(place->wallMs))) place = &result;
        }
        fmt::print("{} {}: {} | {:.2f} ({:.2f}) | {:.0f} |\n", row, other->name, milliseconds(other->wallMs), cell.engineMs / median(best->wallMs),
                   cell.engineMs / least(best->wallMs), missed);
    }
}

/// Each technique's lighting as a multiple of the bound, in the cells that have them all.
void printMultiples(const std::vector<Cell>& all) {
    std::string header = "| technique |", line = "| --- |";
    for (const Cell& cell : all)
        if (cell.all) header += fmt::format(" {} lights, overlap {} |", cell.lights, cell.overlap), line += " ---: |";
    fmt::print("\nLighting, lists included, as a multiple of `ideal` (exact lists given, only their evaluation counted), of the medians (of the least):\n\n{}\n{}\n", header, line);
    const std::vector<Measured>& rows = std::ranges::max_element(all, {}, [](const Cell& cell) { return cell.results.size(); })->results;
    for (const Measured& row : rows) {
        fmt::print("| {} |", row.name);
        for (const Cell& cell : all) {
            const auto result = std::ranges::find(cell.results, row.name, &Measured::name);
            if (cell.all) fmt::print(" {} |", result == cell.results.end() ? "-" : timesIdeal(*result, cell.results));
        }
        fmt::print("\n");
    }
}

}  // namespace

void benchTiles(Renderer& renderer, const Options& options) {
    fmt::print("Halls: {}\n", options.folder.empty() ? "`builtin:hall?triangles=40000&gltf=1`" : options.folder + "/hall-*.glb");
    std::vector<Cell> all = cells();
    for (Cell& cell : all) measureCell(renderer, options, cell);
    printFrames(all);
    printMultiples(all);
}

}  // namespace luciole::bench
