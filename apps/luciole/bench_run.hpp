#pragma once
#include <measure.hpp>
#include <string>
#include <vector>

#include "bench_grid.hpp"

namespace luciole::cli {

struct Refused {
    std::string technique, why;
};

/// What was measured on one picture.
struct CellResult {
    Cell cell;
    uint64_t triangles = 0;
    uint32_t lights = 0;
    std::vector<bench::Measured> results;  ///< `ideal`, if there, is the last
    std::vector<Refused> refused;          ///< techniques that can't do with the settings
};

/// Techniques that `--lighting all` stands for: those that make pictures on the device, and are no choice between others.
std::vector<std::string> allTechniques();

/// The techniques that --lighting, or the settings file, names with commas between, or `all`; none if neither names any.
/// \throws Error(usage) for a name that is none
std::vector<std::string> techniquesNamed(const SettingOptions& options, const RenderSettings& settings);

/// A contender for each name, with the other settings. A name that comes again gets a number.
std::vector<bench::Contender> contendersNamed(const std::vector<std::string>& names, const RenderSettings& settings);

/// Takes out those that can't do with the settings, or need more than there is. A renderer goes on after either.
std::vector<Refused> refuse(Renderer& renderer, const View& view, std::vector<bench::Contender>& contenders);

/// Measures the contenders that `contendersOf` gives for each cell, cell by cell.
std::vector<CellResult> measureCells(Renderer& renderer, const std::vector<Cell>& cells,
                                     const std::function<std::vector<bench::Contender>(const RenderSettings&)>& contendersOf,
                                     const bench::Effort& effort, const Console& console);

}  // namespace luciole::cli
