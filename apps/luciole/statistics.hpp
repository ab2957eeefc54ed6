#pragma once
#include <optional>
#include <string>
#include <vector>

#include <luciole/output.hpp>
#include <luciole/renderer.hpp>

namespace luciole::cli {

/// For programs: one JSON object. \param counts given if the overlap is shown
std::string statisticsJson(const Frame& frame, const RenderSettings& settings,
                           const std::optional<OverlapCounts>& counts);

/// For people: what became of lights that found no room at a pixel; empty if all did.
std::string overflowNote(const LightIndexStats& stats, const Scene& scene);

/// For people: what became of lights that have no shadow, or wait for it; none if all have theirs.
std::vector<std::string> shadowNotes(const ShadowStats& stats, const Scene& scene);

/// For people: a table of the passes, then the totals.
std::string statisticsTable(const FrameStats& stats, const std::optional<OverlapCounts>& counts);

}  // namespace luciole::cli
