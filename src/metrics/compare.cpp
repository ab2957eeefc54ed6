#include <cmath>
#include <luciole/metrics.hpp>
#include <vector>

#include "metrics/flip.hpp"
#include "metrics/shape.hpp"
#include "output/display.hpp"

namespace luciole {
namespace {

Image withoutAlpha(const Image& image) {
    if (image.channels == 3) return image;
    Image result(image.width, image.height, 3);
    for (size_t i = 0; i < result.data.size(); ++i) result.data[i] = image.data[i / 3 * image.channels + i % 3];
    return result;
}

}  // namespace

ImageDifference compareImages(const Image& reference, const Image& test, PixelValues values, float exposureEv) {
    metrics::requireSameShape("compare", reference, test);
    const bool light = values != PixelValues::numbers && (reference.channels == 3 || reference.channels == 4);
    const bool encoded = light && values == PixelValues::display;
    ImageDifference result;
    result.identical = reference.data == test.data;
    result.relativeErrorMap = encoded ? relativeError(metrics::linearFromDisplay(reference), metrics::linearFromDisplay(test))
                                      : relativeError(reference, test);
    std::vector<bool> finite;
    for (const float error : result.relativeErrorMap.data) {
        if (!std::isfinite(error) && result.notFinite++ == 0)
            result.firstNotFinite = uvec2(finite.size() % reference.width, finite.size() / reference.width);
        finite.push_back(std::isfinite(error));
    }
    result.relativeError = summaryOf(result.relativeErrorMap, &finite);
    if (!light || result.notFinite > 0) return result;

    const Image a = withoutAlpha(reference), b = withoutAlpha(test);
    const auto shown = [&](const Image& image) { return encoded ? image : displayImage(image, exposureEv, ToneMap::none); };
    const Image shownA = shown(a), shownB = shown(b);
    result.psnr = psnr(shownA, shownB);
    result.ssim = ssim(shownA, shownB);
    result.flipMap = encoded ? flip(a, b) : hdrFlip(a, b);
    result.flip = summaryOf(*result.flipMap);
    return result;
}

}  // namespace luciole
