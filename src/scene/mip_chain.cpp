#include "scene/mip_chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace luciole {
namespace {

double srgbToLinear(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// sRGB bytes to linear light and back by table: a pow per texel would take seconds on large textures.
class SrgbCodec {
public:
    SrgbCodec() {
        for (size_t i = 0; i < 256; ++i) {
            linear_[i] = float(srgbToLinear(double(i) / 255));
            upperLimit_[i] = float(srgbToLinear((double(i) + 0.5) / 255));
        }
        uint8_t byte = 0;
        for (size_t i = 0; i < kGuesses; ++i) {
            while (float(i) / (kGuesses - 1) >= upperLimit_[byte]) ++byte;
            guess_[i] = byte;
        }
    }

    float decode(uint8_t byte) const { return linear_[byte]; }

    /// The nearest byte, exactly: the guess is low by a step at most.
    uint8_t encode(float linear) const {
        uint8_t byte = guess_[size_t(linear * (kGuesses - 1))];
        while (linear >= upperLimit_[byte]) ++byte;
        return byte;
    }

private:
    static constexpr size_t kGuesses = 4096;  ///< finer than the narrowest byte, 1 / (255 * 12.92)
    std::array<float, 256> linear_;
    std::array<float, 256> upperLimit_;  ///< where the next byte becomes the nearest; beyond 1 for byte 255
    std::array<uint8_t, kGuesses> guess_;
};

/// Bytes that already are linear; counted in bytes, so that sums of a few are exact.
struct LinearCodec {
    float decode(uint8_t byte) const { return float(byte); }
    uint8_t encode(float value) const { return uint8_t(std::floor(value + 0.5f)); }
};

/// Which texels of the finer level a texel covers along one axis, and how much of its width each makes up.
struct Taps {
    std::array<uint32_t, 3> index;
    std::array<float, 3> weight;
};

std::vector<Taps> boxTaps(uint32_t fine) {
    if (fine == 1) return {Taps{{0, 0, 0}, {1, 0, 0}}};
    const uint32_t coarse = fine / 2;
    std::vector<Taps> taps(coarse);
    for (uint32_t i = 0; i < coarse; ++i) {
        if (fine % 2 == 0) {
            taps[i] = {{2 * i, 2 * i + 1, 2 * i + 1}, {0.5f, 0.5f, 0}};
        } else {
            const float width = float(fine);
            taps[i] = {{2 * i, 2 * i + 1, 2 * i + 2},
                       {float(coarse - i) / width, float(coarse) / width, float(i + 1) / width}};
        }
    }
    return taps;
}

/// Filters channels [first, last) of `fine` into `coarse`, first down the columns, then along the row.
template <typename Codec>
void halve(const Texels& fine, Texels& coarse, const Codec& codec, size_t first, size_t last) {
    const auto columns = boxTaps(fine.width);
    const auto rows = boxTaps(fine.height);
    std::vector<float> row(size_t(fine.width) * 4);
    for (uint32_t y = 0; y < coarse.height; ++y) {
        std::fill(row.begin(), row.end(), 0.0f);
        for (size_t tap = 0; tap < 3 && rows[y].weight[tap] > 0; ++tap) {
            const uint8_t* source = fine.rgba.data() + size_t(rows[y].index[tap]) * fine.width * 4;
            for (size_t x = 0; x < fine.width; ++x)
                for (size_t c = first; c < last; ++c)
                    row[4 * x + c] += rows[y].weight[tap] * codec.decode(source[4 * x + c]);
        }
        uint8_t* target = coarse.rgba.data() + size_t(y) * coarse.width * 4;
        for (size_t x = 0; x < coarse.width; ++x)
            for (size_t c = first; c < last; ++c) {
                float sum = 0;
                for (size_t tap = 0; tap < 3; ++tap)
                    sum += columns[x].weight[tap] * row[4 * size_t(columns[x].index[tap]) + c];
                target[4 * x + c] = codec.encode(sum);
            }
    }
}

Texels nextLevel(const Texels& fine, bool srgb) {
    Texels coarse{
        .name = fine.name, .width = std::max(fine.width / 2, 1u), .height = std::max(fine.height / 2, 1u), .rgba = {}};
    coarse.rgba.resize(size_t(coarse.width) * coarse.height * 4);
    static const SrgbCodec srgbCodec;
    if (srgb) halve(fine, coarse, srgbCodec, 0, 3);
    halve(fine, coarse, LinearCodec{}, srgb ? 3 : 0, 4);
    return coarse;
}

}  // namespace

std::vector<Texels> mipChain(const Texels& texels, bool srgb) {
    std::vector<Texels> levels{texels};
    while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(nextLevel(levels.back(), srgb));
    return levels;
}

double srgbByteToLinear(uint8_t byte) { return srgbToLinear(double(byte) / 255); }

}  // namespace luciole
