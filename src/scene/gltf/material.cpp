#include "scene/gltf/material.hpp"

namespace luciole::gltf {

uint32_t Materials::load(const std::optional<JsonNode>& reference) {
    const uint32_t index = reference ? indexInto(root_, "materials", *reference) : kNone;
    if (const auto known = materials_.find(index); known != materials_.end()) return known->second;
    scene_.materials.push_back(reference ? read(root_.at("materials")[index], index) : Material{.name = "default"});
    return materials_[index] = uint32_t(scene_.materials.size() - 1);
}

Material Materials::read(const JsonNode& json, uint32_t index) {
    Material material;
    material.name = stringOr(json, "name", fmt::format("material {}", index));
    if (const auto pbr = json.find("pbrMetallicRoughness")) {
        material.baseColor = vectorOr<4>(*pbr, "baseColorFactor", dvec4(1), 0);
        material.metallic = float(numberOr(*pbr, "metallicFactor", 1, 0, 1));
        material.roughness = float(numberOr(*pbr, "roughnessFactor", 1, 0, 1));
    }
    double strength = 1;
    if (const auto emissive = extension(json, "KHR_materials_emissive_strength")) {
        strength = numberOr(*emissive, "emissiveStrength", 1, 0);
    }
    const dvec3 emissive = vectorOr<3>(json, "emissiveFactor", dvec3(0), 0) * strength;
    material.emissive = glm::min(emissive, dvec3(JsonNode::kMost));
    material.doubleSided = booleanOr(json, "doubleSided", false);
    if (extension(json, "KHR_materials_unlit")) material.equation = LightEquation::unlit;
    readAlpha(json, material);
    readTextures(json, material);
    return material;
}

void Materials::readTextures(const JsonNode& json, Material& material) {
    if (const auto pbr = json.find("pbrMetallicRoughness")) {
        if (const auto info = pbr->find("baseColorTexture")) material.baseColorTexture = textures_.load(*info);
        if (const auto info = pbr->find("metallicRoughnessTexture")) {
            material.metallicRoughnessTexture = textures_.load(*info);
        }
    }
    if (const auto info = json.find("normalTexture")) {
        material.normalTexture = textures_.load(*info);
        material.normalScale = float(numberOr(*info, "scale", 1));
    }
    if (const auto info = json.find("occlusionTexture")) {
        material.occlusionTexture = textures_.load(*info);
        material.occlusionStrength = float(numberOr(*info, "strength", 1, 0, 1));
    }
    if (const auto info = json.find("emissiveTexture")) material.emissiveTexture = textures_.load(*info);
}

void Materials::readAlpha(const JsonNode& json, Material& material) {
    const auto mode = json.find("alphaMode");
    if (mode) material.alphaMode = AlphaMode(mode->choice({"OPAQUE", "MASK", "BLEND"}));
    if (material.alphaMode == AlphaMode::mask) material.alphaCutoff = float(numberOr(json, "alphaCutoff", 0.5, 0));
}

}  // namespace luciole::gltf
