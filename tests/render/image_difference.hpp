#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <luciole/metrics.hpp>
#include <luciole/renderer.hpp>

namespace luciole::test {

/// Pixels whose eight neighbours show the same object and material at a depth that changes smoothly: where a ray and a
/// rasterizer must see the same surface. \param alike a layer that must not change among them either, or null
inline std::vector<bool> interior(const Frame& frame, const Image* alike = nullptr) {
    const Image &id = frame.aovs.at("id"), &material = frame.aovs.at("material"), &depth = frame.aovs.at("depth");
    std::vector<bool> inside(size_t(id.width) * id.height);
    for (uint32_t y = 1; y + 1 < id.height; ++y)
        for (uint32_t x = 1; x + 1 < id.width; ++x) {
            bool same = true;
            for (uint32_t v = y - 1; v <= y + 1; ++v)
                for (uint32_t u = x - 1; u <= x + 1; ++u)
                    same &= id.at(u, v, 0) == id.at(x, y, 0) && material.at(u, v, 0) == material.at(x, y, 0) &&
                            (!alike || alike->at(u, v, 0) == alike->at(x, y, 0));
            const float here = depth.at(x, y, 0);
            const float bendX = depth.at(x - 1, y, 0) + depth.at(x + 1, y, 0) - 2 * here;
            const float bendY = depth.at(x, y - 1, 0) + depth.at(x, y + 1, 0) - 2 * here;
            inside[size_t(y) * id.width + x] = same && std::max(std::abs(bendX), std::abs(bendY)) < 0.02f * here;
        }
    return inside;
}

/// Relative errors of `image` where `mask` says so, or everywhere.
inline ErrorSummary difference(const Image& image, const Image& yardstick, const std::vector<bool>* mask = nullptr) {
    return summaryOf(relativeError(yardstick, image), mask);
}

/// The share of light that shadows leave of each pixel's.
inline std::vector<double> litShares(const Image& shadowed, const Image& lit) {
    std::vector<double> shares(shadowed.data.size() / 3, 1);
    for (size_t i = 0; i < shares.size(); ++i) {
        const auto sum = [&](const Image& image) { return double(image.data[3 * i]) + double(image.data[3 * i + 1]) + double(image.data[3 * i + 2]); };
        if (sum(lit) > 0) shares[i] = sum(shadowed) / sum(lit);
    }
    return shares;
}

}  // namespace luciole::test
