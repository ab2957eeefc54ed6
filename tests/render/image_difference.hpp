#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <luciole/renderer.hpp>

namespace luciole::test {

/// Relative differences |a - b| / (b + floor) over pixels and channels, with `floor` a hundredth of b's mean, so that dark
/// pixels count by what an eye would see.
struct Difference {
    double mean = 0;
    double p999 = 0;     ///< 99.9 % of the compared pixels are at or below it (worst channel of each)
    double max = 0;
    double share = 0;    ///< of all pixels that were compared
};

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

inline Difference difference(const Image& a, const Image& b, const std::vector<bool>* mask = nullptr) {
    double sum = 0;
    for (const float value : b.data) sum += value;
    const double floor = 0.01 * sum / double(b.data.size()) + 1e-9;
    std::vector<double> worst;
    Difference result;
    const size_t pixels = size_t(b.width) * b.height;
    for (size_t i = 0; i < pixels; ++i) {
        if (mask && !(*mask)[i]) continue;
        double pixel = 0;
        for (uint32_t c = 0; c < b.channels; ++c) {
            const double expected = b.data[i * b.channels + c];
            const double off = std::abs(double(a.data[i * b.channels + c]) - expected) / (std::abs(expected) + floor);
            pixel = std::isfinite(off) ? std::max(pixel, off) : INFINITY;
        }
        result.mean += pixel;
        worst.push_back(pixel);
    }
    if (worst.empty()) return result;
    std::ranges::sort(worst);
    result.mean /= double(worst.size());
    result.p999 = worst[std::min(worst.size() - 1, size_t(0.999 * double(worst.size())))];
    result.max = worst.back();
    result.share = double(worst.size()) / double(pixels);
    return result;
}

}  // namespace luciole::test
