#pragma once
#include <cstdint>
#include <random>

#include <luciole/image.hpp>
#include <luciole/math.hpp>

namespace luciole::test {

inline Image constant(uint32_t width, uint32_t height, vec3 color) {
    Image image(width, height, 3);
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = color[int(i % 3)];
    return image;
}

/// Even in [0, 1).
inline Image noise(uint32_t width, uint32_t height, uint32_t seed, uint32_t channels = 3) {
    Image image(width, height, channels);
    std::mt19937 random(seed);
    for (float& value : image.data) value = float(random() >> 8) / float(1 << 24);
    return image;
}

}  // namespace luciole::test
