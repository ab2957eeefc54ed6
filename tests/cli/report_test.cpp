// What the command line says: help, lists, statistics.
#include <doctest/doctest.h>

#include <luciole/renderer.hpp>
#include <luciole/scene_io.hpp>
#include <luciole/settings.hpp>
#include <nlohmann/json.hpp>

#include "cli/run.hpp"
#include "io/temporary_folder.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

std::string outputOf(const std::vector<std::string>& arguments) {
    const Run run = runLuciole(arguments);
    CAPTURE(run.err);
    CHECK(run.exitCode == 0);
    return run.out;
}

/// Statistics of a tiny picture.
nlohmann::json statistics(std::vector<std::string> more) {
    const TemporaryFolder folder;
    more.insert(more.begin(), {"render", "builtin:hall?lights=20", "--size", "4x3", "--json", "--lighting", "reference",
                               "-o", folder / "a.png"});
    return nlohmann::json::parse(outputOf(more));
}

}  // namespace

TEST_CASE("cli: help goes to standard output and shows the commands, examples, built-in scenes and exit codes") {
    const std::string help = outputOf({"--help"});
    for (const char* word : {"render", "info", "scene", "devices", "settings", "techniques", "bench"}) {
        CHECK(has(help, std::string("\n  ") + word + " "));
        CHECK(has(outputOf({word, "--help"}), std::string("luciole ") + word));
    }
    for (const BuiltinScene& scene : builtinScenes()) CHECK(has(help, "builtin:" + std::string(scene.name)));
    CHECK(has(help, "Examples"));
    CHECK(has(help, "Exit codes"));
}

TEST_CASE("cli: render's help offers every setting, once") {
    const std::string help = outputOf({"render", "--help"});
    for (const Setting& setting : settingsTable()) {
        const std::string option = "  --" + std::string(setting.name) + " ";
        const size_t at = help.find(option);
        REQUIRE(at != std::string::npos);
        CHECK(help.find(option, at + 1) == std::string::npos);
    }
}

TEST_CASE("cli: the version is one line") { CHECK(has(outputOf({"--version"}), "luciole 0.")); }

TEST_CASE("cli: docs/settings.md is what `luciole settings --markdown` prints") {
    CHECK(textOf(std::filesystem::path(LUCIOLE_SOURCE_DIR) / "docs/settings.md") ==
          outputOf({"settings", "--markdown"}));
}

TEST_CASE("cli: settings and techniques are listed by name") {
    const std::string settings = outputOf({"settings"}), techniques = outputOf({"techniques"});
    for (const Setting& setting : settingsTable()) CHECK(has(settings, setting.name));
    for (const auto& technique : lightingTechniques()) CHECK(has(techniques, technique.name));
}

TEST_CASE("cli: bench measures the technique that is named beside the bound, with the settings that are given") {
    const std::string bench = outputOf({"bench", "builtin:hall?lights=20&triangles=2000", "--size", "24x18", "--frames", "1",
                                        "--lighting", "clustered", "--tile-size", "8"});
    CHECK(has(bench, "20 lights, "));
    CHECK(has(bench, ", 24x18; "));
    CHECK(has(bench, "\n| clustered | "));
    CHECK(has(bench, "\n| ideal | "));
    CHECK_FALSE(has(bench, "brute-force"));
    CHECK(has(bench, " | 0 |\n"));  // no light missed
}

TEST_CASE("cli: bench without a name measures the techniques with lists of lights") {
    const std::string bench = outputOf({"bench", "builtin:hall?lights=20&triangles=2000", "--size", "24x18", "--frames", "1"});
    for (const char* name : {"tiled", "tiled-points", "clustered", "clustered-forward", "ideal"})
        CHECK(has(bench, std::string("\n| ") + name + " | "));
}

TEST_CASE("cli: devices are listed with what they are, as JSON too") {
    const auto json = nlohmann::json::parse(outputOf({"devices", "--json"}));
    const auto devices = listDevices();
    REQUIRE(json.size() == devices.size());
    for (size_t i = 0; i < devices.size(); ++i) {
        CHECK(json[i]["name"] == devices[i].name);
        CHECK(json[i]["usable"] == devices[i].usable);
        CHECK(has(outputOf({"devices"}), devices[i].name));
    }
}

TEST_CASE("cli: info counts what a built-in scene holds") {
    for (const BuiltinScene& builtin : builtinScenes()) {
        const std::string uri = "builtin:" + std::string(builtin.name);
        const Scene scene = loadScene(uri);
        const auto json = nlohmann::json::parse(outputOf({"info", uri, "--json"}));
        CHECK(json["triangles"] == triangleCount(scene));
        CHECK(json["lights"]["total"] == scene.lights.size());
        CHECK(json["cameras"].size() == scene.cameras.size());
        CHECK(json["materials"].size() == scene.materials.size());
        CHECK(json["bounds"]["high"][1].get<float>() == doctest::Approx(boundsOf(scene).high.y));
        CHECK(has(outputOf({"info", uri}), std::to_string(triangleCount(scene))));
    }
}

TEST_CASE("cli: --json prints statistics, and nothing else, on standard output") {
    const auto json = statistics({});
    CHECK(json["width"] == 4);
    CHECK(json["height"] == 3);
    CHECK(json["lights"] == 20);
    CHECK(json["triangles"] == triangleCount(loadScene("builtin:hall?lights=20")));
    for (const char* key : {"device", "driver", "wallMs", "peakBytes", "passes", "settings"})
        CHECK(json.contains(key));
    CHECK_FALSE(json.contains("counts"));  // only where they are shown
}

TEST_CASE("cli: the command line wins over the settings file, and the file over the defaults") {
    const TemporaryFolder folder;
    const std::string file = folder / "settings.json";
    writeText(file, R"({"tonemap": "agx", "exposure": 2, "depth-prepass": true, "light-buffer": "rgba16f"})");
    const auto settings = statistics({"--settings", file, "--exposure", "-0.5", "--depth-prepass=off"})["settings"];
    CHECK(settings["tonemap"] == "agx");
    CHECK(settings["exposure"] == "-0.5");
    CHECK(settings["depth-prepass"] == "off");
    CHECK(settings["light-buffer"] == "rgba16f");
    CHECK(settings["measure"] == "on");  // --json implies it
    CHECK(settings["gbuffer"] == "compact");
}

TEST_CASE("cli: a switch takes no word after it, so the scene may follow") {
    const TemporaryFolder folder;
    const Run run = runLuciole({"render", "--depth-prepass", "builtin:materials", "--size", "1x1", "--lighting", "reference",
                                "--json", "-o", folder / "a.png"});
    CHECK(nlohmann::json::parse(run.out)["settings"]["depth-prepass"] == "on");
}

TEST_CASE("cli: --stats prints its table on standard error, -q prints nothing") {
    const TemporaryFolder folder;
    const std::vector<std::string> render{"render",     "builtin:materials", "--size", "2x2",
                                          "--lighting", "reference",         "-o",     folder / "a.png"};
    auto with = [&](const char* option) {
        auto arguments = render;
        arguments.emplace_back(option);
        return runLuciole(arguments);
    };
    CHECK(has(with("--stats").err, "triangles"));
    CHECK(with("--stats").out.empty());
    CHECK(with("-q").err.empty());
    CHECK(with("-q").out.empty());
    CHECK(has(with("-v").err, "scene loaded"));
}
