#pragma once
#include <machine.hpp>
#include <map>
#include <string>
#include <vector>

#include "bench_run.hpp"
#include "request.hpp"

namespace luciole::cli {

/// What one scene's report is asked for.
struct SceneComparison {
    FrameRequest request;
    std::string file;  ///< .html
    std::vector<Axis> axes;  ///< none, or one
    bench::Effort effort{.frames = 5, .most = 20, .halfWidth = 0.03, .seconds = 4};
};

/// Renders the scene by the reference and by every technique, or those that --lighting names, measures them, and writes one HTML file that
/// shows it all. docs/report.md
/// \throws Error(usage) for options, Error(io) for the file, and as loading and rendering do
void compareScene(const SceneComparison& comparison);

/// What the report shows of one technique.
struct Compared {
    bench::Measured measured;
    Frame frame;  ///< with the layers evaluations and useful-evaluations
};

/// The report's data, as the page reads it. \param sweep results by cell, with one value each; may be empty
std::string reportData(const SceneComparison& comparison, const bench::Machine& machine, const Frame& reference, const std::vector<Compared>& compared,
                       const std::vector<Refused>& refused, const std::vector<CellResult>& sweep);

}  // namespace luciole::cli
