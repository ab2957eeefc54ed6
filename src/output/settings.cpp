#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <luciole/error.hpp>
#include <luciole/settings.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <type_traits>

#include "scene/json.hpp"

namespace luciole {
namespace {

// The names of the choices, each list in the order of its enum.
constexpr std::array<std::string_view, 3> kGBufferNames{"calver", "float", "compact"};
constexpr std::array<std::string_view, 2> kLightBufferNames{"rgba32f", "rgba16f"};
constexpr std::array<std::string_view, 5> kLidrPackingNames{"bit-shift", "max-blend", "max-blend-sorted", "cpu-sort", "list"};
constexpr std::array<std::string_view, 4> kLidrIndicesNames{"auto", "15", "255", "65535"};
constexpr std::array<std::string_view, 3> kLidrCoverNames{"auto", "surface", "front-faces"};
constexpr std::array<std::string_view, 3> kLidrTypesNames{"flag", "one", "targets"};
constexpr std::array<std::string_view, 2> kLidrTablesNames{"buffers", "textures"};
constexpr std::array<std::string_view, 4> kLidrShadowsNames{"final", "index", "index-soft", "none"};
constexpr std::array<std::string_view, 3> kOnOverflowNames{"exact", "priority", "fail"};
constexpr std::array<std::string_view, 4> kTileSizeNames{"auto", "8", "16", "32"};
constexpr std::array<std::string_view, 2> kMsaaNames{"1", "4"};
constexpr std::array<std::string_view, 3> kShadowsNames{"off", "maps", "volumes"};
constexpr std::array<std::string_view, 3> kShadowFilterNames{"point", "jittered", "smooth"};
constexpr std::array<std::string_view, 3> kShadowCastersNames{"all", "front-faces", "back-faces"};
constexpr std::array<std::string_view, 4> kToneMapNames{"none", "reinhard", "aces", "agx"};

template <auto Member, const auto& Names>
Setting choice(std::string_view name, std::string_view help) {
    using Enum = std::remove_cvref_t<decltype(RenderSettings{}.*Member)>;
    return {.name = name,
            .help = help,
            .type = "choice",
            .choices = {Names.begin(), Names.end()},
            .get = [](const RenderSettings& settings) { return std::string(Names[size_t(settings.*Member)]); },
            .set =
                [](RenderSettings& settings, std::string_view value) {
                    settings.*Member = Enum(std::find(Names.begin(), Names.end(), value) - Names.begin());
                }};
}

template <bool RenderSettings::*Member>
Setting onOff(std::string_view name, std::string_view help) {
    return {.name = name,
            .help = help,
            .type = "switch",
            .get = [](const RenderSettings& settings) { return std::string(settings.*Member ? "on" : "off"); },
            .set = [](RenderSettings& settings, std::string_view value) { settings.*Member = value == "on"; }};
}

std::optional<float> parseNumber(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    float value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

template <auto Member>
Setting number(std::string_view name, std::string_view help, double low, double high) {
    using Number = std::remove_cvref_t<decltype(RenderSettings{}.*Member)>;
    return {.name = name,
            .help = help,
            .type = std::is_integral_v<Number> ? "whole" : "number",
            .low = low,
            .high = high,
            .get = [](const RenderSettings& settings) { return fmt::format("{}", settings.*Member); },
            .set = [](RenderSettings& settings,
                      std::string_view value) { settings.*Member = Number(*parseNumber(value)); }};
}

bool accepts(const Setting& setting, std::string_view value) {
    if (setting.type == "choice")
        return std::find(setting.choices.begin(), setting.choices.end(), value) != setting.choices.end();
    if (setting.type == "switch") return value == "on" || value == "off";
    if (setting.type == "number") {
        const std::optional<float> number = parseNumber(value);
        return number && *number >= setting.low && *number <= setting.high;  // NaN fails
    }
    if (setting.type == "whole") {
        const std::optional<float> number = parseNumber(value);
        return number && *number >= setting.low && *number <= setting.high && *number == std::floor(*number);
    }
    return !value.empty();
}

std::string expectation(const Setting& setting) {
    if (setting.type == "choice") return fmt::format("one of {}", fmt::join(setting.choices, ", "));
    if (setting.type == "switch") return "on or off";
    if (setting.type == "number") return fmt::format("a number from {} to {}", setting.low, setting.high);
    if (setting.type == "whole") return fmt::format("a whole number from {} to {}", setting.low, setting.high);
    return "a name";
}

const Setting* findSetting(std::string_view name) {
    const std::span<const Setting> table = settingsTable();
    const auto row = std::find_if(table.begin(), table.end(), [&](const Setting& s) { return s.name == name; });
    return row == table.end() ? nullptr : &*row;
}

/// A JSON value in the words that setSetting takes; empty where its type does not fit the setting.
std::string textOf(const Setting& setting, const nlohmann::json& value) {
    if (setting.type == "switch") return value.is_boolean() ? (value.get<bool>() ? "on" : "off") : "";
    if (setting.type == "number" || setting.type == "whole") return value.is_number() ? value.dump() : "";
    return value.is_string() ? value.get<std::string>() : "";
}

}  // namespace

std::span<const Setting> settingsTable() {
    static const std::array kTable{
        Setting{.name = "lighting",
                .help = "lighting technique; `luciole techniques` lists them, auto chooses",
                .type = "name",
                .get = [](const RenderSettings& settings) { return settings.lighting; },
                .set = [](RenderSettings& settings, std::string_view value) { settings.lighting = value; }},
        choice<&RenderSettings::gbuffer, kGBufferNames>("gbuffer", "what the geometry phase stores per pixel, and how"),
        choice<&RenderSettings::lightBuffer, kLightBufferNames>("light-buffer", "format that the lights are summed in"),
        onOff<&RenderSettings::depthPrepass>("depth-prepass", "draw depth alone first, so each pixel is shaded once"),
        choice<&RenderSettings::msaa, kMsaaNames>("msaa", "samples a pixel, of forward techniques"),
        choice<&RenderSettings::lidrPacking, kLidrPackingNames>("lidr-packing", "light-indexed: how several light indices share a pixel"),
        number<&RenderSettings::overlap>("overlap", "light-indexed: light indices that a pixel has room for", 1, 16),
        choice<&RenderSettings::indices, kLidrIndicesNames>("indices", "light-indexed: lights that indices tell apart"),
        choice<&RenderSettings::onOverflow, kOnOverflowNames>("on-overflow", "light-indexed, where lights do not fit: take a path that holds them, keep the important ones, or fail"),
        choice<&RenderSettings::lidrCover, kLidrCoverNames>("lidr-cover", "light-indexed: which lights a pixel indexes"),
        choice<&RenderSettings::lidrTypes, kLidrTypesNames>("lidr-types", "light-indexed: indices for all types of light by a flag, for points only, or in targets of their own"),
        choice<&RenderSettings::lidrTables, kLidrTablesNames>("lidr-tables", "light-indexed: where surfaces read the data of lights"),
        choice<&RenderSettings::lidrShadows, kLidrShadowsNames>("lidr-shadows", "light-indexed: lights meet their shadows at surfaces, or as indices are written: no index in shadow, or one with how much is lit; or never"),
        onOff<&RenderSettings::lidrShare>("lidr-share", "light-indexed: the light buffer holds the indices before it holds light, where the device allows it"),
        choice<&RenderSettings::tileSize, kTileSizeNames>("tile-size", "tiled and clustered: pixels a side of a tile"),
        Setting{.name = "bounce-light",
                .help = "spot light whose first bounce is shown, by name or index; none: no bounce",
                .type = "name",
                .get = [](const RenderSettings& settings) { return settings.bounceLight; },
                .set = [](RenderSettings& settings, std::string_view value) { settings.bounceLight = value; }},
        number<&RenderSettings::bounceGrid>("bounce-grid", "small lights a side that stand in for the bounce: n x n", 1, 256),
        choice<&RenderSettings::shadows, kShadowsNames>("shadows", "what keeps light off what lies behind objects"),
        choice<&RenderSettings::shadowFilter, kShadowFilterNames>("shadow-filter", "shadow maps: one texel, four that are jittered, or all within the softness"),
        choice<&RenderSettings::shadowCasters, kShadowCastersNames>("shadow-casters", "shadow maps: faces that are drawn, as the light sees them"),
        number<&RenderSettings::shadowMemory>("shadow-memory", "MiB that shadows may take; maps get coarser before a light goes without", 1, 4096),
        number<&RenderSettings::shadowRedraws>("shadow-redraws", "shadow maps: drawn in one frame at most, the most visible first; 0: all that need it", 0, 65536),
        onOff<&RenderSettings::cullLights>("cull-lights", "leave out lights whose shape covers no pixel; off to measure what that saves"),
        number<&RenderSettings::exposureEv>("exposure", "stops, added to the scene's own exposure", -64, 64),
        choice<&RenderSettings::toneMap, kToneMapNames>("tonemap", "how radiance becomes a picture"),
        onOff<&RenderSettings::measure>("measure", "time each pass on its own; the frame as a whole gets slower"),
    };
    return kTable;
}

void setSetting(RenderSettings& settings, std::string_view name, std::string_view value) {
    const Setting* setting = findSetting(name);
    if (!setting) throw Error(ErrorKind::usage, fmt::format("unknown setting \"{}\"", name));
    if (!accepts(*setting, value))
        throw Error(ErrorKind::usage, fmt::format("{}: expected {}, got \"{}\"", name, expectation(*setting), value));
    setting->set(settings, value);
}

std::string getSetting(const RenderSettings& settings, std::string_view name) {
    const Setting* setting = findSetting(name);
    if (!setting) throw Error(ErrorKind::usage, fmt::format("unknown setting \"{}\"", name));
    return setting->get(settings);
}

void applySettingsText(RenderSettings& settings, std::string_view json, const std::string& nameForErrors) {
    RenderSettings changed = settings;
    try {
        const nlohmann::json document = parseJson(json, nameForErrors, {.maxJsonDepth = 8, .maxElements = 1000});
        for (const auto& [key, node] : JsonNode(document, nameForErrors).members()) {
            const Setting* setting = findSetting(key);
            if (!setting) node.failWith("unknown setting");
            const std::string text = textOf(*setting, node.raw());
            if (!accepts(*setting, text)) node.fail(expectation(*setting));
            setting->set(changed, text);
        }
    } catch (const Error& error) {
        throw Error(ErrorKind::usage, error.what());  // the JSON reader speaks of scenes and limits
    }
    settings = changed;
}

}  // namespace luciole
