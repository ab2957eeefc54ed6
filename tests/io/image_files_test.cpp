#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <luciole/error.hpp>
#include <luciole/output.hpp>

#include "io/file.hpp"
#include "io/temporary_folder.hpp"

using namespace luciole;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Every sample another multiple of 1 / steps, so that it survives that many levels exactly.
Image ramp(uint32_t width, uint32_t height, uint32_t channels, uint32_t steps) {
    Image image(width, height, channels);
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = float(i * 7919 % (steps + 1)) / float(steps);
    return image;
}

void checkSame(const Image& image, const Image& expected) {
    CHECK(image.width == expected.width);
    CHECK(image.height == expected.height);
    CHECK(image.channels == expected.channels);
    CHECK(image.data == expected.data);
}

Image one(float value) {
    Image image(1, 1, 1);
    image.data = {value};
    return image;
}

}  // namespace

TEST_CASE("png: pictures of 8 and 16 bits survive writing and reading") {
    const test::TemporaryFolder folder;
    for (const uint32_t channels : {3u, 4u}) {
        const Image eight = ramp(13, 7, channels, 255);
        writePng(folder / "8.png", eight, 8);
        checkSame(readPng(folder / "8.png"), eight);
        const Image sixteen = ramp(13, 7, channels, 65535);
        writePng(folder / "16.png", sixteen, 16);
        checkSame(readPng(folder / "16.png"), sixteen);
    }
}

TEST_CASE("png: a grey picture reads as three equal channels") {
    const test::TemporaryFolder folder;
    const Image grey = ramp(5, 3, 1, 255);
    writePng(folder / "grey.png", grey);
    const Image read = readPng(folder / "grey.png");
    REQUIRE(read.channels == 3);
    for (size_t i = 0; i < read.data.size(); ++i) CHECK(read.data[i] == grey.data[i / 3]);
}

TEST_CASE("png: values round to the nearest level; those outside [0, 1] and NaN are clamped") {
    const test::TemporaryFolder folder;
    const auto stored = [&](float value) {
        writePng(folder / "one.png", one(value));
        return std::lround(255 * readPng(folder / "one.png").data[0]);
    };
    CHECK(stored(99.4f / 255) == 99);
    CHECK(stored(99.6f / 255) == 100);
    CHECK(stored(-1) == 0);
    CHECK(stored(2) == 255);
    CHECK(stored(kInfinity) == 255);
    CHECK(stored(kNaN) == 0);
}

TEST_CASE("png: bits, channels and sizes that PNG does not have are refused, and nothing is written") {
    const test::TemporaryFolder folder;
    CHECK_THROWS_AS(writePng(folder / "a.png", Image(2, 2, 3), 10), Error);
    CHECK_THROWS_AS(writePng(folder / "a.png", Image(2, 2, 2)), Error);
    CHECK_THROWS_AS(writePng(folder / "a.png", Image(0, 2, 3)), Error);
    CHECK(folder.count() == 0);
}

TEST_CASE("png and exr: a broken file is an error that names it") {
    const test::TemporaryFolder folder;
    const auto file = folder / "broken";
    for (const std::string_view text : {"", "no picture", "\x89PNG\r\n\x1a\n", "\x76\x2f\x31\x01\x02"}) {
        writeFileAtomically(file, std::as_bytes(std::span(text)));
        for (const bool png : {true, false}) {
            std::string message;
            try {
                png ? void(readPng(file)) : void(readExr(file));
            } catch (const Error& error) {
                message = error.what();
                CHECK(error.kind() == ErrorKind::io);
            }
            CHECK(message.starts_with(file.string() + ": can't read: "));
        }
    }
}

TEST_CASE("exr: layers of one, three and four channels survive as 32-bit floats") {
    const test::TemporaryFolder folder;
    std::map<std::string, Image> layers{
        {"", ramp(9, 5, 3, 1000)}, {"depth", ramp(9, 5, 1, 77)}, {"cs0", ramp(9, 5, 4, 3)}};
    layers[""].data[0] = -kInfinity;
    layers[""].data[1] = 1e30f;
    writeExr(folder / "a.exr", layers, ExrType::float32);
    const auto read = readExr(folder / "a.exr");
    REQUIRE(read.size() == layers.size());
    for (const auto& [name, image] : layers) checkSame(read.at(name), image);
}

TEST_CASE("exr: half rounds to 11 bits and stays finite; layers of counts and indices stay exact") {
    const test::TemporaryFolder folder;
    const float exact = 70001;  // beyond half's range, and needs 17 bits
    std::map<std::string, Image> layers{{"", Image(3, 1, 3)}};
    layers[""].data = {0.1f, 1e6f, -1e6f, kInfinity, 1, 0, 0.5f, 2048, 6e-8f};
    for (const char* name : {"depth", "material", "id", "light-count"}) {
        layers[name] = Image(3, 1, 1);
        layers[name].data = {exact, -1, 0};
    }
    writeExr(folder / "a.exr", layers, ExrType::half);
    const auto read = readExr(folder / "a.exr");
    const auto& color = read.at("").data;
    CHECK(color[0] == doctest::Approx(0.1f).epsilon(1.0 / 2048));  // half an ulp
    CHECK(color[0] != 0.1f);
    CHECK(color[1] == 65504);
    CHECK(color[2] == -65504);
    CHECK(color[3] == kInfinity);
    CHECK(color[7] == 2048);
    for (const char* name : {"depth", "material", "id", "light-count"}) checkSame(read.at(name), layers[name]);
}

TEST_CASE("exr: no layers, odd channel counts and differing sizes are refused, and nothing is written") {
    const test::TemporaryFolder folder;
    CHECK_THROWS_AS(writeExr(folder / "a.exr", {}), Error);
    CHECK_THROWS_AS(writeExr(folder / "a.exr", {{"", Image(2, 2, 2)}}), Error);
    CHECK_THROWS_AS(writeExr(folder / "a.exr", {{"", Image(0, 0, 3)}}), Error);
    CHECK_THROWS_AS(writeExr(folder / "a.exr", {{"", Image(2, 2, 3)}, {"depth", Image(2, 3, 1)}}), Error);
    CHECK(folder.count() == 0);
}

TEST_CASE("png and exr: the same picture gives the same bytes") {
    const test::TemporaryFolder folder;
    const Image image = ramp(33, 17, 3, 255);
    for (const char* name : {"a", "b"}) {
        writePng(folder / (std::string(name) + ".png"), image);
        writeExr(folder / (std::string(name) + ".exr"), {{"", image}, {"normal", image}});
    }
    CHECK(readFile(folder / "a.png", 1 << 20) == readFile(folder / "b.png", 1 << 20));
    CHECK(readFile(folder / "a.exr", 1 << 20) == readFile(folder / "b.exr", 1 << 20));
}
