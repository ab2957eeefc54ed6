#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <luciole/metrics.hpp>

#include "metrics/image_building.hpp"

using namespace luciole;
using namespace luciole::test;
using doctest::Approx;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

vec3 colorAt(const Image& image, uint32_t x, uint32_t y) { return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)}; }

bool isGrey(vec3 color) { return color.x == color.y && color.y == color.z; }

}  // namespace

TEST_CASE("compare: display values are made linear for the relative error, and compared as they are by PSNR") {
    // sRGB 0.5 is 0.21404 in linear light, 0.6 is 0.31855.
    const ImageDifference difference = compareImages(constant(12, 12, vec3(0.5f)), constant(12, 12, vec3(0.6f)), PixelValues::display);
    CHECK(difference.relativeError.max == Approx((0.31855 - 0.21404) / (1.01 * 0.21404)).epsilon(1e-4));
    CHECK(*difference.psnr == Approx(20).epsilon(1e-5));
    CHECK(difference.flip.mean == Approx(summaryOf(flip(constant(1, 1, vec3(0.5f)), constant(1, 1, vec3(0.6f)))).mean).epsilon(1e-4));
    CHECK_FALSE(difference.identical);
}

TEST_CASE("compare: radiance becomes display values for PSNR, exposed and cut at 1") {
    const Image reference = constant(4, 4, vec3(0.21404f)), test = constant(4, 4, vec3(0.31855f));
    CHECK(*compareImages(reference, test, PixelValues::radiance).psnr == Approx(20).epsilon(1e-3));
    CHECK(std::isinf(*compareImages(reference, test, PixelValues::radiance, 8).psnr));  // both white
    CHECK(compareImages(reference, test, PixelValues::radiance, 8).relativeError.max == Approx((0.31855 - 0.21404) / (1.01 * 0.21404)));
    CHECK(compareImages(reference, test, PixelValues::radiance, 8).flip.mean == Approx(summaryOf(hdrFlip(reference, test)).mean));
}

TEST_CASE("compare: an alpha channel counts for identity and the relative error, not for what is seen") {
    Image a = noise(16, 16, 1, 4), b = a;
    b.at(3, 4, 3) = 1 - b.at(3, 4, 3);
    const ImageDifference difference = compareImages(a, b, PixelValues::display);
    CHECK_FALSE(difference.identical);
    CHECK(difference.relativeError.max > 0);
    CHECK(std::isinf(*difference.psnr));
    CHECK(difference.flip.max == 0);
    CHECK(compareImages(a, a, PixelValues::display).identical);
}

TEST_CASE("compare: numbers have a relative error and nothing that is seen") {
    for (const uint32_t channels : {1u, 3u}) {
        const ImageDifference difference = compareImages(noise(5, 5, 1, channels), noise(5, 5, 2, channels), PixelValues::numbers);
        CHECK(difference.relativeError.max > 0);
        CHECK_FALSE(difference.psnr);
        CHECK_FALSE(difference.ssim);
        CHECK_FALSE(difference.flipMap);
    }
}

TEST_CASE("compare: pixels that are not finite are counted and placed, the others have their errors") {
    Image reference = constant(7, 5, vec3(1)), test = reference;
    test.at(3, 2, 1) = kNaN;
    reference.at(1, 4, 0) = std::numeric_limits<float>::infinity();
    test.at(0, 0, 0) = 2;
    const ImageDifference difference = compareImages(reference, test, PixelValues::radiance);
    CHECK(difference.notFinite == 2);
    CHECK(difference.firstNotFinite == uvec2(3, 2));
    CHECK(difference.relativeError.max == Approx(1 / 1.01));
    CHECK(difference.relativeError.share == Approx(33.0 / 35));
    CHECK_FALSE(difference.flipMap);
    CHECK_FALSE(compareImages(test, test, PixelValues::radiance).identical);
}

TEST_CASE("difference map: a map for each error, in full resolution; the worst pixel is the lightest, what is not finite is grey") {
    Image reference = constant(400, 3, vec3(1)), test = reference;
    test.at(9, 1, 0) = 2;
    ImageDifference difference = compareImages(reference, test, PixelValues::radiance);
    const Image both = differenceMap(difference);
    CHECK(both.width == 2 * 400 + 4);
    CHECK(both.height > 3);
    CHECK(colorAt(both, 9, 1).x > 0.98f);  // the yellow end of viridis
    CHECK(colorAt(both, 8, 1) == colorAt(both, 0, 0));
    CHECK_FALSE(isGrey(colorAt(both, 0, 0)));
    CHECK(colorAt(both, 404 + 9, 1) != colorAt(both, 404 + 300, 1));  // FLIP sees it too
    test.at(8, 1, 0) = kNaN;
    difference = compareImages(reference, test, PixelValues::radiance);
    const Image one = differenceMap(difference);
    CHECK(one.width == 400);
    CHECK(isGrey(colorAt(one, 8, 1)));
}

TEST_CASE("difference map: tiny pictures, no error and errors without end are drawn") {
    const float huge = std::numeric_limits<float>::max();
    for (const auto& [a, b] : {std::pair(0.0f, 0.0f), std::pair(1.0f, 1.0f), std::pair(0.0f, huge), std::pair(huge, 0.0f), std::pair(kNaN, 0.0f)}) {
        const Image page = differenceMap(compareImages(constant(1, 1, vec3(a)), constant(1, 1, vec3(b)), PixelValues::radiance));
        CHECK(page.width > 1);
        for (const float value : page.data) CHECK((value >= 0 && value <= 1));
    }
}
