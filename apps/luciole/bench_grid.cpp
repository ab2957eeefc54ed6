#include "bench_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>

namespace luciole::cli {
namespace {

constexpr std::string_view kOption = "--sweep", kBuiltin = "builtin:";

bool isSetting(std::string_view name) { return std::ranges::any_of(settingsTable(), [&](const Setting& setting) { return setting.name == name; }); }

/// The scene with its parameter, and what the parameter takes.
void setParameter(std::string& uri, const std::string& name, const std::string& value) {
    const std::string scene = uri.starts_with(kBuiltin) ? uri.substr(kBuiltin.size(), uri.find('?') - kBuiltin.size()) : "";
    const auto builtin = std::ranges::find(builtinScenes(), scene, &BuiltinScene::name);
    if (builtin == builtinScenes().end())
        throw Error(ErrorKind::usage, fmt::format("{}: expected size, a setting or, for built-in scenes, one of their parameters, got \"{}\" for {}", kOption, name, uri));
    const auto parameter = std::ranges::find(builtin->parameters, name, &BuiltinParameter::name);
    if (parameter == builtin->parameters.end()) {
        std::string known;
        for (const BuiltinParameter& one : builtin->parameters) known += fmt::format(", {}", one.name);
        throw Error(ErrorKind::usage, fmt::format("{}: expected size, a setting or a parameter of {}{}, got \"{}\"", kOption, uri, known, name));
    }
    if (uri.find(fmt::format("?{}=", name)) != std::string::npos || uri.find(fmt::format("&{}=", name)) != std::string::npos)
        throw Error(ErrorKind::usage, fmt::format("{} {}: {} gives it already", kOption, name, uri));
    const double number = parseNumber(fmt::format("{} {}", kOption, name), value);
    if (number < parameter->low || number > parameter->high)
        throw Error(ErrorKind::usage, fmt::format("{} {}: expected {:.10g} to {:.10g}, got {}", kOption, name, parameter->low, parameter->high, value));
    uri += fmt::format("{}{}={}", uri.find('?') == std::string::npos ? "?" : "&", name, value);
}

void setAxis(Cell& cell, const std::string& name, const std::string& value) {
    if (name == "size") {
        cell.view.size = parseSize("--sweep size", value);
    } else if (isSetting(name)) {
        try {
            setSetting(cell.settings, name, value);
        } catch (const Error& error) {
            throw Error(error.kind(), fmt::format("{} {}", kOption, error.what()));
        }
    } else {
        setParameter(cell.scene.uri, name, value);
    }
    cell.at.emplace_back(name, value);
}

}  // namespace

Axis parseAxis(const std::string& text) {
    const size_t equals = text.find('=');
    Axis axis{text.substr(0, equals), {}};
    for (size_t at = equals; at != std::string::npos;) {
        const size_t next = text.find(',', at + 1);
        axis.values.push_back(text.substr(at + 1, next == std::string::npos ? next : next - at - 1));
        at = next;
    }
    if (axis.name.empty() || axis.values.empty() || std::ranges::any_of(axis.values, [](const std::string& value) { return value.empty(); }))
        throw Error(ErrorKind::usage, fmt::format("{}: expected NAME=VALUE,VALUE,..., got \"{}\"", kOption, text));
    if (axis.name == "lighting") throw Error(ErrorKind::usage, fmt::format("{}: techniques are named by --lighting, with commas between, or all", kOption));
    return axis;
}

std::vector<Cell> cellsOf(const std::vector<std::string>& scenes, const Cell& base, const std::vector<Axis>& axes) {
    std::vector<Cell> cells;
    for (const std::string& scene : scenes) {
        Cell start = base;
        start.scene.uri = scene;
        std::vector<Cell> ofScene{start};
        for (const Axis& axis : axes) {
            std::vector<Cell> more;
            for (const Cell& cell : ofScene)
                for (const std::string& value : axis.values) setAxis(more.emplace_back(cell), axis.name, value);
            ofScene = std::move(more);
        }
        cells.insert(cells.end(), ofScene.begin(), ofScene.end());
    }
    return cells;
}

}  // namespace luciole::cli
