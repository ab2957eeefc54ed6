#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "request.hpp"

namespace luciole::cli {
namespace {

using Json = nlohmann::ordered_json;

struct AdviseOptions {
    FrameRequest request;
    bool json = false;
};

/// Milliseconds by technique: the least of three frames, after one that may compile shaders.
using Measured = std::map<std::string, double>;

Measured measure(Renderer& renderer, const View& view, RenderSettings settings, const LightingAdvice& advice) {
    constexpr int kFrames = 3;
    Measured measured;
    for (const TechniqueAdvice& row : advice.techniques) {
        if (!row.whyNot.empty()) continue;
        settings.lighting = row.technique;
        renderer.render(view, settings);
        double& least = measured[row.technique];
        for (int i = 0; i < kFrames; ++i) {
            const double ms = renderer.render(view, settings).stats.wallMs;
            least = i == 0 ? ms : std::min(least, ms);
        }
    }
    return measured;
}

std::optional<double> measuredMs(const Measured& measured, const std::string& technique) {
    const auto found = measured.find(technique);
    return found == measured.end() ? std::nullopt : std::optional(found->second);
}

struct CountRow {
    std::string_view name;
    double SceneCounts::*count;
};
constexpr CountRow kCountRows[] = {
    {"pixels", &SceneCounts::pixels},           {"covered", &SceneCounts::covered},
    {"fragments", &SceneCounts::fragments},     {"blended", &SceneCounts::blended},
    {"triangles", &SceneCounts::triangles},     {"lights", &SceneCounts::lights},
    {"unbounded", &SceneCounts::unbounded},     {"meshBounded", &SceneCounts::meshBounded},
    {"visible", &SceneCounts::visible},         {"shapeTriangles", &SceneCounts::shapeTriangles},
    {"inRectangle", &SceneCounts::inRectangle}, {"behindNearest", &SceneCounts::behindNearest},
    {"onShape", &SceneCounts::onShape},         {"behindFront", &SceneCounts::behindFront},
    {"beforeBack", &SceneCounts::beforeBack},   {"behindFace", &SceneCounts::behindFace},
    {"reaching", &SceneCounts::reaching},       {"inTile", &SceneCounts::inTile},
    {"inCluster", &SceneCounts::inCluster},     {"surfaceBehindFront", &SceneCounts::surfaceBehindFront},
    {"blendedBehindFront", &SceneCounts::blendedBehindFront},
};

std::string adviceJson(const LightingAdvice& advice, const Measured& measured) {
    const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
    Json json{{"technique", advice.technique}, {"reason", advice.reason}, {"calibrationFrames", advice.calibrationFrames},
              {"calibrationMs", advice.calibrationMs}};
    for (const CountRow& row : kCountRows) json["counts"][std::string(row.name)] = advice.counts.*row.count;
    json["techniques"] = Json::array();
    for (const TechniqueAdvice& row : advice.techniques) {
        json["techniques"].push_back({{"name", row.technique}, {"predictedMs", number(row.predictedMs)}, {"whyNot", row.whyNot}});
        if (!measured.empty()) json["techniques"].back()["measuredMs"] = number(measuredMs(measured, row.technique));
    }
    return json.dump(2) + "\n";
}

std::string adviceText(const LightingAdvice& advice, const Measured& measured) {
    const auto number = [](const std::optional<double>& value) { return value ? fmt::format("{:.1f}", *value) : "-"; };
    std::string text = fmt::format("  {:<26} {:>12}{}\n", "technique", "predicted ms", measured.empty() ? "" : "  measured ms");
    for (const TechniqueAdvice& row : advice.techniques) {
        text += fmt::format("{} {:<26} {:>12}", row.technique == advice.technique ? "*" : " ", row.technique, number(row.predictedMs));
        if (!measured.empty()) text += fmt::format(" {:>12}", number(measuredMs(measured, row.technique)));
        text += row.whyNot.empty() ? "\n" : fmt::format("  not: {}\n", row.whyNot);
    }
    return text + advice.reason + "\n";
}

void run(const AdviseOptions& options) {
    RenderSettings settings = resolve(options.request.settings);
    const bool measures = settings.measure;
    settings.measure = false;  // which makes frames slower
    const auto [scene, view] = loadSceneAndView(options.request);
    Renderer renderer(rendererOptions(options.request));
    renderer.setScene(scene);
    const LightingAdvice advice = [&] {
        const ProgressLine progress(options.request.console, "counting and calibrating:");
        return renderer.advise(view, settings);
    }();
    options.request.console.detail(fmt::format("{} frames of calibration, {:.1f} s", advice.calibrationFrames, advice.calibrationMs / 1000));
    const Measured measured = measures ? measure(renderer, view, settings, advice) : Measured{};
    fmt::print("{}", options.json ? adviceJson(advice, measured) : adviceText(advice, measured));
}

}  // namespace

void addAdviseCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("advise", "say which lighting technique `--lighting auto` takes for a scene, and what the others would cost");
    const auto options = std::make_shared<AdviseOptions>();
    addSceneAndViewOptions(*command, options->request);
    addDeviceOptions(*command, options->request.renderer);
    command->add_flag("--json", options->json, "print JSON")->group("Messages");
    addConsoleOptions(*command, options->request.console);
    command->footer("With --measure the techniques are timed as well.\n"
                    "Example: luciole advise 'builtin:hall?lights=1000' --size 1920x1080 --measure\n");
    command->callback([options] { run(*options); });
}

}  // namespace luciole::cli
