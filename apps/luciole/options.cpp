#include "options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>
#include <memory>
#include <system_error>

namespace luciole::cli {
namespace {

[[noreturn]] void refuse(std::string_view option, std::string_view expected, std::string_view found) {
    throw Error(ErrorKind::usage, fmt::format("{}: expected {}, got \"{}\"", option, expected, found));
}

/// All of `text` as a T, or false.
template <typename T>
bool parseAll(std::string_view text, T& value) {
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    return code == std::errc() && end == text.data() + text.size();
}

constexpr size_t kMaxSettingsBytes = 1 << 20;

std::string readText(const std::string& file) {
    const auto fail = [&] {
        throw Error(ErrorKind::io, fmt::format("{}: can't read: {}", file, std::generic_category().message(errno)));
    };
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
    if (!stream) fail();
    std::string text;
    std::array<char, 4096> block;
    while (const size_t count = std::fread(block.data(), 1, block.size(), stream.get())) {
        text.append(block.data(), count);
        if (text.size() > kMaxSettingsBytes)  // not asked of the file, which may be a pipe
            throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} bytes", file, kMaxSettingsBytes));
    }
    if (std::ferror(stream.get()) != 0) fail();
    return text;
}

}  // namespace

void addScene(CLI::App& command, SceneOptions& options) {
    command.add_option("SCENE", options.uri, "glTF file (.gltf, .glb) or built-in scene (builtin:NAME?key=value&...)")
        ->type_name("")
        ->required();
}

void addSceneOptions(CLI::App& command, SceneOptions& options) {
    addScene(command, options);
    addSceneFileOptions(command, options);
}

void addSceneFileOptions(CLI::App& command, SceneOptions& options) {
    command.add_option("--rig", options.rigs, "lay the lights and materials of a rig file over the scene; repeatable")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->group("Scene");
    command.add_flag("--allow-external", options.allowExternal, "let the scene read files outside its own folder")
        ->group("Scene");
}

Scene loadScene(const SceneOptions& options, const Console& console) {
    Scene scene = [&] {
        const ProgressLine progress(console, "reading the scene:");
        Scene read = luciole::loadScene(options.uri, {.allowExternal = options.allowExternal});
        for (const std::string& rig : options.rigs) applyRig(read, rig);
        return read;
    }();
    console.warn(scene.warnings);
    return scene;
}

void addSettingOptions(CLI::App& command, SettingOptions& options) {
    const RenderSettings defaults;
    for (const Setting& setting : settingsTable()) {
        const auto read = [&options, name = setting.name, isSwitch = setting.type == "switch"](std::string value) {
            if (isSwitch && value == "true") value = "on";  // CLI11's word for an option without a value
            RenderSettings scratch;                         // so that a bad value is refused before anything is loaded
            try {
                setSetting(scratch, name, value);
            } catch (const Error& error) {
                throw Error(error.kind(), fmt::format("--{}", error.what()));  // it begins with the setting's name
            }
            options.values.emplace_back(name, value);
        };
        const std::string flag = fmt::format("--{}", setting.name);
        const std::string help = fmt::format("{} [{}]", setting.help, setting.get(defaults));
        CLI::Option* option = addParsed(command, flag, read, help)->group("Settings");
        if (setting.type == "choice") option->type_name(fmt::format("{}", fmt::join(setting.choices, "|")));
        if (setting.type == "number" || setting.type == "whole") option->type_name("NUMBER");
        if (setting.type == "name") option->type_name("NAME");
        // Takes no word after it, only "=on" or "=off": the next word may be the scene.
        if (setting.type == "switch") option->type_name("[=off]")->expected(0);
    }
    command.add_option("--settings", options.file, "read settings from a JSON file; options above win over it")
        ->type_name("FILE")
        ->group("Settings");
}

RenderSettings resolve(const SettingOptions& options) {
    RenderSettings settings;
    if (!options.file.empty()) applySettingsText(settings, readText(options.file), options.file);
    for (const auto& [name, value] : options.values) setSetting(settings, name, value);
    return settings;
}

std::string originOf(const SettingOptions& options, std::string_view name) {
    const auto isNamed = [&](const auto& value) { return value.first == name; };
    const bool fromFile = !options.file.empty() && std::ranges::none_of(options.values, isNamed);
    return fromFile ? fmt::format("{}: /{}", options.file, name) : fmt::format("--{}", name);
}

RendererOptions deviceDefaults() {
#ifdef NDEBUG
    constexpr bool kDebugBuild = false;
#else
    constexpr bool kDebugBuild = true;
#endif
    return {.validation = kDebugBuild,
            .onMessage = [](std::string_view message) { say(fmt::format("luciole: {}\n", message)); }};
}

void addDeviceOptions(CLI::App& command, RendererOptions& options) {
    command
        .add_option("--device", options.device,
                    "index or part of a name, as `luciole devices` says [a discrete GPU, else any GPU, else software]")
        ->type_name("INDEX|NAME")
        ->group("Device");
    command.add_flag("--validation", options.validation, "let Vulkan check every call, and say what it finds (always on in debug builds)")
        ->group("Device");
}

void addConsoleOptions(CLI::App& command, Console& console) {
    CLI::Option* quiet = command.add_flag("-q,--quiet", console.quiet, "say nothing but errors")->group("Messages");
    command.add_flag("-v,--verbose", console.verbose, "say more")->excludes(quiet)->group("Messages");
}

CLI::Option* addParsed(CLI::App& command, const std::string& name, std::function<void(const std::string&)> read,
                       const std::string& help) {
    return command.add_option_function<std::string>(name, std::move(read), help);
}

double parseNumber(std::string_view option, std::string_view text) {
    double value = 0;
    if (!parseAll(text, value) || !std::isfinite(value)) refuse(option, "a number", text);
    return value;
}

uvec2 parseSize(std::string_view option, std::string_view text) {
    constexpr uint32_t kMaxSide = 16384;
    uvec2 size{0};
    const size_t x = text.find('x');
    const bool read =
        x != std::string_view::npos && parseAll(text.substr(0, x), size.x) && parseAll(text.substr(x + 1), size.y);
    if (!read || size.x < 1 || size.y < 1 || size.x > kMaxSide || size.y > kMaxSide)
        refuse(option, fmt::format("WIDTHxHEIGHT, each from 1 to {}", kMaxSide), text);
    return size;
}

std::vector<double> parseNumbers(std::string_view option, std::string_view text, size_t count) {
    std::vector<double> numbers;
    for (std::string_view rest = text;;) {
        const size_t comma = rest.find(',');
        numbers.push_back(parseNumber(option, rest.substr(0, comma)));
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    if (numbers.size() != count) refuse(option, fmt::format("{} numbers with commas between", count), text);
    return numbers;
}

}  // namespace luciole::cli
