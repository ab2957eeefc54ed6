#include <cmath>
#include <luciole/metrics.hpp>

#include "metrics/convolution.hpp"
#include "metrics/shape.hpp"

namespace luciole {
namespace {

Image channelOf(const Image& image, uint32_t channel) {
    Image plane(image.width, image.height, 1);
    for (size_t i = 0; i < plane.data.size(); ++i) plane.data[i] = image.data[i * image.channels + channel];
    return plane;
}

Image product(const Image& a, const Image& b) {
    Image result = a;
    for (size_t i = 0; i < a.data.size(); ++i) result.data[i] *= b.data[i];
    return result;
}

/// Sum of the SSIM index (Wang et al. 2004, eq. 13) of one channel over the pixels from `first` to before `end`.
double sumOfIndex(const Image& x, const Image& y, const metrics::Kernel& window, uvec2 first, uvec2 end) {
    constexpr double C1 = 0.01 * 0.01, C2 = 0.03 * 0.03;  // (K L)^2, with the values' range L = 1
    const auto weighted = [&](const Image& plane) { return metrics::convolve(plane, window, window); };
    const Image muX = weighted(x), muY = weighted(y), xx = weighted(product(x, x)), yy = weighted(product(y, y)), xy = weighted(product(x, y));
    double sum = 0;
    for (uint32_t row = first.y; row < end.y; ++row)
        for (uint32_t column = first.x; column < end.x; ++column) {
            const size_t i = size_t(row) * x.width + column;
            const double mx = muX.data[i], my = muY.data[i];
            const double varianceX = xx.data[i] - mx * mx, varianceY = yy.data[i] - my * my, covariance = xy.data[i] - mx * my;
            sum += (2 * mx * my + C1) * (2 * covariance + C2) / ((mx * mx + my * my + C1) * (varianceX + varianceY + C2));
        }
    return sum;
}

}  // namespace

double psnr(const Image& reference, const Image& test) {
    metrics::requireSameShape("PSNR", reference, test);
    double sum = 0;
    for (size_t i = 0; i < reference.data.size(); ++i) {
        const double difference = double(test.data[i]) - reference.data[i];
        sum += difference * difference;
    }
    return 10 * std::log10(double(reference.data.size()) / sum);  // x / 0 is infinite (IEC 60559)
}

double ssim(const Image& reference, const Image& test) {
    metrics::requireSameShape("SSIM", reference, test);
    constexpr uint32_t kRadius = 5;
    const metrics::Kernel window = metrics::gaussian(1.5, kRadius);
    const auto margin = [&](uint32_t side) { return side > 2 * kRadius ? kRadius : 0; };
    const uvec2 first(margin(reference.width), margin(reference.height));
    const uvec2 end = uvec2(reference.width, reference.height) - first;
    double sum = 0;
    for (uint32_t c = 0; c < reference.channels; ++c) sum += sumOfIndex(channelOf(reference, c), channelOf(test, c), window, first, end);
    return sum / (double(end.x - first.x) * (end.y - first.y) * reference.channels);
}

}  // namespace luciole
