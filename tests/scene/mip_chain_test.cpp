#include <doctest/doctest.h>

#include "scene/mip_chain.hpp"

using namespace luciole;

namespace {

Texels grey(uint32_t width, uint32_t height, const std::vector<uint8_t>& values) {
    Texels texels{.name = "grey", .width = width, .height = height, .rgba = {}};
    for (const uint8_t value : values) texels.rgba.insert(texels.rgba.end(), {value, value, value, value});
    return texels;
}

}  // namespace

TEST_CASE("mip chain: sizes halve, rounded down, to 1 x 1, and level 0 is the picture itself") {
    const Texels picture = grey(7, 2, std::vector<uint8_t>(14, 9));
    const auto levels = mipChain(picture, false);
    REQUIRE(levels.size() == 3);
    CHECK(levels[0].rgba == picture.rgba);
    CHECK((levels[1].width == 3 && levels[1].height == 1));
    CHECK((levels[2].width == 1 && levels[2].height == 1));
    CHECK(mipChain(grey(1, 1, {5}), true).size() == 1);
}

TEST_CASE("mip chain: linear texels are averaged and rounded to nearest") {
    const auto levels = mipChain(grey(2, 2, {0, 10, 20, 31}), false);  // 61 / 4 = 15.25
    CHECK(levels[1].rgba == std::vector<uint8_t>{15, 15, 15, 15});
    CHECK(mipChain(grey(2, 1, {10, 11}), false)[1].rgba[0] == 11);  // 10.5 goes up
}

TEST_CASE("mip chain: sRGB texels are averaged in linear light, their alpha as it is") {
    const auto levels = mipChain(grey(2, 1, {0, 255}), true);
    // Half the light is 1.055 * 0.5^(1 / 2.4) - 0.055 = 0.735357 encoded, 187.5 of 255.
    CHECK(int(levels[1].rgba[0]) == 188);
    CHECK(int(levels[1].rgba[3]) == 128);
}

TEST_CASE("mip chain: a uniform picture stays what it is, every byte, at any size") {
    for (int value = 0; value < 256; ++value) {
        for (const auto& level : mipChain(grey(5, 3, std::vector<uint8_t>(15, uint8_t(value))), true))
            for (const uint8_t byte : level.rgba) CHECK(int(byte) == value);
    }
}

TEST_CASE("mip chain: on odd sides texels count by the area that is covered") {
    // 3 -> 1: thirds. 5 -> 2: the left texel covers columns 0, 1 and half of 2, each 1 / 2.5 of its width.
    CHECK(int(mipChain(grey(3, 1, {0, 90, 210}), false)[1].rgba[0]) == 100);
    const auto five = mipChain(grey(5, 1, {10, 60, 100, 0, 250}), false)[1];
    CHECK(int(five.rgba[0]) == (10 * 2 + 60 * 2 + 100) / 5);
    CHECK(int(five.rgba[4]) == (100 + 0 * 2 + 250 * 2) / 5);
    const auto square = mipChain(grey(3, 3, {0, 0, 0, 0, 90, 0, 0, 0, 0}), false)[1];
    CHECK(int(square.rgba[0]) == 10);
}

TEST_CASE("mip chain: sRGB bytes decode to the standard's values") {
    CHECK(srgbByteToLinear(0) == 0);
    CHECK(srgbByteToLinear(255) == doctest::Approx(1).epsilon(1e-15));
    CHECK(srgbByteToLinear(10) == doctest::Approx(10 / 255.0 / 12.92));      // on the linear piece
    CHECK(srgbByteToLinear(188) == doctest::Approx(0.50289).epsilon(1e-5));  // ((188/255 + .055) / 1.055)^2.4
}
