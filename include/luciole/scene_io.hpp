#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <luciole/scene.hpp>

namespace luciole {

/// What untrusted input may cost. A file that needs more is refused with Error(limit).
struct LoadLimits {
    uint64_t maxFileBytes = 4ull << 30;       ///< of one file, buffer or image
    uint32_t maxJsonDepth = 128;
    uint64_t maxElements = 4'000'000;         ///< of any one JSON array; also nodes in all, instances included
    uint64_t maxVertices = 200'000'000;       ///< decoded, all meshes together; likewise indices
    uint32_t maxImageSide = 16384;            ///< texels
    uint64_t maxImageBytes = 4ull << 30;      ///< decoded, all images together
};

struct LoadOptions {
    bool allowExternal = false;  ///< allow buffers and images outside the scene file's folder
    LoadLimits limits;
};

/// Reads a glTF 2.0 file (.gltf, .glb) or makes a built-in scene from a URI `builtin:NAME?key=value&...`.
/// \throws Error(scene) for a fault in the file, Error(io) if it can't be read, Error(usage) for a bad URI,
///         Error(limit) beyond `options.limits`
Scene loadScene(const std::string& uri, const LoadOptions& options = {});

/// Reads glTF or GLB from memory. External files are resolved against `folder`; an empty folder refuses them all.
Scene loadGltf(std::span<const std::byte> bytes, const std::string& nameForErrors, const std::filesystem::path& folder,
               const LoadOptions& options = {});

/// Lays a rig file over `scene` (docs/rig.md; schema in docs/rig.schema.json). Either all of it is applied or, on an
/// error, nothing.
/// \throws Error(scene), Error(io), Error(limit)
void applyRig(Scene& scene, const std::filesystem::path& file, const LoadLimits& limits = {});
void applyRigText(Scene& scene, std::string_view json, const std::string& nameForErrors, const LoadLimits& limits = {});

/// Writes `scene` as one GLB file that other renderers can load, whole or not at all.
/// \return what glTF can't say and was left out or approximated, one line each
std::vector<std::string> writeGlb(const Scene& scene, const std::filesystem::path& file);

/// One built-in scene and its parameters, for help and docs.
struct BuiltinParameter {
    std::string_view name;
    std::string_view help;
    double fallback, low, high;
    bool whole = true;  ///< takes whole numbers only
};
struct BuiltinScene {
    std::string_view name;
    std::string_view help;
    std::vector<BuiltinParameter> parameters;
};
const std::vector<BuiltinScene>& builtinScenes();

}  // namespace luciole
