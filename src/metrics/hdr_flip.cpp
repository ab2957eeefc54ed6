#include <algorithm>
#include <cmath>
#include <luciole/metrics.hpp>
#include <vector>

#include "metrics/flip.hpp"
#include "metrics/shape.hpp"
#include "output/tone_map.shared.h"

namespace luciole {
namespace {

/// Stops; `last` >= `first`.
struct Exposures {
    double first = 0, last = 0;
};

/// What the tone curve shows at 85 %: acesNarkowicz(x) = t, which is quadratic in x. The factor 0.6 that the authors put before the curve
/// would be divided by again here.
double shownAt85Percent() {
    constexpr double t = 0.85, a = 2.51 - t * 2.43, b = 0.03 - t * 0.59, c = -t * 0.14;
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

/// The lower one of an even number. \param values at least one; left in another order
double median(std::vector<double>& values) {
    const auto middle = values.begin() + ptrdiff_t((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Exposures exposuresOf(const Image& reference) {
    std::vector<double> luminances;
    for (size_t i = 0; i + 2 < reference.data.size(); i += 3)
        luminances.push_back(0.2126 * reference.data[i] + 0.7152 * reference.data[i + 1] + 0.0722 * reference.data[i + 2]);
    double middle = median(luminances);
    if (middle <= 0) {
        std::erase_if(luminances, [](double luminance) { return luminance <= 0; });
        if (luminances.empty()) return {};
        middle = median(luminances);
    }
    const double x = shownAt85Percent();
    return {std::log2(x / *std::ranges::max_element(luminances)), std::log2(x / middle)};
}

Image toneMapped(const Image& radiance, double exposureEv) {
    Image linear = radiance;
    const float exposure = std::exp2(float(exposureEv));
    for (float& x : linear.data) x = std::min(shared::acesNarkowicz(vec3(shared::displayable(exposure * x))).x, 1.0f);
    return linear;
}

}  // namespace

Image hdrFlip(const Image& reference, const Image& test, double pixelsPerDegree) {
    metrics::requireSameShape("HDR-FLIP", reference, test, 3);
    const auto [first, last] = exposuresOf(reference);
    const int count = std::max(2, int(std::ceil(last - first)));
    Image errors(reference.width, reference.height, 1);
    for (int i = 0; i < count; ++i) {
        const double exposureEv = first + (last - first) * i / (count - 1);
        const Image shown = metrics::flipOfLinear(toneMapped(reference, exposureEv), toneMapped(test, exposureEv), pixelsPerDegree);
        std::ranges::transform(errors.data, shown.data, errors.data.begin(), [](float a, float b) { return std::max(a, b); });
    }
    return errors;
}

}  // namespace luciole
