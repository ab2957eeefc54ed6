// What the command line says: help, lists, statistics.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <luciole/renderer.hpp>
#include <luciole/scene_io.hpp>
#include <luciole/settings.hpp>
#include <nlohmann/json.hpp>
#include <report_template.hpp>

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
    for (const char* word : {"render", "info", "scene", "devices", "settings", "techniques", "bench", "graph"}) {
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
    CHECK(has(bench, "## builtin:hall?lights=20&triangles=2000, 24x18"));
    CHECK(has(bench, "20 lights, "));
    CHECK(has(bench, "\n| clustered | "));
    CHECK(has(bench, "\n| ideal     | "));
    CHECK_FALSE(has(bench, "brute-force"));
    CHECK(has(bench, "Fastest: clustered.\n"));
    CHECK(has(bench, listDevices().at(0).name));
    CHECK(has(bench, ", commit "));
}

TEST_CASE("cli: bench without a name measures the techniques with lists of lights") {
    const std::string bench = outputOf({"bench", "builtin:hall?lights=20&triangles=2000", "--size", "24x18", "--frames", "1"});
    for (const char* name : {"tiled", "tiled-points", "clustered", "clustered-forward", "ideal"})
        CHECK(has(bench, std::string("\n| ") + name + " "));
}

TEST_CASE("cli: bench --passes tells each pass by timestamps and by ablation") {
    const std::vector<std::string> bench{"bench", "builtin:hall?lights=20&triangles=2000", "--size", "24x18", "--frames", "2", "--lighting", "clustered", "--passes"};
    const std::string text = outputOf(bench);
    CHECK(has(text, "| by timestamps, ms | by ablation, ms |"));
    CHECK(has(text, "| clustered: lighting.clustered "));
    std::vector<std::string> asJson = bench;
    asJson.push_back("--json");
    for (const auto& pass : nlohmann::json::parse(outputOf(asJson))["cells"][0]["results"][0]["passes"]) CHECK(pass["ablatedMs"]["median"].is_number());
}

TEST_CASE("cli: bench measures all combinations of a sweep, and tells them in JSON and CSV alike") {
    const TemporaryFolder folder;
    const std::string csv = (folder.path() / "b.csv").string(), markdown = (folder.path() / "b.md").string();
    const auto json = nlohmann::json::parse(outputOf({"bench", "builtin:hall?triangles=2000", "builtin:materials", "--sweep", "size=24x18,8x8", "--sweep",
                                                      "msaa=1,4", "--lighting", "tiled,clustered-forward", "--frames", "2", "--most-frames", "2", "--json", "-o",
                                                      csv, "-o", markdown}));
    CHECK(json["schema"] == 1);
    CHECK(json["machine"]["device"] == listDevices().at(0).name);
    CHECK(json["machine"]["threads"] > 0);
    CHECK_FALSE(json["commit"].get<std::string>().empty());
    REQUIRE(json["cells"].size() == 8);
    size_t rows = 0;
    for (const auto& cell : json["cells"]) {
        const bool samples = cell["at"]["msaa"] == "4";
        CHECK(cell["settings"]["msaa"] == cell["at"]["msaa"]);
        CHECK(cell["at"]["size"] == fmt::format("{}x{}", cell["width"].get<int>(), cell["height"].get<int>()));
        CHECK(cell["results"].size() == (samples ? 1u : 3u));  // `ideal` and deferred techniques have one sample
        CHECK(cell["refused"].size() == (samples ? 1u : 0u));
        rows += cell["results"].size();
        for (const auto& result : cell["results"]) {
            const auto& wall = result["wallMs"];
            CHECK(result["frames"] == 2);
            CHECK(wall["least"] <= wall["low"]);
            CHECK(wall["low"] <= wall["median"]);
            CHECK(wall["median"] <= wall["high"]);
            CHECK(wall["high"] <= wall["p95"]);
            CHECK(result["missedPairs"] == (samples ? nlohmann::json() : nlohmann::json(0.0)));
            CHECK(result["usefulEvaluations"] <= result["evaluations"]);
            double passes = 0;
            CHECK_FALSE(result["passes"][0].contains("ablatedMs"));
            for (const auto& pass : result["passes"]) passes += pass["ms"]["median"].get<double>();
            CHECK(passes == doctest::Approx(result["passesMs"]["median"].get<double>()));
        }
    }
    const std::string table = textOf(csv);
    CHECK(size_t(std::ranges::count(table, '\n')) == rows + 1);
    CHECK(has(table, "at_size,at_msaa,technique,frames,median_ms"));
    CHECK(has(textOf(markdown), "## All frames: medians, ms"));
}

TEST_CASE("cli: bench measures all techniques that can do with the settings, and says why others can't") {
    const auto json = nlohmann::json::parse(
        outputOf({"bench", "builtin:hall?lights=20&triangles=2000", "--size", "24x18", "--frames", "1", "--lighting", "all", "--msaa", "4", "--json"}));
    const auto& cell = json["cells"][0];
    CHECK(cell["results"].size() + cell["refused"].size() + 2 == lightingTechniques().size());  // auto and reference are none of them
    for (const auto& refused : cell["refused"]) CHECK(has(refused["why"].get<std::string>(), "msaa: expected 1"));
    CHECK(cell["refused"].size() > 0);
    CHECK(cell["results"].size() > 2);
}

TEST_CASE("cli: bench sets what was published beside what it measures") {
    const auto json = nlohmann::json::parse(outputOf({"bench", "--reproduce", "trebilco", "--size", "24x18", "--frames", "2", "--most-frames", "2", "--json"}));
    const auto& ratios = json["reproduction"]["ratios"];
    REQUIRE(ratios.size() == 3);
    const char* published[] = {"6.8", "5.2", "3.1"};
    for (size_t i = 0; i < 3; ++i) {
        CHECK(ratios[i]["published"] == published[i]);
        CHECK(ratios[i]["low"] <= ratios[i]["measured"]);
        CHECK(ratios[i]["measured"] <= ratios[i]["high"]);
        CHECK(ratios[i]["low"] > 0);
    }
    for (const char* name : {"olsson", "mjp"}) {
        const std::string text = outputOf({"bench", "--reproduce", name, "--size", "16x12", "--frames", "1"});
        CHECK(has(text, listDevices().at(0).name));
        CHECK(has(text, " published | "));
    }
}

TEST_CASE("cli: compare writes one page about all techniques on a scene") {
    if (reportTemplate().empty()) {
        MESSAGE("skipped: built without Node.js, or without the packages of apps/report");
        return;
    }
    const TemporaryFolder folder;
    const std::string file = folder / "report.html";
    outputOf({"compare", "builtin:hall?triangles=2000", "--size", "24x18", "--sweep", "lights=3,20", "-o", file});
    const std::string page = textOf(file);
    CHECK(page.starts_with("<!DOCTYPE html>"));
    CHECK_FALSE(has(page, "@LUCIOLE_REPORT@"));
    const std::string_view begin = "id=\"report-data\">";
    const size_t from = page.find(begin) + begin.size();
    const auto json = nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
    CHECK(json["title"] == "builtin:hall?triangles=2000");
    CHECK(json["techniques"].size() + json["left"].size() + 2 == lightingTechniques().size());  // auto and reference are none of them
    REQUIRE(json["images"].size() == json["techniques"].size() + 1);
    CHECK(json["images"][0]["name"] == "reference");
    for (const auto& technique : json["techniques"]) {
        CAPTURE(technique["name"].get<std::string>());
        CHECK(technique["metrics"]["meanError"].get<double>() < 5);
        CHECK(technique["metrics"]["ssim"].get<double>() > 0.98);
        CHECK(technique["wallMs"]["low"] <= technique["wallMs"]["high"]);
        CHECK(technique["passes"].size() > 2);
        CHECK(has(technique["overlap"].get<std::string>(), "data:image/png;base64,"));
    }
    CHECK(json["sweep"]["values"] == nlohmann::json({3, 20}));
    CHECK(json["sweep"]["series"].size() == json["techniques"].size());
}

TEST_CASE("cli: graph draws the passes with their times, and what they read and write") {
    const TemporaryFolder folder;
    const std::string dot = folder / "frame.dot";
    outputOf({"graph", "builtin:hall?lights=20&triangles=2000", "--size", "24x18", "--lighting", "clustered", "-o", dot});
    const std::string text = textOf(dot);
    CHECK(text.starts_with("digraph frame {"));
    for (const char* part : {"geometry.gbuffer\\n", " ms\"", "lighting.clustered.fill", "light-lists.entries", " MiB\"", "24x18"}) CHECK(has(text, part));
    if (std::system("dot -V 2>/dev/null") != 0) {
        MESSAGE("skipped: Graphviz's program dot is not here");
        return;
    }
    const std::string svg = folder / "frame.svg";
    outputOf({"graph", "builtin:hall?lights=20&triangles=2000", "--size", "24x18", "--lighting", "clustered", "-o", svg});
    CHECK(has(textOf(svg), "<svg"));
    CHECK(has(textOf(svg), "lighting.clustered.fill"));
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
