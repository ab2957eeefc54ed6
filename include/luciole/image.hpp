#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace luciole {

/// Float image, [height][width][channels], row 0 at the top. What the numbers mean is said where an Image is returned.
struct Image {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t channels = 0;
    std::vector<float> data;

    Image() = default;
    Image(uint32_t w, uint32_t h, uint32_t c) : width(w), height(h), channels(c), data(size_t(w) * h * c) {}

    float& at(uint32_t x, uint32_t y, uint32_t c) { return data[(size_t(y) * width + x) * channels + c]; }
    float at(uint32_t x, uint32_t y, uint32_t c) const { return data[(size_t(y) * width + x) * channels + c]; }
};

}  // namespace luciole
