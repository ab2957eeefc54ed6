#pragma once
#include <luciole/image.hpp>

namespace luciole::metrics {

/// FLIP of linear Rec. 709 values in [0, 1], 3 channels, of one size.
Image flipOfLinear(const Image& reference, const Image& test, double pixelsPerDegree);

/// sRGB-encoded values (IEC 61966-2-1) in linear light; a fourth channel stays as it is.
Image linearFromDisplay(const Image& display);

}  // namespace luciole::metrics
