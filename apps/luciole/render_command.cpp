#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <luciole/error.hpp>
#include <luciole/reference.hpp>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "default_light.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "statistics.hpp"
#include "view.hpp"

namespace luciole::cli {
namespace {

constexpr std::string_view kReference = "reference";  ///< the one technique that needs no device

struct RenderOptions {
    SceneOptions scene;
    ViewOptions view;
    SettingOptions settings;
    OutputOptions output;
    RendererOptions renderer = deviceDefaults();
    Console console;
    bool defaultLight = true;
    bool json = false;
    bool stats = false;
};

void addReportOptions(CLI::App& command, RenderOptions& options) {
    command.add_flag("--json", options.json, "print statistics as JSON on standard output; implies --measure")->group("Messages");
    command.add_flag("--stats", options.stats, "print a table of the passes on standard error; implies --measure")->group("Messages");
    addConsoleOptions(command, options.console);
}

void addDefaultLightOption(CLI::App& command, RenderOptions& options) {
    addParsed(
        command, "--default-light",
        [&](const std::string& text) {
            if (text != "auto" && text != "off")
                throw Error(ErrorKind::usage, fmt::format("--default-light: expected auto or off, got \"{}\"", text));
            options.defaultLight = text == "auto";
        },
        "auto: light a scene that has no light of its own [auto]")
        ->type_name("auto|off")
        ->group("Scene");
}

void requireTechnique(const SettingOptions& options, const std::string& name) {
    const auto& known = lightingTechniques();
    if (std::any_of(known.begin(), known.end(), [&](const auto& technique) { return technique.name == name; })) return;
    std::string names;
    for (const auto& technique : known) names += fmt::format("{}{}", names.empty() ? "" : ", ", technique.name);
    throw Error(ErrorKind::usage,
                fmt::format("{}: expected one of {}, got \"{}\"", originOf(options, "lighting"), names, name));
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

/// Where programs may keep what they can do without (XDG Base Directory Specification); empty: nowhere.
std::string cacheFolder() {
    const char *folder = std::getenv("XDG_CACHE_HOME"), *home = std::getenv("HOME");
    if (folder && *folder == '/') return std::string(folder) + "/luciole";
    return home && *home == '/' ? std::string(home) + "/.cache/luciole" : "";
}

Frame renderFrame(const RenderOptions& options, const RenderSettings& settings, const Scene& scene, const View& view) {
    const std::vector<std::string> aovs = neededAovs(options.output);
    ProgressLine progress(options.console, "rendering:");
    if (settings.lighting == kReference)
        return renderReference(scene, view, settings, aovs, [&](double share) {
            progress.show(share);
            return true;
        });
    RendererOptions rendererOptions = options.renderer;
    rendererOptions.cacheFolder = cacheFolder();
    Renderer renderer(rendererOptions);
    options.console.detail(fmt::format("device: {}, {}", renderer.device().name, renderer.device().driver));
    renderer.setScene(scene);
    return renderer.render(view, settings, aovs);
}

/// Everything that can be refused is checked before the scene is read, and again before the frame is rendered.
void run(const RenderOptions& options) {
    RenderSettings settings = resolve(options.settings);
    settings.measure |= options.json || options.stats;  // whoever asks for the passes wants their times
    requireTechnique(options.settings, settings.lighting);
    if (settings.lighting == kReference && !options.output.graphFile.empty())
        throw Error(ErrorKind::usage, "--dump-graph: the reference has no frame graph");
    requireLists(options.output, settings.lighting);
    checkOutputs(options.output);

    const auto start = std::chrono::steady_clock::now();
    const auto sinceStart = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    Scene scene = loadScene(options.scene, options.console);
    options.console.detail(fmt::format("{:.2f} s: scene loaded", sinceStart()));
    const View view = chooseView(scene, options.view);
    if (options.defaultLight && needsDefaultLight(scene)) {
        addDefaultLight(scene, view.camera);
        options.console.note("the scene has no light; added a soft one (--default-light off leaves it dark)");
    }
    const Frame frame = renderFrame(options, settings, scene, view);
    options.console.detail(fmt::format("{:.2f} s: frame rendered", sinceStart()));
    writeOutputs(options.output, frame);
    options.console.detail(fmt::format("{:.2f} s: files written", sinceStart()));
    if (frame.stats.lightIndex)
        if (const std::string note = overflowNote(*frame.stats.lightIndex, scene); !note.empty()) options.console.note(note);
    std::optional<OverlapCounts> counts;
    if (options.output.shown == Shown::overlap)
        counts = countOverlap(frame.aovs.at("evaluations"), frame.aovs.at("useful-evaluations"));
    if (options.stats) say(statisticsTable(frame.stats, counts));
    if (options.json) fmt::print("{}\n", statisticsJson(frame, settings, counts));
}

}  // namespace

void addRenderCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "render a scene to a picture");
    const auto options = std::make_shared<RenderOptions>();
    addSceneOptions(*command, options->scene);
    addDefaultLightOption(*command, *options);
    addViewOptions(*command, options->view);
    addSettingOptions(*command, options->settings);
    addOutputOptions(*command, options->output);
    addDeviceOptions(*command, options->renderer);
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
