#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <luciole/error.hpp>
#include <luciole/renderer.hpp>
#include <measure.hpp>
#include <memory>

#include "commands.hpp"
#include "options.hpp"
#include "view.hpp"

namespace luciole::cli {
namespace {

struct BenchOptions {
    SceneOptions scene;
    ViewOptions view;
    SettingOptions settings;
    RendererOptions renderer = deviceDefaults();
    Console console;
    double frames = 5;
};

/// The technique that is asked for alone, else the fast ones; all with the other settings that are given.
std::vector<bench::Contender> contendersFor(const SettingOptions& options) {
    const RenderSettings settings = resolve(options);
    const bool named = std::ranges::any_of(options.values, [](const auto& value) { return value.first == "lighting"; });
    if (named || settings.lighting != RenderSettings{}.lighting) return {{settings.lighting, settings}};
    std::vector<bench::Contender> contenders;
    for (const bench::Contender& fast : bench::fastContenders()) {
        contenders.push_back({fast.name, settings});
        contenders.back().settings.lighting = fast.settings.lighting;
        contenders.back().settings.lidrPacking = fast.settings.lidrPacking;
    }
    return contenders;
}

void run(const BenchOptions& options) {
    std::vector<bench::Contender> contenders = contendersFor(options.settings);
    const Scene scene = loadScene(options.scene, options.console);
    const View view = chooseView(scene, options.view);
    Renderer renderer(options.renderer);
    renderer.setScene(scene);
    std::vector<bench::Measured> results;
    {
        const ProgressLine progress(options.console, "measuring:");
        // A G-buffer of one sample is all that the bound knows.
        if (contenders.front().settings.msaa == Msaa::x1 && contenders.front().name != bench::ideal().name)
            contenders.push_back(bench::ideal());
        results = bench::measure(renderer, view, contenders, int(options.frames));
        bench::count(renderer, view, contenders, results);
    }
    fmt::print("{} lights, {} triangles, {}x{}; {}, {}\n\n{}\n{}", scene.lights.size(), results.front().stats.triangles, view.extent.x,
               view.extent.y, renderer.device().name, renderer.device().driver, bench::frameTable(results), bench::lightingTable(results));
}

}  // namespace

void addBenchCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("bench", "measure frames of a scene, technique by technique");
    const auto options = std::make_shared<BenchOptions>();
    addSceneOptions(*command, options->scene);
    addViewOptions(*command, options->view);
    addSettingOptions(*command, options->settings);
    addParsed(
        *command, "--frames",
        [frames = &options->frames](const std::string& text) {
            *frames = parseNumber("--frames", text);
            if (*frames < 1 || *frames > 1000 || *frames != std::floor(*frames))
                throw Error(ErrorKind::usage, fmt::format("--frames: expected a whole number from 1 to 1000, got \"{}\"", text));
        },
        "frames of each technique [5]")
        ->type_name("NUMBER");
    addDeviceOptions(*command, options->renderer);
    addConsoleOptions(*command, options->console);
    command->footer(
        "Measures the techniques that are fast with many lights, or the one that --lighting names, and `ideal`, the bound\n"
        "that no exact technique can be under for finding fewer lights.\n");
    command->callback([options] { run(*options); });
}

}  // namespace luciole::cli
