#include <fmt/format.h>

#include <chrono>
#include <luciole/error.hpp>
#include <luciole/reference.hpp>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "outputs.hpp"
#include "request.hpp"
#include "statistics.hpp"

namespace luciole::cli {
namespace {

constexpr std::string_view kReference = "reference";  ///< the one technique that needs no device

struct RenderOptions {
    FrameRequest request;
    OutputOptions output;
    bool json = false;
    bool stats = false;
};

void addReportOptions(CLI::App& command, RenderOptions& options) {
    command.add_flag("--json", options.json, "print statistics as JSON on standard output; implies --measure")->group("Messages");
    command.add_flag("--stats", options.stats, "print a table of the passes on standard error; implies --measure")->group("Messages");
    addConsoleOptions(command, options.request.console);
}

/// Refuses layers of lists with techniques that make none.
void requireLists(const OutputOptions& output, const std::string& technique) {
    const std::vector<std::string> aovs = neededAovs(output);
    if (std::none_of(aovs.begin(), aovs.end(), [](const std::string& aov) { return aov == "list-length" || aov == "list-slice"; })) return;
    std::string names;
    for (const LightingTechniqueInfo& known : lightingTechniques()) {
        if (!known.lists) continue;
        if (known.name == technique) return;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", known.name);
    }
    throw Error(ErrorKind::usage, fmt::format("{}: expected one of --lighting {}, which make lists of lights, got {}",
                                              output.shown == Shown::clusters ? "--view clusters" : "--aov list-length, list-slice", names, technique));
}

Frame renderFrame(const RenderOptions& options, const RenderSettings& settings, const Scene& scene, const View& view) {
    const std::vector<std::string> aovs = neededAovs(options.output);
    const Console& console = options.request.console;
    ProgressLine progress(console, "rendering:");
    if (settings.lighting == kReference)
        return renderReference(scene, view, settings, aovs, [&](double share) {
            progress.show(share);
            return true;
        });
    Renderer renderer(rendererOptions(options.request));
    console.detail(fmt::format("device: {}, {}", renderer.device().name, renderer.device().driver));
    renderer.setScene(scene);
    return renderer.render(view, settings, aovs);
}

/// Everything that can be refused is checked before the scene is read, and again before the frame is rendered.
void run(const RenderOptions& options) {
    const Console& console = options.request.console;
    RenderSettings settings = resolve(options.request.settings);
    settings.measure |= options.json || options.stats;  // whoever asks for the passes wants their times
    requireTechnique(options.request.settings, settings.lighting);
    if (settings.lighting == kReference && !options.output.graphFile.empty())
        throw Error(ErrorKind::usage, "--dump-graph: the reference has no frame graph");
    requireLists(options.output, settings.lighting);
    checkOutputs(options.output);

    const auto start = std::chrono::steady_clock::now();
    const auto sinceStart = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const auto [scene, view] = loadSceneAndView(options.request);
    console.detail(fmt::format("{:.2f} s: scene loaded", sinceStart()));
    const Frame frame = renderFrame(options, settings, scene, view);
    console.detail(fmt::format("{:.2f} s: frame rendered", sinceStart()));
    writeOutputs(options.output, frame);
    console.detail(fmt::format("{:.2f} s: files written", sinceStart()));
    if (frame.stats.lightIndex)
        if (const std::string note = overflowNote(*frame.stats.lightIndex, scene); !note.empty()) console.note(note);
    if (frame.stats.shadows)
        for (const std::string& note : shadowNotes(*frame.stats.shadows, scene)) console.note(note);
    std::optional<OverlapCounts> counts;
    if (options.output.shown == Shown::overlap)
        counts = countOverlap(frame.aovs.at("evaluations"), frame.aovs.at("useful-evaluations"));
    if (options.stats && frame.stats.choice) console.note(frame.stats.choice->reason);
    if (options.stats) say(statisticsTable(frame.stats, counts));
    if (options.json) fmt::print("{}\n", statisticsJson(frame, settings, counts));
}

}  // namespace

void addRenderCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "render a scene to a picture");
    const auto options = std::make_shared<RenderOptions>();
    addSceneAndViewOptions(*command, options->request);
    addOutputOptions(*command, options->output);
    addDeviceOptions(*command, options->request.renderer);
    addReportOptions(*command, *options);
    command->footer(
        "Examples:\n"
        "  luciole render builtin:hall -o hall.png --size 1920x1080 --stats\n"
        "  luciole render model.glb -o model.png -o model.exr --aov depth,normal\n"
        "  luciole render model.glb -o truth.png --lighting reference\n"
        "  luciole render model.glb -o lights.png --view overlap --stats\n");
    command->callback([options] { run(*options); });
}

}  // namespace luciole::cli
