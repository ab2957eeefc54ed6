#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <luciole/error.hpp>
#include <luciole/output.hpp>
#include <memory>

#include "bench_report.hpp"
#include "bench_run.hpp"
#include "commands.hpp"
#include "interrupt.hpp"
#include "outputs.hpp"

namespace luciole::cli {
namespace {

constexpr int kAblations = 5;  ///< each is a frame for every pass, so a few must do

struct BenchOptions {
    std::vector<std::string> scenes;
    SceneOptions scene;  ///< but for its uri
    ViewOptions view;
    SettingOptions settings;
    std::vector<Axis> axes;
    RendererOptions renderer = deviceDefaults();
    Console console;
    bench::Effort effort{.frames = 10, .most = 40, .halfWidth = 0.03, .seconds = 20};
    std::string reproduction;
    bool json = false;
    bool csv = false;
    std::vector<std::string> files;
};

/// The techniques that are asked for, else the fast ones, and `ideal`; all with the other settings that are given.
std::vector<bench::Contender> contendersFor(const SettingOptions& options, const RenderSettings& settings) {
    const std::string bound = bench::ideal().name;
    std::vector<bench::Contender> contenders = contendersNamed(techniquesNamed(options, settings), settings);
    if (contenders.empty())
        for (const bench::Contender& fast : bench::fastContenders()) {
            contenders.push_back({fast.name, settings});
            contenders.back().settings.lighting = fast.settings.lighting;
            contenders.back().settings.lidrPacking = fast.settings.lidrPacking;
        }
    std::erase_if(contenders, [&](const bench::Contender& contender) { return contender.settings.lighting == bound; });
    // A G-buffer of one sample is all that the bound knows.
    if (settings.msaa == Msaa::x1) contenders.push_back(contendersNamed({bound}, settings).front());
    return contenders;
}

std::string textOf(const bench::Machine& machine, const std::vector<CellResult>& results) {
    std::string text = fmt::format("{}\n", bench::describe(machine));
    for (const CellResult& result : results) text += cellText(result);
    return text + summaryText(results);
}

std::string contentFor(const std::filesystem::path& file, const bench::Machine& machine, const std::vector<CellResult>& results) {
    if (file.extension() == ".json") return benchJson(machine, results);
    return file.extension() == ".csv" ? benchCsv(machine, results) : textOf(machine, results);
}

void reproduce(const BenchOptions& options) {
    const auto& all = bench::reproductions();
    const auto found = std::ranges::find(all, options.reproduction, &bench::Reproduction::name);
    if (found == all.end()) {
        std::string names;
        for (const bench::Reproduction& one : all) names += fmt::format("{}{}", names.empty() ? "" : ", ", one.name);
        throw Error(ErrorKind::usage, fmt::format("--reproduce: expected one of {}, got \"{}\"", names, options.reproduction));
    }
    Renderer renderer(options.renderer);
    std::vector<bench::Ratio> ratios;
    {
        ProgressLine progress(options.console, "measuring:");
        ratios = found->run(renderer, options.view.size, options.effort, [&](double share) { progress.show(share); });
    }
    const bench::Machine machine = bench::machineOf(renderer.device());
    fmt::print("{}", options.json ? reproductionJson(machine, *found, ratios) : reproductionText(machine, *found, ratios));
}

/// Everything that can be refused is checked before a scene is read.
void run(const BenchOptions& options) {
    if (!options.reproduction.empty()) return reproduce(options);
    if (options.scenes.empty()) throw Error(ErrorKind::usage, "SCENE is required, or --reproduce (see luciole bench --help)");
    const std::vector<Cell> cells = cellsOf(options.scenes, {.scene = options.scene, .view = options.view, .settings = resolve(options.settings)}, options.axes);
    const auto contendersOf = [&](const RenderSettings& settings) { return contendersFor(options.settings, settings); };
    for (const Cell& cell : cells) contendersOf(cell.settings);
    for (const std::filesystem::path file : options.files) {
        if (file.extension() != ".json" && file.extension() != ".csv" && file.extension() != ".md")
            throw Error(ErrorKind::usage, fmt::format("{}: expected a name that ends in .json, .csv or .md", file.string()));
        requireWritable(file);
    }
    Renderer renderer(options.renderer);
    const std::vector<CellResult> results = measureCells(renderer, cells, contendersOf, options.effort, options.console);
    const bench::Machine machine = bench::machineOf(renderer.device());
    for (const std::filesystem::path file : options.files) {
        const std::string content = contentFor(file, machine, results);
        const FinishFirst guard;
        writeFileAtomically(file, std::as_bytes(std::span(content)));
    }
    fmt::print("{}", options.json ? benchJson(machine, results) : options.csv ? benchCsv(machine, results) : textOf(machine, results));
}

/// A whole number in [low, high].
void addWhole(CLI::App& command, const std::string& name, int& value, int low, int high, const std::string& help) {
    addParsed(
        command, name,
        [name, &value, low, high](const std::string& text) {
            const double number = parseNumber(name, text);
            if (number < low || number > high || number != std::floor(number))
                throw Error(ErrorKind::usage, fmt::format("{}: expected a whole number from {} to {}, got \"{}\"", name, low, high, text));
            value = int(number);
        },
        fmt::format("{} [{}]", help, value))
        ->type_name("NUMBER");
}

}  // namespace

void addBenchCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("bench", "measure frames of scenes, technique by technique");
    const auto options = std::make_shared<BenchOptions>();
    command->add_option("SCENE", options->scenes, "glTF files or built-in scenes (builtin:NAME?key=value&...)")->type_name("...");
    addSceneFileOptions(*command, options->scene);
    addViewOptions(*command, options->view);
    addSettingOptions(*command, options->settings);
    command->add_option_function<std::vector<std::string>>(
               "--sweep",
               [axes = &options->axes](const std::vector<std::string>& texts) {
                   for (const std::string& text : texts) axes->push_back(parseAxis(text));
               },
               "measure each value of size, a setting, or a parameter of a built-in scene; repeatable, for all combinations")
        ->type_name("NAME=VALUE,...")
        ->allow_extra_args(false)
        ->group("Measuring");
    addWhole(*command, "--frames", options->effort.frames, 1, 1000, "measured frames of each technique, at least");
    addWhole(*command, "--most-frames", options->effort.most, 1, 1000, "and at most; between, until the median's interval is within 3 %");
    command->add_flag_callback("--passes", [effort = &options->effort] { effort->ablations = kAblations; },
                               "what each pass costs: by timestamps, and by cutting frames off behind it")
        ->group("Measuring");
    addParsed(
        *command, "--seconds",
        [seconds = &options->effort.seconds](const std::string& text) {
            *seconds = parseNumber("--seconds", text);
            if (*seconds <= 0) throw Error(ErrorKind::usage, fmt::format("--seconds: expected above 0, got {}", text));
        },
        fmt::format("after so long a technique has had enough frames, if there are three [{}]", options->effort.seconds))
        ->type_name("NUMBER");
    command->add_option("--reproduce", options->reproduction, "measure a published comparison again, instead of SCENE: trebilco, olsson, mjp")
        ->type_name("NAME")
        ->excludes("SCENE");
    CLI::Option* json = command->add_flag("--json", options->json, "print JSON");
    command->add_flag("--csv", options->csv, "print comma-separated values")->excludes(json);
    command->add_option("-o,--output", options->files, "write the figures to .json, .csv or .md, too; repeatable")->type_name("FILE")->allow_extra_args(false);
    addDeviceOptions(*command, options->renderer);
    addConsoleOptions(*command, options->console);
    command->footer(
        "Measures the techniques that are fast with many lights, or those that --lighting names (with commas between, or all),\n"
        "and `ideal`, the bound that no exact technique can be under for finding fewer lights.\n"
        "Examples:\n"
        "  luciole bench model.glb --lighting tiled,clustered\n"
        "  luciole bench builtin:hall --sweep lights=255,1024,4096 --sweep overlap=2,4,16 -o hall.csv\n");
    command->callback([options] { run(*options); });
}

}  // namespace luciole::cli
