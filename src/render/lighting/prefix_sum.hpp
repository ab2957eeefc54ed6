#pragma once
#include <string>

#include "frame/graph.hpp"

namespace luciole::render {

/// Lists of different lengths, one after the other in one buffer: their lengths, and where each begins.
struct PrefixSum {
    frame::BufferId counts;  ///< uint[n], lengths
    frame::BufferId places;  ///< uint[n + 1]: where each list begins; at the end the sum of all
    frame::BufferId result;  ///< uint[kResultCount] or more, zero at first: prefix_sum.shared.h
    uint64_t most;           ///< n at most
    frame::BufferId size;    ///< a result of another sum, or a constant one: n is `factor` times its total
    uint32_t factor = 1;
    uint32_t capacity = ~0u;  ///< lists longer than that are counted in the result
};

/// Adds the three passes that fill `places` and `result`: sums of stretches, their sums, and the places.
/// \param name what the names of the passes begin with
void addPrefixSum(frame::FrameGraph& graph, const std::string& name, const PrefixSum& sum);

/// What stands for the size of a sum over a number of lists that the host knows.
frame::BufferId addKnownSize(frame::FrameGraph& graph, uint32_t n);

}  // namespace luciole::render
