#pragma once
#include <string>

#include <luciole/renderer.hpp>

namespace luciole::cli {

/// For programs: one JSON object.
std::string statisticsJson(const Frame& frame, const RenderSettings& settings);

/// For people: a table of the passes, then the totals.
std::string statisticsTable(const FrameStats& stats);

}  // namespace luciole::cli
