// What `luciole render` writes. Pictures come from the reference, so that no device is needed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <luciole/output.hpp>
#include <luciole/renderer.hpp>
#include <luciole/scene_io.hpp>

#include "cli/run.hpp"
#include "io/temporary_folder.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

Run render(const std::string& scene, std::vector<std::string> more) {
    more.insert(more.begin(), {"render", scene, "--lighting", "reference"});
    const Run run = runLuciole(more);
    CAPTURE(run.err);
    CHECK(run.exitCode == 0);
    return run;
}

/// One white triangle that faces +Z, and a camera before it. Nothing lights it.
void writeDarkScene(const std::filesystem::path& file) {
    Scene scene;
    scene.meshes.push_back({.name = "triangle",
                            .vertices = {{.position = {-1, -1, 0}}, {.position = {1, -1, 0}}, {.position = {0, 1, 0}}},
                            .indices = {0, 1, 2}});
    scene.materials.push_back({.name = "white", .metallic = 0});
    scene.objects.push_back({.name = "triangle"});
    scene.cameras.push_back({.name = "front", .worldFromView = lookAt({0, 0, 3}, {0, 0, 0})});
    writeGlb(scene, file);
}

bool isBlack(const Image& image) {
    return std::all_of(image.data.begin(), image.data.end(), [](float value) { return value == 0; });
}

}  // namespace

TEST_CASE("cli: pictures have the size asked for, from one pixel on, in 8 and 16 bits") {
    const TemporaryFolder folder;
    for (const auto& [size, width, height] :
         {std::tuple("1x1", 1u, 1u), std::tuple("7x3", 7u, 3u), std::tuple("1x33", 1u, 33u)}) {
        const auto png = folder / "a.png", deep = folder / "deep.PNG";
        render("builtin:materials", {"-q", "--size", size, "-o", png});
        render("builtin:materials", {"-q", "--size", size, "-o", deep, "--bits", "16"});
        const Image image = readPng(png), fine = readPng(deep);
        CHECK(image.width == width);
        CHECK(image.height == height);
        CHECK(textOf(png)[24] == 8);  // bit depth in the header
        CHECK(textOf(deep)[24] == 16);
        REQUIRE(fine.data.size() == image.data.size());
        for (size_t i = 0; i < fine.data.size(); ++i)
            CHECK(std::abs(fine.data[i] - image.data[i]) < 0.51f / 255);  // both round to nearest
    }
}

TEST_CASE("cli: one run writes several pictures, and EXR holds the radiance and the layers asked for") {
    const TemporaryFolder folder;
    const std::string png = folder / "a.png", exr = folder / "a.exr";
    render("builtin:materials", {"-q", "--size", "8x6", "-o", png, "-o", exr, "--aov", "depth,normal", "--aov", "id",
                                 "--exr-type", "float", "--exposure", "2"});
    CHECK(readPng(png).width == 8);
    const auto layers = readExr(exr);
    CHECK(layers.size() == 4);
    CHECK(layers.at("").channels == 3);
    CHECK(layers.at("depth").channels == 1);
    CHECK(layers.at("normal").channels == 3);
    CHECK(layers.at("id").channels == 1);

    render("builtin:materials", {"-q", "--size", "8x6", "-o", exr, "--exr-type", "float"});
    CHECK(readExr(exr).at("").data == layers.at("").data);  // exposure belongs to the picture, not to radiance
}

TEST_CASE("cli: --view overlap writes the heat map to PNG, and to EXR the radiance and the exact counts") {
    const TemporaryFolder folder;
    const std::string scene = "builtin:fireflies?lights=50", png = folder / "a.png", exr = folder / "a.exr";
    const Run run = render(scene, {"--view", "overlap", "--size", "24x18", "-o", png, "-o", exr, "--json", "--stats"});
    const auto layers = readExr(exr);
    REQUIRE(layers.size() == 3);
    const Image &evaluations = layers.at("evaluations"), &useful = layers.at("useful-evaluations");
    CHECK(*std::max_element(useful.data.begin(), useful.data.end()) > 1);  // there is an overlap to show

    const Image map = readPng(png), expected = overlapHeatMap(evaluations, useful);
    REQUIRE(map.data.size() == expected.data.size());
    for (size_t i = 0; i < map.data.size(); ++i)
        CHECK(std::abs(map.data[i] - expected.data[i]) < 0.51f / 255);  // rounded to nearest

    const OverlapCounts sums = countOverlap(evaluations, useful);
    const auto counts = nlohmann::json::parse(run.out)["counts"];
    CHECK(counts["evaluations"] == sums.evaluations);
    CHECK(counts["usefulEvaluations"] == sums.usefulEvaluations);
    CHECK(counts["coveredPixels"] == sums.coveredPixels);
    CHECK(counts["draws"] == 0);  // the reference draws nothing
    CHECK(counts["stencilDraws"] == 0);
    CHECK(has(run.err, std::to_string(sums.evaluations) + " lights evaluated at"));

    // The same EXR layers by name, without the view.
    render(scene, {"-q", "--size", "24x18", "-o", exr, "--aov", "evaluations,useful-evaluations"});
    CHECK(readExr(exr).at("evaluations").data == evaluations.data);
    // A layer that is asked for by name too is there once, and --view picture is the default.
    render(scene, {"-q", "--view", "overlap", "--size", "24x18", "-o", exr, "--aov", "evaluations,depth"});
    CHECK(readExr(exr).size() == 4);
    render(scene, {"-q", "--view", "picture", "--size", "24x18", "-o", png});
    CHECK(readPng(png).width == 24);
}

TEST_CASE("cli: two runs give the same bytes") {
    const TemporaryFolder folder;
    for (const std::string name : {"a", "b"})
        render("builtin:fireflies?lights=50", {"-q", "--size", "24x18", "-o", folder / (name + ".png"), "-o",
                                               folder / (name + ".exr"), "--aov", "depth"});
    CHECK(textOf(folder / "a.png") == textOf(folder / "b.png"));
    CHECK(textOf(folder / "a.exr") == textOf(folder / "b.exr"));
}

TEST_CASE("cli: cameras go by name, index or auto, and --look-at and --fov change what is seen") {
    const TemporaryFolder folder;
    const std::string scene = folder / "scene.glb";
    writeDarkScene(scene);
    const auto depth = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"-q", "--size", "9x9", "--aov", "depth", "-o", folder / "a.exr"});
        render(scene, more);
        return readExr(folder / "a.exr").at("depth");
    };
    const Image first = depth({});
    CHECK(first.at(4, 4, 0) == doctest::Approx(3).epsilon(1e-6));
    CHECK(depth({"--camera", "front"}).data == first.data);
    CHECK(depth({"--camera", "0"}).data == first.data);
    CHECK(depth({"--camera", "auto"}).data != first.data);
    CHECK(depth({"--look-at", "0,0,5,0,0,0"}).at(4, 4, 0) == doctest::Approx(5).epsilon(1e-6));
    // A narrow view is filled by the triangle, a wide one is not.
    const auto hits = [](const Image& image) {
        return std::count_if(image.data.begin(), image.data.end(), [](float value) { return value > 0; });
    };
    CHECK(hits(depth({"--fov", "5"})) == 81);
    CHECK(hits(depth({"--fov", "120"})) < 20);
}

TEST_CASE("cli: a scene without light gets one and a note, unless --default-light off") {
    const TemporaryFolder folder;
    const std::string scene = folder / "scene.glb", png = folder / "a.png";
    writeDarkScene(scene);
    const Run lit = render(scene, {"--size", "9x9", "-o", png});
    CHECK(has(lit.err, "the scene has no light"));
    CHECK_FALSE(isBlack(readPng(png)));
    const Run dark = render(scene, {"--size", "9x9", "-o", png, "--default-light", "off"});
    CHECK_FALSE(has(dark.err, "no light"));
    CHECK(isBlack(readPng(png)));
    const Run own = render("builtin:materials", {"--size", "2x2", "-o", png});
    CHECK_FALSE(has(own.err, "no light"));
}

TEST_CASE("cli: a scene written as glTF renders to the same geometry") {
    const TemporaryFolder folder;
    const std::string glb = folder / "materials.glb";
    CHECK(runLuciole({"scene", "builtin:materials", "-o", glb, "-q"}).exitCode == 0);
    const auto depth = [&](const std::string& scene) {
        render(scene, {"-q", "--size", "16x12", "--aov", "depth", "-o", folder / "a.exr"});
        return readExr(folder / "a.exr").at("depth");
    };
    const Image expected = depth("builtin:materials"), written = depth(glb);
    for (size_t i = 0; i < expected.data.size(); ++i)
        CHECK(written.data[i] == doctest::Approx(expected.data[i]).epsilon(1e-4));  // matrices pass through text
}

TEST_CASE("cli: with a device, --view clusters writes the map of the lists to PNG, their layers to EXR, and --json and --stats count them") {
    const auto devices = listDevices();
    if (std::none_of(devices.begin(), devices.end(), [](const DeviceInfo& device) { return device.usable; })) {
        MESSAGE("skipped: no usable Vulkan device");
        return;
    }
    const TemporaryFolder folder;
    const std::string png = folder / "a.png", exr = folder / "a.exr";
    const Run run = runLuciole({"render", "builtin:hall?lights=50", "--size", "48x36", "--lighting", "clustered", "--tile-size", "8", "--view", "clusters", "-o", png, "-o",
                                exr, "--stats", "--json"});
    CAPTURE(run.err);
    REQUIRE(run.exitCode == 0);
    const auto layers = readExr(exr);
    REQUIRE(layers.size() == 3);
    const Image map = readPng(png), expected = lightListMap(layers.at("list-length"), layers.at("list-slice"), 8);
    REQUIRE(map.data.size() == expected.data.size());
    size_t wrong = 0;
    for (size_t i = 0; i < map.data.size(); ++i) wrong += std::abs(map.data[i] - expected.data[i]) >= 0.51f / 255;  // rounded to nearest
    CHECK(wrong == 0);
    const auto lists = nlohmann::json::parse(run.out)["lightLists"];
    CHECK(lists["tileSize"] == 8);
    CHECK(lists["lists"].get<uint64_t>() > 6 * 4);  // there are several slices
    CHECK(lists["longest"] == *std::ranges::max_element(layers.at("list-length").data));
    CHECK(lists["entries"].get<uint64_t>() > lists["longest"].get<uint64_t>());
    CHECK(lists["pages"] == 1);
    CHECK(lists["bytes"].get<uint64_t>() >= 4 * lists["entries"].get<uint64_t>());
    CHECK(has(run.err, "light lists: " + std::to_string(lists["entries"].get<uint64_t>()) + " entries in "));
}

TEST_CASE("cli: with a device, the default technique renders the picture and the graph") {
    const auto devices = listDevices();
    if (std::none_of(devices.begin(), devices.end(), [](const DeviceInfo& device) { return device.usable; })) {
        MESSAGE("skipped: no usable Vulkan device");
        return;
    }
    const TemporaryFolder folder;
    const std::string png = folder / "a.png", dot = folder / "a.dot";
    const Run run = runLuciole({"render", "builtin:materials", "--size", "64x48", "-o", png, "--dump-graph", dot,
                                "--stats", "--json", "--validation"});
    CAPTURE(run.err);
    CHECK(run.exitCode == 0);
    CHECK_FALSE(isBlack(readPng(png)));
    CHECK(has(textOf(dot), "digraph"));
    CHECK(has(run.err, "lights, "));
    CHECK_FALSE(has(run.err, "VUID"));
    CHECK_FALSE(has(run.err, "SYNC-HAZARD"));
    const auto passes = nlohmann::json::parse(run.out)["passes"];
    REQUIRE(passes.size() >= 4);
    for (const auto& pass : passes) {
        CHECK(pass["ms"].get<double>() > 0);
        CHECK(pass["bytes"].get<uint64_t>() > 0);
        CHECK(pass["stencilDraws"].get<uint64_t>() <= pass["draws"].get<uint64_t>());
    }
}
