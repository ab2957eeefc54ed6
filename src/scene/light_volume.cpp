#include "scene/light_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace luciole {
namespace {

std::string print(vec3 v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }

std::optional<size_t> firstNotFinite(const std::vector<vec3>& positions) {
    for (size_t i = 0; i < positions.size(); ++i) {
        const vec3& p = positions[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return i;
    }
    return std::nullopt;
}

/// Per position the index of one that stands for all equal ones.
std::vector<uint32_t> weld(const std::vector<vec3>& positions) {
    const auto key = [&](uint32_t i) { return std::array{positions[i].x, positions[i].y, positions[i].z}; };
    std::vector<uint32_t> order(positions.size()), welded(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    for (size_t i = 0; i < order.size(); ++i) {
        const bool repeats = i > 0 && positions[order[i]] == positions[order[i - 1]];
        welded[order[i]] = repeats ? welded[order[i - 1]] : order[i];
    }
    return welded;
}

/// An edge between two welded vertices as one triangle runs through it.
struct EdgeUse {
    uint32_t low, high;
    int direction;  ///< 1 from low to high, -1 back
};

std::vector<EdgeUse> edgeUses(const LightVolume& volume) {
    const std::vector<uint32_t> welded = weld(volume.positionsWorld);
    std::vector<EdgeUse> uses;
    uses.reserve(volume.indices.size());
    for (size_t i = 0; i < volume.indices.size(); i += 3) {
        const std::array corner{welded[volume.indices[i]], welded[volume.indices[i + 1]], welded[volume.indices[i + 2]]};
        if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t from = corner[k], to = corner[(k + 1) % 3];
            uses.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
        }
    }
    return uses;
}

/// Edges that triangles run through more often one way than the other.
std::vector<EdgeUse> openEdges(const LightVolume& volume) {
    std::vector<EdgeUse> uses = edgeUses(volume);
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::pair(a.low, a.high) < std::pair(b.low, b.high);
    });
    std::vector<EdgeUse> open;
    for (size_t i = 0; i < uses.size();) {
        EdgeUse edge{uses[i].low, uses[i].high, 0};
        for (; i < uses.size() && uses[i].low == edge.low && uses[i].high == edge.high; ++i) edge.direction += uses[i].direction;
        if (edge.direction != 0) open.push_back(edge);
    }
    return open;
}

}  // namespace

std::optional<VolumeFault> faultOf(const LightVolume& volume) {
    const std::vector<vec3>& positions = volume.positionsWorld;
    if (volume.indices.empty() || volume.indices.size() % 3 != 0)
        return VolumeFault{"indices", "a multiple of 3, at least one triangle", fmt::format("{}", volume.indices.size())};
    for (size_t i = 0; i < volume.indices.size(); ++i)
        if (volume.indices[i] >= positions.size())
            return VolumeFault{fmt::format("indices[{}]", i), fmt::format("an index below {}", positions.size()),
                               fmt::format("{}", volume.indices[i])};
    if (const auto i = firstNotFinite(positions))
        return VolumeFault{fmt::format("positionsWorld[{}]", *i), "finite numbers", print(positions[*i])};
    const std::vector<EdgeUse> open = openEdges(volume);
    if (open.empty()) return std::nullopt;
    return VolumeFault{"indices", "a closed surface, triangles turned alike (each edge run through as often one way as the other)",
                       fmt::format("{} open edge{}, one of them from {} to {}", open.size(), open.size() == 1 ? "" : "s",
                                   print(positions[open[0].low]), print(positions[open[0].high]))};
}

}  // namespace luciole
