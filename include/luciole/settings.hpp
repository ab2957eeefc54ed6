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
/// How light-indexed deferred rendering keeps several indices at a pixel (docs/techniques/light-indexed.md).
enum class LidrPacking : uint8_t { bitShift, maxBlend, maxBlendSorted, cpuSort, list };
enum class LidrIndices : uint8_t { automatic, n15, n255, n65535 };  ///< largest index that is told apart
enum class LidrCover : uint8_t { automatic, surface, frontFaces };  ///< lights that reach the surface; all before it
enum class LidrTypes : uint8_t { flag, one, targets };              ///< what becomes of several types of light
enum class LidrTables : uint8_t { buffers, textures };              ///< where surfaces read lights by index
enum class LidrShadows : uint8_t { finalPass, index, indexSoft, none };  ///< where lights with an index meet their shadows
enum class OnOverflow : uint8_t { exact, priority, fail };
enum class TileSize : uint8_t { automatic, n8, n16, n32 };
enum class Msaa : uint8_t { x1, x4 };  ///< samples a pixel
enum class Shadows : uint8_t { off, maps, volumes };                    ///< docs/techniques/shadows.md
enum class ShadowFilter : uint8_t { point, jittered, smooth };  ///< how many texels of a shadow map a surface asks
enum class ShadowCasters : uint8_t { all, frontFaces, backFaces };  ///< the faces that are drawn into shadow maps, as the light sees them

/// How a picture is made. Each member is one row of `settingsTable`.
struct RenderSettings {
    std::string lighting = "brute-force";
    GBufferLayout gbuffer = GBufferLayout::compact;
    LightBufferFormat lightBuffer = LightBufferFormat::rgba32f;
    bool depthPrepass = false;
    Msaa msaa = Msaa::x1;  ///< forward techniques only
    LidrPacking lidrPacking = LidrPacking::bitShift;
    uint32_t overlap = 4;  ///< indices a pixel
    LidrIndices indices = LidrIndices::automatic;
    OnOverflow onOverflow = OnOverflow::exact;
    LidrCover lidrCover = LidrCover::automatic;
    LidrTypes lidrTypes = LidrTypes::flag;
    LidrTables lidrTables = LidrTables::buffers;
    LidrShadows lidrShadows = LidrShadows::finalPass;
    bool lidrShare = false;
    TileSize tileSize = TileSize::automatic;  ///< pixels; tiled and clustered techniques
    std::string bounceLight = "none";  ///< the light whose first bounce is shown: a light's name, or its index in Scene::lights
    uint32_t bounceGrid = 32;          ///< so many small lights a side stand in for the bounce, [1, 256]
    Shadows shadows = Shadows::off;
    ShadowFilter shadowFilter = ShadowFilter::jittered;
    ShadowCasters shadowCasters = ShadowCasters::all;
    uint32_t shadowMemory = 256;    ///< MiB that shadow maps may take, [1, 4096]
    uint32_t shadowRedraws = 0;     ///< shadow maps drawn in one frame at most, the most visible first, [0, 65536]; 0: all that need it
    bool cullLights = true;
    float exposureEv = 0;  ///< added to Scene::exposureEv
    ToneMap toneMap = ToneMap::aces;
    bool measure = false;
    bool operator==(const RenderSettings&) const = default;
};

/// One setting: the command line, settings files and the docs all come from this table.
struct Setting {
    std::string_view name;      ///< kebab-case; `--name` on the command line, the key in a settings file
    std::string_view help;      ///< one line
    std::string_view type;      ///< "choice", "number", "whole" (number), "switch" (on, off), or "name": checked by the renderer
    std::vector<std::string> choices;  ///< "choice" only
    double low, high;           ///< "number" and "whole" only
    std::string (*get)(const RenderSettings&);
    void (*set)(RenderSettings&, std::string_view value);  ///< `value` has passed the checks
};
std::span<const Setting> settingsTable();

/// \throws Error(usage) naming the setting, what was expected, and `value`
void setSetting(RenderSettings& settings, std::string_view name, std::string_view value);

/// The value of a setting, as setSetting takes it. \throws Error(usage) for an unknown name
std::string getSetting(const RenderSettings& settings, std::string_view name);

/// Applies a settings file's JSON object; unknown keys are errors.
/// \throws Error(usage) naming the file and the key
void applySettingsText(RenderSettings& settings, std::string_view json, const std::string& nameForErrors);

}  // namespace luciole
