#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <luciole/error.hpp>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "compare_scene.hpp"
#include "picture_comparison.hpp"

namespace luciole::cli {
namespace {

constexpr int kDiffers = 1;  ///< exit code

struct CompareOptions {
    std::vector<std::string> inputs;  ///< two pictures, or one scene
    std::string output;
    PictureComparison pictures;
    SceneComparison scene;
};

/// Refuses options that are for the other kind of comparison: whoever gave them expects them to do something.
void refuseGiven(const CLI::App& command, std::initializer_list<std::string_view> groups, std::string_view inputs) {
    for (const CLI::Option* option : command.get_options([](const CLI::Option* one) { return one->count() > 0; }))
        if (std::ranges::find(groups, option->get_group()) != groups.end() && option->get_name() != "--exposure")
            throw Error(ErrorKind::usage, fmt::format("{}: not for {}", option->get_name(), inputs));
}

int run(const CLI::App& command, CompareOptions& options) {
    for (const std::string& input : options.inputs)
        if (std::error_code none; std::filesystem::equivalent(options.output, input, none))
            throw Error(ErrorKind::usage, fmt::format("-o: expected another file than those that are read, got \"{}\"", options.output));
    if (options.inputs.size() == 2) {
        refuseGiven(command, {"Scene", "View", "Settings", "Device", "Measuring"}, "two pictures");
        options.pictures.reference = options.inputs[0];
        options.pictures.test = options.inputs[1];
        options.pictures.mapFile = options.output;
        options.pictures.exposureEv = resolve(options.scene.request.settings).exposureEv;
        return comparePictures(options.pictures, options.scene.request.console) ? 0 : kDiffers;
    }
    refuseGiven(command, {"Limits", "Pictures"}, "a scene");
    options.scene.request.scene.uri = options.inputs[0];
    options.scene.file = options.output;
    compareScene(options.scene);
    return 0;
}

}  // namespace

void addCompareCommand(CLI::App& app, int& exitCode) {
    CLI::App* command = app.add_subcommand("compare", "say how a picture differs from a reference, or how techniques do on a scene");
    const auto options = std::make_shared<CompareOptions>();
    command->add_option("INPUT", options->inputs, "the reference and the picture to compare with it, two .exr or two .png; or a scene")
        ->type_name("")
        ->required()
        ->expected(1, 2);
    command->add_option("-o,--output", options->output, "of pictures: heat maps of the differences to write, .png; of a scene: the report, .html")->type_name("FILE");
    addPictureComparisonOptions(*command, options->pictures);
    addFrameOptions(*command, options->scene.request);
    command->add_option_function<std::vector<std::string>>(
               "--sweep",
               [axes = &options->scene.axes](const std::vector<std::string>& texts) {
                   for (const std::string& text : texts) axes->push_back(parseAxis(text));
               },
               "chart the cost against size, a setting, or a parameter of a built-in scene")
        ->type_name("NAME=VALUE,...")
        ->allow_extra_args(false)
        ->group("Measuring");
    addDeviceOptions(*command, options->scene.request.renderer);
    addConsoleOptions(*command, options->scene.request.console);
    command->footer(
        "Of two pictures it ends with 0 if they are identical or, where limits are given, within all of them, with 1 if not.\n"
        "Of a scene it renders every technique, or those that --lighting names with commas between, and the reference.\n"
        "Examples:\n"
        "  luciole compare reference.exr new.exr --p999-error 1 -o difference.png\n"
        "  luciole compare reference.png new.png --flip 0.01 --json\n"
        "  luciole compare builtin:hall --size 512x384 --sweep lights=64,255,1024 -o report.html\n");
    command->callback([command, options, &exitCode] { exitCode = run(*command, *options); });
}

}  // namespace luciole::cli
