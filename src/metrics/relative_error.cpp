#include <algorithm>
#include <cmath>
#include <limits>
#include <luciole/metrics.hpp>

#include "metrics/shape.hpp"

namespace luciole {
namespace {

double meanMagnitude(const Image& image) {
    double sum = 0;
    size_t finite = 0;
    for (const float value : image.data)
        if (std::isfinite(value)) sum += std::abs(value), ++finite;
    return finite == 0 ? 0 : sum / double(finite);
}

}  // namespace

Image relativeError(const Image& reference, const Image& test) {
    metrics::requireSameShape("relative error", reference, test);
    constexpr double kTiny = 1e-9;  // a black reference has no scale of its own
    const double floor = 0.01 * meanMagnitude(reference) + kTiny;
    Image errors(reference.width, reference.height, 1);
    for (size_t i = 0; i < reference.data.size(); ++i) {
        const double expected = reference.data[i], found = test.data[i];
        const double error = std::abs(found - expected) / (std::abs(expected) + floor);
        float& largest = errors.data[i / reference.channels];
        if (!std::isfinite(error))
            largest = std::numeric_limits<float>::infinity();
        else
            largest = std::max(largest, float(std::min(error, double(std::numeric_limits<float>::max()))));
    }
    return errors;
}

ErrorSummary summaryOf(const Image& errors, const std::vector<bool>* mask) {
    std::vector<float> counted;
    ErrorSummary summary;
    for (size_t i = 0; i < errors.data.size(); ++i) {
        if (mask && !(*mask)[i]) continue;
        counted.push_back(errors.data[i]);
        summary.mean += errors.data[i];
    }
    if (counted.empty()) return summary;
    const auto p999 = counted.begin() + ptrdiff_t(0.999 * double(counted.size()));
    std::nth_element(counted.begin(), p999, counted.end());
    summary.mean /= double(counted.size());
    summary.p999 = *p999;
    summary.max = *std::max_element(p999, counted.end());
    summary.share = double(counted.size()) / double(errors.data.size());
    return summary;
}

}  // namespace luciole
