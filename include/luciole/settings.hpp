#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace luciole {

enum class GBufferLayout : uint8_t { calver, floatPosition, compact };
enum class ToneMap : uint8_t { none, reinhard, aces, agx };
enum class LightBufferFormat : uint8_t { rgba32f, rgba16f };

/// How a picture is made. Each member is one row of `settingsTable`.
struct RenderSettings {
    std::string lighting = "brute-force";
    GBufferLayout gbuffer = GBufferLayout::compact;
    LightBufferFormat lightBuffer = LightBufferFormat::rgba32f;
    bool depthPrepass = false;
    bool cullLights = true;
    float exposureEv = 0;  ///< added to Scene::exposureEv
    ToneMap toneMap = ToneMap::aces;
    bool measure = false;
};

/// One setting: the command line, settings files and the docs all come from this table.
struct Setting {
    std::string_view name;      ///< kebab-case; `--name` on the command line, the key in a settings file
    std::string_view help;      ///< one line
    std::string_view type;      ///< "choice", "number", "switch" (on, off), or "name": checked by the renderer
    std::vector<std::string> choices;  ///< "choice" only
    double low, high;           ///< "number" only
    std::string (*get)(const RenderSettings&);
    void (*set)(RenderSettings&, std::string_view value);  ///< `value` has passed the checks
};
std::span<const Setting> settingsTable();

/// \throws Error(usage) naming the setting, what was expected, and `value`
void setSetting(RenderSettings& settings, std::string_view name, std::string_view value);

/// Applies a settings file's JSON object; unknown keys are errors.
/// \throws Error(usage) naming the file and the key
void applySettingsText(RenderSettings& settings, std::string_view json, const std::string& nameForErrors);

}  // namespace luciole
