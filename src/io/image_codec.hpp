#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace luciole {

/// 8-bit RGBA, [height][width][4], row 0 at the top, as stored (no colour conversion).
struct Rgba8 {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> texels;
};

/// Decodes PNG or JPEG, told apart by signature. Sizes are checked before anything is allocated.
/// \throws Error(scene) for broken or unknown data, Error(limit) beyond the limits; both begin with `nameForErrors`
Rgba8 decodeImage(std::span<const std::byte> bytes, const std::string& nameForErrors, uint32_t maxSide, uint64_t maxBytes);

/// Encodes PNG. \param samples [height][width][channels], 8 bits, or 16 bits in host order; \param channels 1, 3 or 4
std::vector<std::byte> encodePng(uint32_t width, uint32_t height, uint32_t channels, std::span<const uint8_t> samples);
std::vector<std::byte> encodePng(uint32_t width, uint32_t height, uint32_t channels, std::span<const uint16_t> samples);

}  // namespace luciole
