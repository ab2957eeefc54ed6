#include "output/display.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "output/tone_map.shared.h"

using namespace luciole;
using doctest::Approx;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr ToneMap kToneMaps[] = {ToneMap::none, ToneMap::reinhard, ToneMap::aces, ToneMap::agx};

Image pixel(vec3 color) {
    Image image(1, 1, 3);
    image.data = {color.x, color.y, color.z};
    return image;
}

vec3 shown(vec3 color, ToneMap toneMap) { return shared::displayColor(color, uint32_t(toneMap)); }

}  // namespace

TEST_CASE("srgb: the encoding keeps 0 and 1, is linear near black and continuous where its parts meet") {
    CHECK(shared::srgbEncode(0) == 0);
    CHECK(shared::srgbEncode(1) == Approx(1).epsilon(1e-6));  // 1.055 - 0.055 in float
    CHECK(shared::srgbEncode(0.001f) == Approx(0.01292).epsilon(1e-6));
    CHECK(shared::srgbEncode(0.18f) == Approx(0.461356).epsilon(1e-5));
    CHECK(shared::srgbEncode(0.214041f) == Approx(0.5).epsilon(1e-5));
    // The standard's own gap at the seam is 3e-8.
    CHECK(shared::srgbEncode(0.0031309f) == Approx(shared::srgbEncode(0.0031307f)).epsilon(1e-4));
}

TEST_CASE("tone map: reinhard halves white and never reaches 1") {
    CHECK(shared::reinhard(vec3(1)).x == 0.5f);
    CHECK(shared::reinhard(vec3(3)).x == 0.75f);
    CHECK(shared::reinhard(vec3(1000)).x < 1);
}

TEST_CASE("tone map: aces is Narkowicz's rational function") {
    CHECK(shared::acesNarkowicz(vec3(0)).x == 0);
    CHECK(shared::acesNarkowicz(vec3(1)).x == Approx(2.54 / 3.16).epsilon(1e-6));
    CHECK(shared::acesNarkowicz(vec3(7.24322f)).x == Approx(1).epsilon(1e-5));  // root of 0.08 x^2 - 0.56 x - 0.14
}

TEST_CASE("tone map: agx follows Wrensch's polynomial on grey, where both matrices do nothing") {
    for (const double x : {0.001, 0.18, 1.0, 5.0}) {
        const double t = (std::log2(x) + 12.47393) / (4.026069 + 12.47393);
        const double curve = 15.5 * std::pow(t, 6) - 40.14 * std::pow(t, 5) + 31.96 * std::pow(t, 4) -
                             6.868 * std::pow(t, 3) + 0.4298 * t * t + 0.1191 * t - 0.00232;
        const vec3 mapped = shared::agxWrensch(vec3(float(x)));
        // The rows of the published matrices sum to 1 within 3e-4, and floats carry terms up to 40.
        for (int c = 0; c < 3; ++c) CHECK(mapped[c] == Approx(std::pow(curve, 2.2)).epsilon(5e-3));
    }
}

TEST_CASE("tone map: agx moves a strong colour towards white") {
    const vec3 dim = shared::agxWrensch(vec3(0.2f, 0.001f, 0.001f));
    const vec3 bright = shared::agxWrensch(vec3(50, 0.001f, 0.001f));
    CHECK(bright.y / bright.x > dim.y / dim.x);
    CHECK(dim.x > dim.y);
}

TEST_CASE("tone map: every curve is monotonous on grey and starts at black") {
    for (const ToneMap toneMap : kToneMaps) {
        CHECK(shown(vec3(0), toneMap).x <= 0.005f);  // agx's fit misses 0 by 0.002
        float before = -1;
        for (float x = 0.001f; x < 20; x *= 1.1f) {
            const float value = shown(vec3(x), toneMap).x;
            CHECK(value >= before);
            before = value;
        }
        CHECK(before > 0.97f);
    }
}

TEST_CASE("display: whatever comes in, what is shown lies in [0, 1]; NaN and negative values are black") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const ToneMap toneMap : kToneMaps) {
        for (const float bad : {nan, -kInfinity, -1.0f, kInfinity, std::numeric_limits<float>::max(), 1e-40f}) {
            for (const vec3 color : {vec3(bad), vec3(bad, 0.5f, 0.5f), vec3(0, 3, bad)}) {
                const vec3 value = shown(color, toneMap);
                for (int c = 0; c < 3; ++c) CHECK((value[c] >= 0 && value[c] <= 1));
            }
        }
        CHECK(shown(vec3(nan), toneMap) == shown(vec3(0), toneMap));
        CHECK(shown(vec3(-1), toneMap) == shown(vec3(0), toneMap));
        CHECK(shown(vec3(kInfinity), toneMap).x > 0.99f);
    }
}

TEST_CASE("display: exposure is counted in stops, before the tone map") {
    const Image plain = displayImage(pixel({0.4f, 0.2f, 0.1f}), 0, ToneMap::reinhard);
    const Image lifted = displayImage(pixel({0.1f, 0.05f, 0.025f}), 2, ToneMap::reinhard);
    CHECK(plain.data == lifted.data);
    CHECK(plain.data[0] == Approx(shared::srgbEncode(0.4f / 1.4f)).epsilon(1e-6));
}
