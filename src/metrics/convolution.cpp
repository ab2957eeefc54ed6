#include "metrics/convolution.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/parallel_rows.hpp"

namespace luciole::metrics {

Kernel gaussian(double sigma, int radius) {
    std::vector<double> weights;
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) sum += weights.emplace_back(std::exp(-x * x / (2 * sigma * sigma)));
    Kernel kernel;
    for (const double weight : weights) kernel.push_back(float(weight / sum));
    return kernel;
}

Image convolve(const Image& plane, std::span<const float> alongX, std::span<const float> alongY) {
    const size_t width = plane.width, radiusX = alongX.size() / 2, radiusY = alongY.size() / 2;
    Image between(plane.width, plane.height, 1), result(plane.width, plane.height, 1);
    // A weight at a time goes over a whole row, which compilers turn into vector instructions.
    const auto addWeighted = [width](float weight, const float* from, float* to) {
        for (size_t x = 0; x < width; ++x) to[x] += weight * from[x];
    };
    const auto filterRow = [&](uint32_t y) {
        const float* row = &plane.data[y * width];
        std::vector<float> extended(radiusX, row[0]);
        extended.insert(extended.end(), row, row + width);
        extended.insert(extended.end(), radiusX, row[width - 1]);
        for (size_t i = 0; i < alongX.size(); ++i) addWeighted(alongX[i], &extended[i], &between.data[y * width]);
    };
    const auto filterColumns = [&](uint32_t y) {
        for (size_t i = 0; i < alongY.size(); ++i) {
            const size_t from = std::clamp(y + i, radiusY, radiusY + plane.height - 1) - radiusY;
            addWeighted(alongY[i], &between.data[from * width], &result.data[y * width]);
        }
    };
    forEachRow(plane.height, filterRow, {});
    forEachRow(plane.height, filterColumns, {});
    return result;
}

}  // namespace luciole::metrics
