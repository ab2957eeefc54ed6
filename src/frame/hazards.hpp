#pragma once
#include <string>
#include <vector>

#include "frame/graph.hpp"

namespace luciole::frame {

/// Checks a compiled graph by itself, by the rules of Vulkan's memory model and not by how the barriers were made: every
/// pair of accesses to a resource of which one writes must be ordered by barriers, writes must be made visible (to
/// whoever is outside of the frame, too), images must be in the layout that the access needs, transitions must wait for what came before, and no
/// barrier may discard content that is needed. (The validation layer was seen to miss attachment hazards under dynamic
/// rendering and hazards between dispatches.)
/// \return one line per hazard, naming both passes, the resource and the kind; empty if there is none
std::vector<std::string> findHazards(const FrameGraph& graph, const CompiledGraph& compiled);

}  // namespace luciole::frame
