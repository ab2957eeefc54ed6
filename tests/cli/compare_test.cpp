// `luciole compare` of two pictures: results, limits and every exit code.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <luciole/error.hpp>
#include <luciole/output.hpp>
#include <nlohmann/json.hpp>

#include "cli/run.hpp"
#include "io/temporary_folder.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

constexpr int kSame = 0, kDiffers = 1;

Run compare(const std::string& a, const std::string& b, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"compare", a, b});
    return runLuciole(more);
}

nlohmann::json jsonOf(const Run& run) {
    CAPTURE(run.err);
    REQUIRE(run.exitCode <= kDiffers);
    return nlohmann::json::parse(run.out);
}

/// A failure as it has to look: its exit code, nothing on stdout, one line on stderr.
std::string failure(ErrorKind kind, const Run& run) {
    CHECK(run.exitCode == int(kind));
    CHECK(run.out.empty());
    CHECK(run.err.starts_with("luciole: error: "));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    return run.err;
}

Image even(uint32_t width, uint32_t height, uint32_t channels, float value) {
    Image image(width, height, channels);
    std::ranges::fill(image.data, value);
    return image;
}

std::string exrOf(const TemporaryFolder& folder, const std::string& name, const Image& image) {
    writeExr(folder / name, {{"", image}}, ExrType::float32);
    return folder / name;
}

std::string pngOf(const TemporaryFolder& folder, const std::string& name, const Image& image) {
    writePng(folder / name, image);
    return folder / name;
}

}  // namespace

TEST_CASE("cli: compare ends with 0 for pictures that are identical and with 1 for others, from one pixel on") {
    const TemporaryFolder folder;
    for (const auto& [width, height] : {std::pair(1u, 1u), std::pair(20u, 13u)}) {
        Image image = even(width, height, 3, 0.5f);
        const std::string exr = exrOf(folder, "a.exr", image), sameExr = exrOf(folder, "b.EXR", image);
        const std::string png = pngOf(folder, "a.png", image), samePng = pngOf(folder, "b.PNG", image);
        image.at(0, 0, 1) = 0.75f;
        const std::string otherExr = exrOf(folder, "c.exr", image), otherPng = pngOf(folder, "c.png", image);
        for (const auto& [a, same, other] : {std::tuple(exr, sameExr, otherExr), std::tuple(png, samePng, otherPng)}) {
            const Run equal = compare(a, same), differs = compare(a, other);
            CHECK(equal.exitCode == kSame);
            CHECK(has(equal.out, "\nidentical\n"));
            CHECK(equal.err.empty());
            CHECK(differs.exitCode == kDiffers);
            CHECK(has(differs.out, "\ndifferent\n"));
            CHECK(differs.err.empty());
        }
    }
}

TEST_CASE("cli: compare's JSON holds the errors; what is infinite or was not compared is null") {
    const TemporaryFolder folder;
    const std::string a = exrOf(folder, "a.exr", even(16, 12, 3, 1)), b = exrOf(folder, "b.exr", even(16, 12, 3, 1.5f));
    const auto json = jsonOf(compare(a, b, {"--json", "--max-error", "50"}));
    CHECK(json["width"] == 16);
    CHECK(json["height"] == 12);
    CHECK(json["identical"] == false);
    CHECK(json["passes"] == true);
    CHECK(json["maxErrorPercent"].get<double>() == doctest::Approx(100 * 0.5 / 1.01));
    CHECK(json["meanErrorPercent"].get<double>() == doctest::Approx(100 * 0.5 / 1.01));
    CHECK(json["psnrDb"].is_null());  // both are white at no exposure
    CHECK(json["ssim"] == 1);
    CHECK(json["flipMean"].get<double>() > 0);
    CHECK(json["notFinite"]["pixels"] == 0);
    CHECK(json["limits"]["maxErrorPercent"] == 50);
    CHECK(jsonOf(compare(a, b, {"--json", "--exposure", "-2"}))["psnrDb"].get<double>() > 0);
}

TEST_CASE("cli: compare's limits decide, all of them, and the text names those that are exceeded") {
    const TemporaryFolder folder;
    // A tenth off: 20 dB.
    const std::string a = pngOf(folder, "a.png", even(16, 16, 3, 102 / 255.0f)), b = pngOf(folder, "b.png", even(16, 16, 3, 127.5f / 255.0f));
    const auto json = jsonOf(compare(a, b, {"--json"}));
    const struct {
        std::string option, key;
        bool atLeast;
    } rows[] = {{"--max-error", "maxErrorPercent", false}, {"--p999-error", "p999ErrorPercent", false}, {"--mean-error", "meanErrorPercent", false},
                {"--psnr", "psnrDb", true},                {"--ssim", "ssim", true},                    {"--flip", "flipMean", false}};
    for (const auto& row : rows) {
        CAPTURE(row.option);
        const auto value = json[row.key].get<double>();
        const std::string wider = std::to_string(value * (row.atLeast ? 0.9 : 1.1)), narrower = std::to_string(value * (row.atLeast ? 1.001 : 0.9));
        const Run within = compare(a, b, {row.option, wider});
        CHECK(within.exitCode == kSame);
        CHECK(has(within.out, "\nwithin the limits\n"));
        const Run beyond = compare(a, b, {row.option, narrower, "--max-error", "1000"});
        const bool last = row.option == "--max-error";  // given twice, so refused
        CHECK(beyond.exitCode == (last ? int(ErrorKind::usage) : kDiffers));
        if (!last) CHECK(has(beyond.out, "\ndifferent: beyond " + row.option + "\n"));
        if (!last) CHECK(compare(a, a, {row.option, narrower}).exitCode == kSame);
    }
    CHECK(compare(a, b, {"--max-error", "1"}).exitCode == kDiffers);
}

TEST_CASE("cli: compare never lets a NaN or an infinity pass, and says how many pixels and where the first is") {
    const TemporaryFolder folder;
    Image bad = even(9, 5, 3, 1);
    bad.at(4, 3, 1) = std::numeric_limits<float>::quiet_NaN();
    bad.at(7, 4, 0) = std::numeric_limits<float>::infinity();
    const std::string good = exrOf(folder, "good.exr", even(9, 5, 3, 1)), evil = exrOf(folder, "evil.exr", bad);
    for (const auto& [a, b] : {std::pair(good, evil), std::pair(evil, good), std::pair(evil, evil)}) {
        const Run run = compare(a, b, {"--max-error", "1e9", "--psnr", "0"});
        CHECK(run.exitCode == kDiffers);
        CHECK(has(run.out, "2 pixels are NaN or infinite in one of the pictures, the first at x = 4, y = 3"));
    }
    const Run run = compare(good, evil, {"--json", "-o", folder / "map.png"});
    const auto json = jsonOf(run);
    CHECK(run.exitCode == kDiffers);
    CHECK(json["passes"] == false);
    CHECK(json["notFinite"]["pixels"] == 2);
    CHECK(json["notFinite"]["first"] == nlohmann::json{4, 3});
    CHECK(json["maxErrorPercent"] == 0);  // of the other pixels
    CHECK(json["ssim"].is_null());
    CHECK(readPng(folder / "map.png").width > 0);
}

TEST_CASE("cli: compare takes a layer of EXR, as numbers") {
    const TemporaryFolder folder;
    const std::string a = folder / "a.exr", b = folder / "b.exr";
    writeExr(a, {{"", even(4, 4, 3, 1)}, {"depth", even(4, 4, 1, 10)}});
    writeExr(b, {{"", even(4, 4, 3, 2)}, {"depth", even(4, 4, 1, 10)}});
    CHECK(compare(a, b).exitCode == kDiffers);
    const Run depth = compare(a, b, {"--layer", "depth"});
    CHECK(depth.exitCode == kSame);
    CHECK(has(depth.out, "layer depth"));
    CHECK(has(failure(ErrorKind::usage, compare(a, b, {"--layer", "normal"})), "a.exr: expected layer normal, got the picture, depth"));
    CHECK(has(failure(ErrorKind::usage, compare(a, b, {"--layer", "depth", "--flip", "0.1"})), "--flip: expected pictures with R, G and B"));
    const std::string png = pngOf(folder, "a.png", even(4, 4, 3, 1));
    CHECK(has(failure(ErrorKind::usage, compare(png, png, {"--layer", "depth"})), "--layer: PNG has no layers"));
    writeExr(b, {{"depth", even(4, 4, 1, 10)}});
    CHECK(has(failure(ErrorKind::usage, compare(a, b)), "b.exr: expected channels R, G, B, got depth"));
}

TEST_CASE("cli: compare writes the errors as heat maps, whatever the outcome") {
    const TemporaryFolder folder;
    const std::string a = pngOf(folder, "a.png", even(300, 20, 3, 0.5f)), b = pngOf(folder, "b.png", even(300, 20, 3, 0.6f));
    const std::string map = folder / "map.png";
    for (const std::string& other : {a, b}) {
        compare(a, other, {"-o", map});
        CHECK(readPng(map).width == 604);
        CHECK(readPng(map).height > 20);
    }
}

TEST_CASE("cli: compare refuses with 2 what does not go together, and the message gives both") {
    const TemporaryFolder folder;
    const std::string a = pngOf(folder, "a.png", even(4, 3, 3, 0.5f)), exr = exrOf(folder, "a.exr", even(4, 3, 3, 0.5f));
    const auto refused = [&](const std::string& b, const std::vector<std::string>& more = {}) { return failure(ErrorKind::usage, compare(a, b, more)); };
    CHECK(has(refused(pngOf(folder, "turned.png", even(3, 4, 3, 0.5f))), "turned.png: expected 4x3 with 3 channels, as "));
    CHECK(has(refused(pngOf(folder, "turned.png", even(3, 4, 3, 0.5f))), "got 3x4 with 3 channels"));
    CHECK(has(refused(pngOf(folder, "alpha.png", even(4, 3, 4, 0.5f))), "got 4x3 with 4 channels"));
    CHECK(has(refused(exr), "expected two .exr or two .png"));
    CHECK(has(refused(folder / "a.jpg"), "a.jpg: expected a name that ends in .png or .exr"));
    CHECK(has(refused(a, {"-o", folder / "map.exr"}), "map.exr: expected a name that ends in .png"));
    CHECK(has(refused(pngOf(folder, "b.png", even(4, 3, 3, 0.5f)), {"-o", a}), "-o: expected another file than those that are read, got "));
    CHECK(has(refused(a, {"--psnr", "-1"}), "--psnr: expected a number from 0"));
    CHECK(has(refused(a, {"--ssim", "1.5"}), "--ssim: expected a number from -1 to 1, got \"1.5\""));
    CHECK(has(refused(a, {"--flip", "nan"}), "--flip: expected a number"));
    CHECK(has(refused(a, {"--max-error", "much"}), "--max-error: expected a number"));
    CHECK(has(refused(a, {a}), "compare"));
    failure(ErrorKind::usage, runLuciole({"compare"}));
    failure(ErrorKind::usage, runLuciole({"compare", a}));
    CHECK_FALSE(std::filesystem::exists(folder / "map.exr"));
}

TEST_CASE("cli: compare ends with 4 where a picture can't be read or the map can't be written") {
    const TemporaryFolder folder;
    Image image(64, 64, 3);  // what is even would be whole before its file ends
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = float(i * 7919 % 256) / 255;
    const std::string a = exrOf(folder, "a.exr", image), png = pngOf(folder, "a.png", image);
    const auto unreadable = [](const std::string& x, const std::string& y) { return failure(ErrorKind::io, compare(x, y)); };
    CHECK(has(unreadable(a, folder / "none.exr"), "none.exr: can't read: No such file"));
    CHECK(has(unreadable(folder / "none.png", png), "none.png: can't read: No such file"));
    std::filesystem::create_directory(folder / "folder.exr");
    CHECK(has(unreadable(a, folder / "folder.exr"), "folder.exr: can't read: Is a directory"));
    for (const std::string ending : {".exr", ".png"}) {
        const std::string whole = ending == ".exr" ? a : png, cut = folder / ("cut" + ending);
        for (const double share : {0.0, 0.1, 0.5, 0.9}) {
            const std::string bytes = textOf(whole);
            writeText(cut, std::string_view(bytes).substr(0, size_t(share * double(bytes.size()))));
            CHECK(has(unreadable(whole, cut), "cut" + ending + ": can't read"));
            unreadable(cut, whole);
        }
    }
    CHECK(has(failure(ErrorKind::io, compare(a, a, {"-o", folder / "none/map.png"})), "none/map.png: can't write: No such file"));
    std::filesystem::create_directory(folder / "map.png");
    CHECK(has(failure(ErrorKind::io, compare(a, folder / "none.exr", {"-o", folder / "map.png"})), "map.png: can't write: Is a directory"));
}
