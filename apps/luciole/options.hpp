#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <luciole/renderer.hpp>
#include <luciole/scene.hpp>
#include <luciole/settings.hpp>

#include "console.hpp"

namespace luciole::cli {

/// The scene that most commands begin with.
struct SceneOptions {
    std::string uri;
    std::vector<std::string> rigs;
    bool allowExternal = false;
};
void addSceneOptions(CLI::App& command, SceneOptions& options);
void addScene(CLI::App& command, SceneOptions& options);             ///< of them the scene itself
void addSceneFileOptions(CLI::App& command, SceneOptions& options);  ///< and all others
Scene loadScene(const SceneOptions& options, const Console& console);

/// One option per row of settingsTable, and --settings.
struct SettingOptions {
    std::string file;
    std::vector<std::pair<std::string_view, std::string>> values;  ///< name, value
};
void addSettingOptions(CLI::App& command, SettingOptions& options);
/// The defaults, then the settings file, then the command line.
RenderSettings resolve(const SettingOptions& options);
/// Where the value of setting `name` comes from, as errors begin: `--NAME`, or `FILE: /NAME`.
std::string originOf(const SettingOptions& options, std::string_view name);

/// Validation is always on in debug builds; its messages go to stderr.
RendererOptions deviceDefaults();
void addDeviceOptions(CLI::App& command, RendererOptions& options);

void addConsoleOptions(CLI::App& command, Console& console);

/// An option whose text is read while parsing. \param read throws Error(usage)
CLI::Option* addParsed(CLI::App& command, const std::string& name, std::function<void(const std::string&)> read,
                       const std::string& help);

/// One finite number, all of `text`. \throws Error(usage) naming `option`
double parseNumber(std::string_view option, std::string_view text);
/// Width and height in pixels from "WxH". \throws Error(usage) unless each lies in [1, 16384]
uvec2 parseSize(std::string_view option, std::string_view text);
/// Exactly `count` numbers with commas between. \throws Error(usage) naming `option`
std::vector<double> parseNumbers(std::string_view option, std::string_view text, size_t count);

}  // namespace luciole::cli
