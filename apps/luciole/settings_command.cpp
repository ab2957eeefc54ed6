#include <fmt/format.h>
#include <fmt/ranges.h>

#include <luciole/settings.hpp>
#include <memory>

#include "commands.hpp"

namespace luciole::cli {
namespace {

std::string valuesOf(const Setting& setting, std::string_view separator) {
    if (setting.type == "choice") return fmt::format("{}", fmt::join(setting.choices, separator));
    if (setting.type == "switch") return fmt::format("on{}off", separator);
    if (setting.type == "number" || setting.type == "whole") return fmt::format("{} to {}", setting.low, setting.high);
    return "a name";
}

std::string settingsText() {
    std::string text;
    for (const Setting& setting : settingsTable())
        text += fmt::format("{:<15} {}\n{:<15} values: {}; default: {}\n", setting.name, setting.help, "",
                            valuesOf(setting, ", "), setting.get(RenderSettings{}));
    return text;
}

std::string settingsMarkdown() {
    std::string text =
        "# Settings\n\n"
        "How a picture is made. This page is written by `luciole settings --markdown`.\n\n"
        "Each row is an option of `luciole render` (`--tonemap agx`), a key of the JSON object in a settings file\n"
        "(`--settings FILE`, as in `{\"tonemap\": \"agx\", \"exposure\": 1.5, \"depth-prepass\": true}`) and a member "
        "of\n"
        "`RenderSettings`. The command line wins over the file, the file over the defaults.\n"
        "Switches are `true` or `false` in a file; on the command line the bare option means on, `--measure=off` "
        "off.\n\n"
        "| setting | values | default | what it does |\n| --- | --- | --- | --- |\n";
    for (const Setting& setting : settingsTable())
        text += fmt::format("| `{}` | {} | `{}` | {} |\n", setting.name, valuesOf(setting, ", "),
                            setting.get(RenderSettings{}), setting.help);
    return text;
}

}  // namespace

void addSettingsCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("settings", "list the settings of render");
    const auto markdown = std::make_shared<bool>(false);
    command->add_flag("--markdown", *markdown, "print docs/settings.md");
    command->callback([markdown] { fmt::print("{}", *markdown ? settingsMarkdown() : settingsText()); });
}

}  // namespace luciole::cli
