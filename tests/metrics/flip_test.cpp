// FLIP, by values that can be computed by hand. independent_metrics.py derives whole pictures again.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <luciole/metrics.hpp>

#include "metrics/convolution.hpp"
#include "metrics/flip.hpp"
#include "metrics/image_building.hpp"

using namespace luciole;
using namespace luciole::test;
using doctest::Approx;

namespace {

/// Of two even pictures: no edges, the colours are all. Checks that it is so at each pixel.
double flipOfEven(vec3 reference, vec3 test) {
    const Image errors = flip(constant(9, 7, reference), constant(9, 7, test));
    for (const float error : errors.data) CHECK(error == Approx(errors.data[0]).epsilon(1e-4));
    return errors.data[0];
}

/// Andersson et al. 2020, section 4.1.3, of a distance of Hunt-adjusted colours. The largest is that of green and blue, 203.30.
double redistributed(double distance) {
    const double c = std::pow(distance, 0.7), cMax = std::pow(203.3017, 0.7);
    return c < 0.4 * cMax ? 0.95 * c / (0.4 * cMax) : 0.95 + 0.05 * (c - 0.4 * cMax) / (0.6 * cMax);
}

double mean(const Image& errors) { return summaryOf(errors).mean; }

}  // namespace

TEST_CASE("flip: 67 pixels are in a degree") { CHECK(kFlipPixelsPerDegree == Approx(67.0206)); }

TEST_CASE("flip: equal pictures have no error, of one pixel and of many") {
    for (const auto& [width, height] : {std::pair(1u, 1u), std::pair(3u, 50u), std::pair(64u, 48u)}) {
        const Image image = noise(width, height, 1);
        CHECK(summaryOf(flip(image, image)).max == 0);
        CHECK(summaryOf(hdrFlip(image, image)).max == 0);
    }
}

TEST_CASE("flip: green and blue are the two colours farthest from each other, at 1") {
    CHECK(flipOfEven({0, 1, 0}, {0, 0, 1}) == Approx(1).epsilon(1e-5));
    for (uint32_t i = 0; i < 8; ++i)
        for (uint32_t j = 0; j < i; ++j) {
            const double error = flipOfEven(vec3(i & 1, i >> 1 & 1, i >> 2), vec3(j & 1, j >> 1 & 1, j >> 2));
            CHECK(error <= 1);
            CHECK(error > 0.9);
        }
}

TEST_CASE("flip: even greys differ by their lightness alone, redistributed") {
    // CIELAB's lightness 116 Y^(1/3) - 16 of white is 100, of black 0.
    CHECK(flipOfEven(vec3(0), vec3(1)) == Approx(redistributed(100)).epsilon(1e-4));
    const float grey = 0.735357f;  // sRGB code of Y = 0.5
    CHECK(flipOfEven(vec3(0), vec3(grey)) == Approx(redistributed(116 * std::cbrt(0.5) - 16)).epsilon(1e-4));
    CHECK(flipOfEven(vec3(1), vec3(grey)) == Approx(redistributed(116 - 116 * std::cbrt(0.5))).epsilon(1e-4));
}

TEST_CASE("flip: colours count by their distance with the Hunt effect") {
    // CIELAB of Rec. 709's primaries with D65: red (53.24, 80.09, 67.20), green (87.73, -86.18, 83.18).
    const double a = 0.5324 * 80.09 + 0.8773 * 86.18, b = 0.5324 * 67.20 - 0.8773 * 83.18;
    CHECK(flipOfEven({1, 0, 0}, {0, 1, 0}) == Approx(redistributed(87.73 - 53.24 + std::hypot(a, b))).epsilon(1e-3));
}

TEST_CASE("flip: does not matter which picture is the reference, nor which way they are turned") {
    const Image a = noise(40, 30, 1), b = noise(40, 30, 2);
    const Image errors = flip(a, b), swapped = flip(b, a);
    CHECK(errors.data == swapped.data);
    const auto turned = [](const Image& image) {
        Image result(image.height, image.width, image.channels);
        for (uint32_t y = 0; y < image.height; ++y)
            for (uint32_t x = 0; x < image.width; ++x)
                for (uint32_t c = 0; c < image.channels; ++c) result.at(y, x, c) = image.at(x, y, c);
        return result;
    };
    const Image back = turned(flip(turned(a), turned(b)));
    for (size_t i = 0; i < errors.data.size(); ++i) CHECK(back.data[i] == Approx(errors.data[i]).epsilon(1e-3));
}

TEST_CASE("flip: an edge that is missing is worse than its colours alone, and a speck is seen less the more pixels a degree has") {
    Image edge = constant(64, 64, vec3(0.4f));
    for (uint32_t y = 0; y < 64; ++y)
        for (uint32_t x = 32; x < 64; ++x)
            for (uint32_t c = 0; c < 3; ++c) edge.at(x, y, c) = 0.5f;
    const Image errors = flip(constant(64, 64, vec3(0.4f)), edge);
    CHECK(errors.at(32, 32, 0) > 0);
    CHECK(errors.at(34, 32, 0) > 1.2f * errors.at(60, 32, 0));  // both sides have the same colours, but for the filter
    CHECK(errors.at(2, 32, 0) < 1e-3f);
    Image speck = constant(64, 64, vec3(0.4f));
    for (uint32_t c = 0; c < 3; ++c) speck.at(32, 32, c) = 1;
    const auto worst = [&](double pixelsPerDegree) { return summaryOf(flip(constant(64, 64, vec3(0.4f)), speck, pixelsPerDegree)).max; };
    CHECK(worst(134) < worst(67));
    CHECK(worst(67) < worst(33));
}

TEST_CASE("hdr flip: an even reference is shown at 85 %, whatever its radiance") {
    // aces(x) = 0.85 at x = 1.2713; twice as bright it shows 2.5426.
    const double shown = 2.5426 * (2.51 * 2.5426 + 0.03) / (2.5426 * (2.43 * 2.5426 + 0.59) + 0.14);
    const double expected = redistributed(116 * (std::cbrt(shown) - std::cbrt(0.85)));
    for (const float radiance : {1e-3f, 1.0f, 5e4f})
        CHECK(mean(hdrFlip(constant(8, 8, vec3(radiance)), constant(8, 8, vec3(2 * radiance)))) == Approx(expected).epsilon(1e-3));
}

TEST_CASE("hdr flip: a difference in the dark shows at an exposure of its own") {
    Image reference = constant(64, 32, vec3(0.001f)), test = constant(64, 32, vec3(0.002f));
    for (uint32_t y = 0; y < 32; ++y)
        for (uint32_t x = 40; x < 64; ++x)
            for (uint32_t c = 0; c < 3; ++c) reference.at(x, y, c) = test.at(x, y, c) = 10;
    const Image errors = hdrFlip(reference, test);
    // The last exposure shows the reference's dark at 85 %, as above. At the first both are black.
    const double shown = 2.5426 * (2.51 * 2.5426 + 0.03) / (2.5426 * (2.43 * 2.5426 + 0.59) + 0.14);
    CHECK(errors.at(2, 16, 0) > 0.999 * redistributed(116 * (std::cbrt(shown) - std::cbrt(0.85))));
    CHECK(errors.at(62, 16, 0) == 0);
}

TEST_CASE("hdr flip: references that are black, all or most of them, have finite errors") {
    Image spot(16, 16, 3);
    spot.at(8, 8, 1) = 100;
    for (const Image& reference : {Image(16, 16, 3), spot}) {
        const ErrorSummary error = summaryOf(hdrFlip(reference, constant(16, 16, vec3(1))));
        CHECK(error.mean > 0.1);
        CHECK(error.max <= 1);
    }
    CHECK(summaryOf(hdrFlip(Image(16, 16, 3), constant(16, 16, vec3(-1)))).max == 0);
}

TEST_CASE("convolution: edges go on, and what is even stays so") {
    const metrics::Kernel kernel = metrics::gaussian(2, 6);
    Image plane(3, 5, 1);
    std::ranges::fill(plane.data, 0.7f);
    for (const float value : metrics::convolve(plane, kernel, kernel).data) CHECK(value == Approx(0.7f).epsilon(1e-6));
    Image dot(13, 13, 1);
    dot.at(6, 6, 0) = 1;
    CHECK(metrics::convolve(dot, kernel, kernel).at(4, 9, 0) == Approx(kernel[4] * kernel[9]));
}
