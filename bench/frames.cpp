#include <luciole/scene_io.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "suites.hpp"

namespace luciole::bench {
namespace {

constexpr std::array<uint32_t, 3> kLights{16, 64, 255};
constexpr std::array kTechniques{"brute-force", "fullscreen"};

/// What the techniques that look at every light cost with so many lights.
struct Column {
    double pairs = 0;  ///< of a light and a pixel that shows a surface
    std::vector<Measured> results;
};

Column measureLights(Renderer& renderer, uint32_t lights, const Options& options) {
    const Scene scene = loadScene(fmt::format("builtin:hall?lights={}&overlap=4&triangles=40000&seed=1", lights));
    renderer.setScene(scene);
    const View view{scene.cameras.at(0), options.extent};
    const Frame depths = renderer.render(view, {}, {"depth"});
    const auto covered = std::ranges::count_if(depths.aovs.at("depth").data, [](float depth) { return depth > 0; });
    std::vector<Contender> contenders;
    for (const char* technique : kTechniques) contenders.push_back(contender(technique));
    return {double(lights) * double(covered), measure(renderer, view, contenders, {.frames = options.frames})};
}

const MeasuredPass* passOf(const Measured& result, const std::string& name) {
    const auto pass = std::ranges::find(result.passes, name, &MeasuredPass::name);
    return pass == result.passes.end() ? nullptr : &*pass;
}
const MeasuredPass& lightingOf(const Measured& result) { return *passOf(result, "lighting." + result.name); }

/// \param cell what stands in the row for a column
template <typename Cell>
void printRow(const std::string& title, const std::vector<Column>& columns, const Cell& cell) {
    fmt::print("| {} |", title);
    for (const Column& column : columns) fmt::print(" {} |", cell(column));
    fmt::print("\n");
}

void printHeader(std::string_view title) {
    fmt::print("\n| {} |", title);
    for (const uint32_t lights : kLights) fmt::print(" {} lights |", lights);
    fmt::print("\n| --- | ---: | ---: | ---: |\n");
}

}  // namespace

void benchFrames(Renderer& renderer, const Options& options) {
    std::vector<Column> columns;
    for (const uint32_t lights : kLights) columns.push_back(measureLights(renderer, lights, options));

    fmt::print("\n`builtin:hall`, overlap 4, 40,000 triangles. Milliseconds, median (least):\n");
    printHeader("pass");
    for (const MeasuredPass& first : columns[0].results[0].passes)
        printRow(first.name, columns, [&](const Column& column) { return milliseconds(passOf(column.results[0], first.name)->ms); });
    printRow("lighting.fullscreen instead", columns, [](const Column& column) { return milliseconds(lightingOf(column.results[1]).ms); });
    for (size_t i = 0; i < kTechniques.size(); ++i)
        printRow(fmt::format("outside of lighting, {}", kTechniques[i]), columns, [i](const Column& column) {
            const Measured& result = column.results[i];
            return fmt::format("{:.1f} %", 100 * (1 - median(lightingOf(result).ms) / median(result.passesMs)));
        });
    printHeader("ns for each light and pixel");
    for (size_t i = 0; i < kTechniques.size(); ++i)
        printRow(kTechniques[i], columns, [i](const Column& column) {
            const std::vector<double>& ms = lightingOf(column.results[i]).ms;
            return fmt::format("{:.1f} ({:.1f})", 1e6 * median(ms) / column.pairs, 1e6 * least(ms) / column.pairs);
        });
}

}  // namespace luciole::bench
