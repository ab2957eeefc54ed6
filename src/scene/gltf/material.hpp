#pragma once
#include <cstdint>
#include <map>
#include <optional>

#include <luciole/scene.hpp>

#include "scene/gltf/files.hpp"
#include "scene/gltf/warnings.hpp"

namespace luciole::gltf {

/// Reads textures with their samplers and images; each is decoded once, and only if something uses it.
class Textures {
public:
    /// \param scene to be added to; all references must outlive this
    Textures(const JsonNode& root, Buffers& buffers, const Files& files, const LoadLimits& limits, Warnings& warnings,
             Scene& scene)
        : root_(root), buffers_(buffers), files_(files), limits_(limits), warnings_(warnings), scene_(scene) {}

    /// What the textureInfo `info` says, KHR_texture_transform included. Without texture if that can't be used, which
    /// is warned of.
    TextureUse load(const JsonNode& info);

private:
    uint32_t loadTexture(const JsonNode& reference);
    uint32_t loadTexels(const JsonNode& reference);
    Texels decode(const JsonNode& image);

    JsonNode root_;
    Buffers& buffers_;
    const Files& files_;
    const LoadLimits& limits_;
    Warnings& warnings_;
    Scene& scene_;
    std::map<uint32_t, uint32_t> textures_;  ///< index in the file -> index in the scene
    std::map<uint32_t, uint32_t> texels_;
    uint64_t decodedBytes_ = 0;
};

/// Reads materials: metallic-roughness, KHR_materials_emissive_strength, KHR_materials_unlit.
class Materials {
public:
    Materials(const JsonNode& root, Textures& textures, Scene& scene)
        : root_(root), textures_(textures), scene_(scene) {}

    /// \param reference index of the material in the file; absent: glTF's default material
    /// \return its index in the scene
    uint32_t load(const std::optional<JsonNode>& reference);

private:
    Material read(const JsonNode& json, uint32_t index);
    void readTextures(const JsonNode& json, Material& material);
    void readAlpha(const JsonNode& json, Material& material);

    JsonNode root_;
    Textures& textures_;
    Scene& scene_;
    std::map<uint32_t, uint32_t> materials_;  ///< index in the file, kNone for the default -> index in the scene
};

}  // namespace luciole::gltf
