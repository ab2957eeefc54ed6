#pragma once
#include <vector>

#include <luciole/scene.hpp>

namespace luciole {

/// Level 0 (a copy of `texels`) down to 1 x 1. Level n + 1 has half the size of level n, rounded down, and is its box
/// filter: the mean over the texel's area, rounded to 8 bits. On an odd side 2n + 1 a texel is 2 + 1/n texels wide, so
/// three texels count, by the share that is covered (Guthe and Heckbert 2005, "Non-Power-of-Two Mipmapping").
/// \param texels at least 1 x 1
/// \param srgb red, green and blue are averaged in linear light (IEC 61966-2-1); alpha always is linear
std::vector<Texels> mipChain(const Texels& texels, bool srgb);

/// Linear value [0, 1] of an sRGB-encoded byte.
double srgbByteToLinear(uint8_t byte);

}  // namespace luciole
