#pragma once
#include <span>
#include <vector>

#include <luciole/image.hpp>

namespace luciole::metrics {

/// Weights at -radius, ..., radius pixels.
using Kernel = std::vector<float>;

/// exp(-x^2 / (2 sigma^2)), scaled so that its sum is 1. \param sigma pixels, > 0
Kernel gaussian(double sigma, int radius);

/// A plane (1 channel) filtered along its rows, then along its columns. Beyond its edges their pixels go on.
Image convolve(const Image& plane, std::span<const float> alongX, std::span<const float> alongY);

}  // namespace luciole::metrics
