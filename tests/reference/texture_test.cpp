#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "reference/texture.hpp"
#include "scene/mip_chain.hpp"

using namespace luciole;
using namespace luciole::reference;
using doctest::Approx;

namespace {

constexpr Sampler kNearest{.magFilter = Filter::nearest, .minFilter = Filter::nearest, .mipFilter = MipFilter::none};

/// A grey texture of linear bytes.
SampledTexture grey(uint32_t width, uint32_t height, const std::vector<uint8_t>& values, const Sampler& sampler) {
    Texels texels{.name = "", .width = width, .height = height, .rgba = {}};
    for (const uint8_t value : values) texels.rgba.insert(texels.rgba.end(), {value, value, value, 255});
    return {std::make_shared<std::vector<Texels>>(mipChain(texels, false)), sampler, false};
}

/// Red at `uv` without minification, in bytes.
double red(const SampledTexture& texture, dvec2 uv) { return texture.sample(uv, dvec2(0), dvec2(0)).r * 255; }

}  // namespace

TEST_CASE("texture: nearest takes the texel that covers the point, row 0 at v = 0") {
    const auto texture = grey(2, 2, {10, 20, 30, 40}, kNearest);
    CHECK(red(texture, {0.1, 0.1}) == Approx(10));
    CHECK(red(texture, {0.49, 0.51}) == Approx(30));
    CHECK(red(texture, {0.51, 0.49}) == Approx(20));
    CHECK(red(texture, {0.99, 0.99}) == Approx(40));
}

TEST_CASE("texture: coordinates outside [0, 1] repeat, mirror or stay at the edge") {
    Sampler sampler = kNearest;
    const std::vector<uint8_t> values{0, 50, 100, 150};
    const auto at = [&](Wrap wrap, double u) {
        sampler.wrapU = wrap;
        return red(grey(4, 1, values, sampler), {u, 0.5});
    };
    CHECK(at(Wrap::repeat, 1.1) == Approx(0));
    CHECK(at(Wrap::repeat, -0.1) == Approx(150));
    CHECK(at(Wrap::repeat, -1000.1) == Approx(150));
    CHECK(at(Wrap::mirroredRepeat, 1.1) == Approx(150));
    CHECK(at(Wrap::mirroredRepeat, 1.9) == Approx(0));
    CHECK(at(Wrap::mirroredRepeat, -0.3) == Approx(50));
    CHECK(at(Wrap::mirroredRepeat, 2.3) == Approx(50));
    CHECK(at(Wrap::clampToEdge, 77) == Approx(150));
    CHECK(at(Wrap::clampToEdge, -1e30) == Approx(0));
}

TEST_CASE("texture: linear filtering weighs four texels, over the edge as the wrap mode says") {
    Sampler sampler{.mipFilter = MipFilter::none};
    CHECK(red(grey(2, 2, {0, 100, 200, 40}, sampler), {0.5, 0.5}) == Approx(85));
    CHECK(red(grey(2, 1, {0, 100}, sampler), {0.35, 0.5}) == Approx(20));  // 0.2 texels right of the left centre
    CHECK(red(grey(2, 1, {0, 100}, sampler), {0, 0.5}) == Approx(50));
    sampler.wrapU = Wrap::clampToEdge;
    CHECK(red(grey(2, 1, {0, 100}, sampler), {0, 0.5}) == Approx(0));
    sampler.wrapU = Wrap::mirroredRepeat;
    CHECK(red(grey(2, 1, {0, 100}, sampler), {1, 0.5}) == Approx(100));
}

TEST_CASE("texture: sRGB texels are decoded before they are filtered") {
    Texels texels{.name = "", .width = 2, .height = 1, .rgba = {0, 0, 0, 0, 255, 255, 255, 255}};
    const SampledTexture texture(std::make_shared<std::vector<Texels>>(mipChain(texels, true)), {}, true);
    CHECK(texture.sample({0.5, 0.5}, dvec2(0), dvec2(0)).g == Approx(0.5));
    CHECK(texture.sample({0.5, 0.5}, dvec2(0), dvec2(0)).a == Approx(0.5));
}

TEST_CASE("texture: the level of detail is the logarithm of the longer difference in texels") {
    const auto texture = grey(8, 4, std::vector<uint8_t>(32), {});
    CHECK(texture.levelOfDetail({0.5, 0}, {0, 0.25}) == Approx(2));            // 4 texels and 1
    CHECK(texture.levelOfDetail({0.375, 1}, {0, 0}) == Approx(std::log2(5)));  // (3, 4) texels
    CHECK(texture.levelOfDetail({0, 0}, {0, 0}) == -std::numeric_limits<double>::infinity());
}

TEST_CASE("texture: mip filters read between levels, the nearest level or level 0 only") {
    // Level 0: 0 80 | 160 240. Level 1: 40 200. Level 2: 120.
    const std::vector<uint8_t> values{0, 80, 160, 240};
    const auto at = [&](MipFilter mipFilter, double texels) {
        Sampler sampler = kNearest;
        sampler.mipFilter = mipFilter;
        return grey(4, 1, values, sampler).sample({0.1, 0.5}, {texels / 4, 0}, dvec2(0)).r * 255;
    };
    CHECK(at(MipFilter::linear, 1) == Approx(0));
    CHECK(at(MipFilter::linear, 2) == Approx(40));
    CHECK(at(MipFilter::linear, std::sqrt(2)) == Approx(20));
    CHECK(at(MipFilter::linear, std::sqrt(8)) == Approx(80));
    CHECK(at(MipFilter::linear, 1e30) == Approx(120));
    CHECK(at(MipFilter::nearest, 1.41) == Approx(0));
    CHECK(at(MipFilter::nearest, 1.42) == Approx(40));
    CHECK(at(MipFilter::nearest, 1e30) == Approx(120));
    CHECK(at(MipFilter::none, 1e30) == Approx(0));
}

TEST_CASE("texture: the minification filter takes over where a pixel is larger than a texel") {
    const Sampler sampler{.magFilter = Filter::linear, .minFilter = Filter::nearest, .mipFilter = MipFilter::none};
    const auto texture = grey(2, 1, {0, 100}, sampler);
    CHECK(texture.sample({0.45, 0.5}, {0.5, 0}, dvec2(0)).r * 255 == Approx(40));
    CHECK(texture.sample({0.45, 0.5}, {0.51, 0}, dvec2(0)).r * 255 == Approx(0));
}
