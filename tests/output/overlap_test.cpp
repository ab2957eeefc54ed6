#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <luciole/error.hpp>
#include <luciole/output.hpp>
#include <set>

#include "io/temporary_folder.hpp"
#include "output/drawing.hpp"

using namespace luciole;

namespace {

Image counts(uint32_t width, uint32_t height, const std::vector<float>& values) {
    Image image(width, height, 1);
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = values[i % values.size()];
    return image;
}

vec3 colorAt(const Image& image, uint32_t x, uint32_t y) {
    return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

vec3 rgb8(uint32_t hex) { return vec3(float(hex >> 16 & 255), float(hex >> 8 & 255), float(hex & 255)) / 255.0f; }

uint32_t rightMap(const Image& page) { return (page.width + kOverlapGap) / 2; }

bool isGrey(vec3 color) { return color.x == color.y && color.y == color.z; }

/// Rec. 709 weights of the linear values.
double luminance(vec3 encoded) {
    const auto linear = [](double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(encoded.x) + 0.7152 * linear(encoded.y) + 0.0722 * linear(encoded.z);
}

/// Whether `text`, drawn with `color` at `scale`, stands in `page`, somewhere below the maps.
bool shows(const Image& page, uint32_t mapHeight, uint32_t scale, std::string_view text) {
    Image wanted(textWidth(text, scale), kCharacterHeight * scale, 3);
    drawText(wanted, 0, 0, scale, text, vec3(1));
    const auto isInk = [&](uint32_t x, uint32_t y) { return page.at(x, y, 0) > 0.8f && isGrey(colorAt(page, x, y)); };
    const auto isAt = [&](uint32_t left, uint32_t top) {
        for (uint32_t y = 0; y < wanted.height; ++y)
            for (uint32_t x = 0; x < wanted.width; ++x)
                if (left + x < page.width ? isInk(left + x, top + y) != (wanted.at(x, y, 0) > 0)
                                          : wanted.at(x, y, 0) > 0)
                    return false;
        return true;
    };
    for (uint32_t top = mapHeight; top + wanted.height <= page.height; ++top)
        for (uint32_t left = 0; left < page.width; ++left)
            if (isAt(left, top)) return true;
    return false;
}

}  // namespace

TEST_CASE("overlap: sums are exact where floats stop counting by one, and zero evaluations cover nothing") {
    const float large = 16777216;  // 2^24: the next whole number is no float
    const OverlapCounts counted = countOverlap(counts(3, 2, {large, 1, 0}), counts(3, 2, {1, 0, 0}));
    CHECK(counted.evaluations == 2 * (16777216 + 1));
    CHECK(counted.usefulEvaluations == 2);
    CHECK(counted.coveredPixels == 4);
}

TEST_CASE("overlap: images of other shapes are refused, and the message says which") {
    const Image fits(3, 2, 1);
    for (const Image& bad : {Image(2, 3, 1), Image(3, 2, 3), Image()}) {
        CHECK_THROWS_WITH_AS(countOverlap(fits, bad), doctest::Contains("useful-evaluations: expected"), Error);
        CHECK_THROWS_AS(overlapHeatMap(bad, fits), Error);
    }
}

TEST_CASE("heat map: both maps share one scale; no lights are grey, lights that do not reach are not") {
    //                                          none, all wasted, a third of the scale, its end
    const Image page = overlapHeatMap(counts(4, 1, {0, 1, 3, 9}), counts(4, 1, {0, 0, 3, 9}));
    const uint32_t right = rightMap(page);
    for (const uint32_t left : {0u, right}) {
        CHECK(isGrey(colorAt(page, left, 0)));
        CHECK(colorAt(page, left + 2, 0) == rgb8(0x31688e));  // viridis at 3 / 9: the fourth of ten colours
        CHECK(colorAt(page, left + 3, 0) == rgb8(0xfde725));
    }
    CHECK(colorAt(page, 1, 0) == rgb8(0x482878));
    CHECK(colorAt(page, right + 1, 0) == rgb8(0x440154));
    CHECK_FALSE(isGrey(colorAt(page, right + 1, 0)));
}

TEST_CASE("heat map: more lights are lighter, in a grey print too") {
    constexpr uint32_t kCount = 256;
    Image ramp(kCount, 1, 1);
    for (uint32_t i = 0; i < kCount; ++i) ramp.at(i, 0, 0) = float(i);
    const Image page = overlapHeatMap(ramp, ramp);  // begins with the grey of no light at all
    for (uint32_t i = 1; i < kCount; ++i) CHECK(luminance(colorAt(page, i, 0)) > luminance(colorAt(page, i - 1, 0)));
}

TEST_CASE("heat map: the legend gives titles, largest counts, means over covered pixels, and the scale's ends") {
    // Means over the three covered pixels of each row, not over all four.
    const Image page = overlapHeatMap(counts(4, 3, {0, 100, 150, 50}), counts(4, 3, {0, 50, 25, 0}));
    for (const char* text : {"lights evaluated", "lights that reach the surface", "max 150  mean 100.00",
                             "max 50  mean 25.00", "useful 25.0 %", "none"})
        CHECK_MESSAGE(shows(page, 3, 1, text), text);
    for (const char* number : {"0", "20", "100", "150"}) CHECK_MESSAGE(shows(page, 3, 1, number), number);
    CHECK_FALSE(shows(page, 3, 1, "max 151"));
}

TEST_CASE("heat map: a picture in which no light was evaluated is grey, with a scale from 0 to 1") {
    const Image none(5, 4, 1);
    const Image page = overlapHeatMap(none, none);
    for (uint32_t y = 0; y < 4; ++y)
        for (uint32_t x = 0; x < 5; ++x) {
            CHECK(isGrey(colorAt(page, x, y)));
            CHECK(colorAt(page, rightMap(page) + x, y) == colorAt(page, 0, 0));
        }
    CHECK(shows(page, 4, 1, "max 0  mean 0.00"));
    CHECK_FALSE(shows(page, 4, 1, "useful"));  // nothing of nothing
    CHECK(shows(page, 4, 1, "1"));
}

TEST_CASE("heat map: maps of every size stand whole in the page, and no text is cut off") {
    for (const auto& [width, height] : {std::pair(1u, 1u), {7u, 300u}, {333u, 2u}, {641u, 5u}, {3000u, 1u}}) {
        const uint32_t side = width;  // what doctest prints must not be a binding
        CAPTURE(side);
        const Image page = overlapHeatMap(counts(width, height, {65535, 1}), counts(width, height, {12345, 1}));
        CHECK(page.width >= 2 * width + kOverlapGap);
        CHECK(page.height > height);
        CHECK(std::ranges::all_of(page.data, [](float value) { return value >= 0 && value <= 1; }));
        // The first pixel of each map, and the last one that the pattern puts at an end of the scale.
        CHECK(colorAt(page, 0, 0) == rgb8(0xfde725));
        CHECK_FALSE(isGrey(colorAt(page, rightMap(page) + width - 1, height - 1)));
        CHECK(shows(page, height, std::clamp(width / 320, 1u, 8u), "lights that reach the surface"));
        CHECK(shows(page, height, std::clamp(width / 320, 1u, 8u), "65535"));
    }
}

TEST_CASE("list map: lengths on a scale of their own, slices in different colours, tiles like a chessboard, nothing grey") {
    const Image lengths = counts(4, 4, {0, 3, 9, 9}), slices = counts(4, 4, {-1, 0, 1, 17});
    const Image page = lightListMap(lengths, slices, 2);
    const uint32_t right = rightMap(page);
    CHECK(isGrey(colorAt(page, 0, 0)));
    CHECK(colorAt(page, 1, 0) == rgb8(0x31688e));  // viridis at 3 / 9: the fourth of ten colours
    CHECK(colorAt(page, 3, 0) == rgb8(0xfde725));
    CHECK(isGrey(colorAt(page, right, 0)));
    std::set<std::vector<float>> seen;
    for (uint32_t x = 1; x < 4; ++x) {
        const vec3 color = colorAt(page, right + x, 0);
        CHECK_FALSE(isGrey(color));
        CHECK(seen.insert({color.x, color.y, color.z}).second);
        CHECK(luminance(colorAt(page, right + x, 2)) != doctest::Approx(luminance(color)));  // the tile below
        CHECK(colorAt(page, right + x, 1) == color);                                           // the same tile
    }
    for (const char* text : {"lights in the list", "tiles and slices of depth", "max 9  mean 7.00", "tile side 2  slices 3", "near", "far", "none"})
        CHECK_MESSAGE(shows(page, 4, 1, text), text);
}

TEST_CASE("list map: slices next to each other differ in colour, up to the last of a float's octaves") {
    Image slices(512, 1, 1);
    for (uint32_t i = 0; i < 512; ++i) slices.at(i, 0, 0) = float(i);
    const Image page = lightListMap(Image(512, 1, 1), slices, 1024);
    for (uint32_t i = 1; i < 512; ++i) CHECK(glm::length(colorAt(page, rightMap(page) + i, 0) - colorAt(page, rightMap(page) + i - 1, 0)) > 0.3f);
}

TEST_CASE("list map: of a picture without surfaces there is a page, and images of other shapes are refused") {
    Image none(5, 4, 1);
    for (float& slice : none.data) slice = -1;
    const Image page = lightListMap(Image(5, 4, 1), none, 16);
    CHECK(isGrey(colorAt(page, rightMap(page), 0)));
    CHECK(shows(page, 4, 1, "tile side 16  slices 0"));
    for (const Image& bad : {Image(4, 5, 1), Image(5, 4, 3), Image()}) {
        CHECK_THROWS_WITH_AS(lightListMap(Image(5, 4, 1), bad, 16), doctest::Contains("list-length, list-slice: expected"), Error);
        CHECK_THROWS_AS(lightListMap(bad, Image(5, 4, 1), 16), Error);
    }
}

TEST_CASE("drawing: each character of the font differs from all others, and what lies outside is cut off") {
    std::set<std::vector<float>> seen;
    for (const char character : std::string_view("0123456789.%acdefghilmnoprstuvx ")) {
        Image image(kCharacterWidth, kCharacterHeight, 3);
        drawText(image, 0, 0, 1, std::string_view(&character, 1), vec3(1));
        CHECK_MESSAGE(seen.insert(image.data).second, character);
    }
    Image small(3, 3, 3);
    drawText(small, 2, 2, 4, "8", vec3(1));
    drawText(small, 30, 30, 1, "8", vec3(1));
    CHECK(std::ranges::count(small.data, 1.0f) == 0);  // the corner of an 8 is empty
    fillRectangle(small, 1, 2, 99, 99, vec3(1));
    CHECK(std::ranges::count(small.data, 1.0f) == 2 * 3);
}

TEST_CASE("exr: counts and fingerprints stay exact in files of half floats") {
    const test::TemporaryFolder folder;
    std::map<std::string, Image> layers;
    for (const char* name : {"evaluations", "useful-evaluations", "light-fingerprint"})
        layers[name] = counts(2, 1, {70001, 2049});  // half counts to 2048 by one, and ends at 65504
    writeExr(folder / "a.exr", layers, ExrType::half);
    for (const auto& layer : readExr(folder / "a.exr")) CHECK_MESSAGE(layer.second.data == layers.at(layer.first).data, layer.first);
}
