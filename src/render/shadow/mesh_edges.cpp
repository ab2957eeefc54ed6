#include "render/shadow/mesh_edges.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <tuple>

#include <luciole/scene.hpp>

namespace luciole::render {

std::vector<uvec2> edgesOf(std::span<const vec3> positions, std::span<const uint32_t> indices) {
    // Vertices at one place get one number: by their order in space.
    const auto key = [&](uint32_t v) { return std::tuple(positions[v].x, positions[v].y, positions[v].z); };
    std::vector<uint32_t> order(positions.size()), place(positions.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, key);
    for (uint32_t i = 0, number = 0; i < order.size(); ++i) {
        if (i > 0 && key(order[i]) != key(order[i - 1])) ++number;
        place[order[i]] = number;
    }
    struct Run {
        uint32_t low, high;  ///< places
        bool rising;         ///< from low to high
        uint32_t from;       ///< triangle * 4 + corner
        auto operator<=>(const Run&) const = default;
    };
    std::vector<Run> runs;
    for (uint32_t triangle = 0; triangle < indices.size() / 3; ++triangle)
        for (uint32_t corner = 0; corner < 3; ++corner) {
            const uint32_t a = place[indices[3 * triangle + corner]], b = place[indices[3 * triangle + (corner + 1) % 3]];
            if (a != b) runs.push_back({std::min(a, b), std::max(a, b), a < b, triangle * 4 + corner});
        }
    std::ranges::sort(runs);
    std::vector<uvec2> edges;
    for (size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
        while (end < runs.size() && runs[end].low == runs[begin].low && runs[end].high == runs[begin].high) ++end;
        // Falling ones come first: from both ends, opposite ones meet as long as there are any.
        size_t i = begin, j = end;
        while (i + 1 < j) {
            --j;
            edges.push_back({runs[i].from, runs[j].from / 4 * 4 + uint32_t(runs[i].rising == runs[j].rising)});
            ++i;
        }
        if (i < j) edges.push_back({runs[i].from, kNone});
    }
    return edges;
}

}  // namespace luciole::render
