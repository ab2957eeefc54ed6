// Relative error, PSNR and SSIM, by their definitions.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <luciole/error.hpp>
#include <luciole/metrics.hpp>

#include "metrics/image_building.hpp"

using namespace luciole;
using namespace luciole::test;
using doctest::Approx;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("relative error: is |test - reference| / (|reference| + 1 % of the mean), the worst channel of each pixel") {
    Image reference(2, 1, 3), test(2, 1, 3);
    reference.data = {1, 2, 3, 0, 0, 0};  // mean 1
    test.data = {1, 3, 2, 0, 0.01f, 0};
    const Image errors = relativeError(reference, test);
    REQUIRE(errors.channels == 1);
    CHECK(errors.data[0] == Approx(1 / 2.01));
    CHECK(errors.data[1] == Approx(0.01 / 0.01));
    const ErrorSummary summary = summaryOf(errors);
    CHECK(summary.mean == Approx((1 / 2.01 + 1) / 2));
    CHECK(summary.max == Approx(1));
    CHECK(summary.share == 1);
}

TEST_CASE("relative error: the mean that dark pixels are held against is that of magnitudes, so normals have one too") {
    Image reference(2, 1, 1), test(2, 1, 1);
    reference.data = {-1, 1};
    test.data = {-1, 0};
    CHECK(relativeError(reference, test).data[1] == Approx(1 / 1.01));
}

TEST_CASE("relative error: a NaN or an infinity in either image makes its pixel infinite, even in both, and no other") {
    for (const float bad : {kNaN, kInfinity, -kInfinity})
        for (const auto& [inReference, inTest] : {std::pair(bad, 1.0f), std::pair(1.0f, bad), std::pair(bad, bad)}) {
            Image reference = constant(3, 1, vec3(1)), test = constant(3, 1, vec3(1));
            reference.at(1, 0, 2) = inReference;
            test.at(1, 0, 2) = inTest;
            CHECK(relativeError(reference, test).data == std::vector<float>{0, kInfinity, 0});
        }
    const float huge = std::numeric_limits<float>::max();
    CHECK(relativeError(constant(1, 1, vec3(0)), constant(1, 1, vec3(huge))).data[0] == huge);  // large, but known
}

TEST_CASE("relative error: 99.9 % of the pixels are at or below the percentile, and a mask chooses pixels") {
    Image errors(2000, 1, 1);
    for (uint32_t i = 0; i < 2000; ++i) errors.data[i] = float(i * 7 % 2000);  // each of 0 ... 1999 once
    CHECK(summaryOf(errors).p999 == 1998);
    CHECK(summaryOf(errors).max == 1999);
    CHECK(summaryOf(errors).mean == 999.5);
    std::vector<bool> mask(2000);
    for (size_t i = 0; i < 2000; ++i) mask[i] = errors.data[i] < 1000;
    CHECK(summaryOf(errors, &mask).max == 999);
    CHECK(summaryOf(errors, &mask).share == 0.5);
    const std::vector<bool> none(2000);
    CHECK(summaryOf(errors, &none).share == 0);
    CHECK(summaryOf(errors, &none).max == 0);
}

TEST_CASE("psnr: a tenth off everywhere is 20 dB, 1 off in a hundredth of the values too; equal images have no end") {
    CHECK(psnr(constant(10, 10, vec3(0.5f)), constant(10, 10, vec3(0.6f))) == Approx(20).epsilon(1e-6));
    Image spot(10, 10, 1);
    spot.at(3, 7, 0) = 1;
    CHECK(psnr(Image(10, 10, 1), spot) == Approx(20));
    CHECK(psnr(spot, spot) == std::numeric_limits<double>::infinity());
}

TEST_CASE("ssim: of two even images only their brightness tells, (2 a b + C1) / (a^2 + b^2 + C1)") {
    const double a = 0.5, b = 0.7, C1 = 1e-4;
    const double expected = (2 * a * b + C1) / (a * a + b * b + C1);
    for (const uint32_t side : {1u, 5u, 11u, 40u}) {
        const Image first = constant(side, side, vec3(float(a))), second = constant(side, side, vec3(float(b)));
        CHECK(ssim(first, second) == Approx(expected).epsilon(1e-4));  // variances as differences of floats, against C2 = 9e-4
    }
}

TEST_CASE("ssim: is 1 for equal images, no matter the order, and negative for a negative") {
    const Image a = noise(33, 21, 1), b = noise(33, 21, 2);
    CHECK(ssim(a, a) == 1);
    CHECK(ssim(a, b) == ssim(b, a));
    CHECK(std::abs(ssim(a, b)) < 0.1);
    Image negative = a;
    for (float& value : negative.data) value = 1 - value;
    CHECK(ssim(a, negative) < -0.7);
}

TEST_CASE("ssim: windows that reach beyond the edge do not count") {
    const Image a = noise(40, 40, 1, 1);
    Image b = a;
    for (uint32_t x = 0; x < 40; ++x) b.at(x, 20, 0) = 0.5f;
    // Of 30 rows of windows those with centres in rows 15 to 25 see the line.
    CHECK(ssim(a, b) > 19.0 / 30);
    CHECK(ssim(a, b) < 1);
}

TEST_CASE("metrics: images without pixels or of two shapes are refused, and the message gives both") {
    const Image fits(4, 3, 3);
    for (const Image& other : {Image(3, 4, 3), Image(4, 3, 4), Image()})
        for (const auto metric : {+[](const Image& a, const Image& b) { relativeError(a, b); }, +[](const Image& a, const Image& b) { psnr(a, b); },
                                  +[](const Image& a, const Image& b) { ssim(a, b); }, +[](const Image& a, const Image& b) { flip(a, b); },
                                  +[](const Image& a, const Image& b) { hdrFlip(a, b); },
                                  +[](const Image& a, const Image& b) { compareImages(a, b, PixelValues::radiance); }}) {
            CHECK_THROWS_WITH_AS(metric(fits, other), doctest::Contains("4 x 3 x 3 and "), Error);
            CHECK_THROWS_AS(metric(other, fits), Error);
        }
    CHECK_THROWS_WITH_AS(flip(Image(2, 2, 1), Image(2, 2, 1)), "FLIP: expected two images of one shape with 3 channels, got 2 x 2 x 1 and 2 x 2 x 1",
                         Error);
    CHECK_THROWS_AS(psnr(Image(), Image()), Error);
}
