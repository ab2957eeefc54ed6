#include <array>

#include <fmt/format.h>

#include <luciole/error.hpp>

#include "scene/rig/sections.hpp"
#include "scene/rig/values.hpp"

namespace luciole::rig {
namespace {

constexpr size_t kShapedKeys = 8;  ///< the last of kMaterialKeys: those of the shaped equation
constexpr std::array<std::string_view, 22> kMaterialKeys{
    "castsShadows",
    "equation",    "surface",   "proceduralColor", "proceduralScale", "baseColor",
    "metallic",    "roughness", "emissive",        "normalScale",     "occlusionStrength",
    "doubleSided", "alphaMode", "alphaCutoff",     "diffuseFunction", "specularFunction",
    "kd",          "ks",        "specularColor",   "specularBlend",   "kAmbient",
    "kEmissive"};

/// A colour, or a colour and alpha; without one the alpha stays.
vec4 baseColor(const JsonNode& node, vec4 before) {
    if (!node.isArray() || node.size() != 4) return vec4(color(node), before.a);
    return vec4(node[0].number(0), node[1].number(0), node[2].number(0), node[3].number(0, 1));
}

void setShaped(const JsonNode& entry, ShapedParameters& shaped, Scene& scene) {
    if (const auto v = entry.find("diffuseFunction")) shaped.diffuseFunction = functionIndex(*v, scene);
    if (const auto v = entry.find("specularFunction")) shaped.specularFunction = functionIndex(*v, scene);
    if (const auto v = entry.find("kd")) shaped.kd = float(v->number(0));
    if (const auto v = entry.find("ks")) shaped.ks = float(v->number(0));
    if (const auto v = entry.find("specularColor")) shaped.specularColor = color(*v);
    if (const auto v = entry.find("specularBlend")) shaped.specularBlend = float(v->number(0, 1));
    if (const auto v = entry.find("kAmbient")) shaped.kAmbient = v->isNumber() ? vec3(float(v->number(0))) : color(*v);
    if (const auto v = entry.find("kEmissive")) shaped.kEmissive = float(v->number(0));
}

void setEquation(const JsonNode& entry, Material& material, Scene& scene) {
    const LightEquation before = material.equation;
    if (const auto v = entry.find("equation")) {
        material.equation = LightEquation(v->choice({"metallicRoughness", "shaped", "unlit"}));
    }
    if (material.equation == LightEquation::shaped) {
        if (before != LightEquation::shaped) {
            material.shaped = {};
            if (!entry.find("diffuseFunction"))
                material.shaped.diffuseFunction = *namedFunction("lambert", entry, scene);
            if (!entry.find("specularFunction"))
                material.shaped.specularFunction = *namedFunction("blinnPhong", entry, scene);
        }
        setShaped(entry, material.shaped, scene);
        return;
    }
    for (const std::string_view key : std::span(kMaterialKeys).last(kShapedKeys)) {
        if (const auto v = entry.find(key)) {
            v->failWith(
                fmt::format("only for the equation \"shaped\", which material \"{}\" does not have", material.name));
        }
    }
}

void setMaterial(const JsonNode& entry, Material& material, Scene& scene) {
    setEquation(entry, material, scene);
    if (const auto v = entry.find("surface")) {
        material.surface = SurfaceShader(v->choice({"textured", "checker", "marble"}));
    }
    if (const auto v = entry.find("proceduralColor")) material.proceduralColor = color(*v);
    if (const auto v = entry.find("proceduralScale")) material.proceduralScale = float(v->positiveNumber());
    if (const auto v = entry.find("baseColor")) material.baseColor = baseColor(*v, material.baseColor);
    if (const auto v = entry.find("metallic")) material.metallic = float(v->number(0, 1));
    if (const auto v = entry.find("roughness")) material.roughness = float(v->number(0, 1));
    if (const auto v = entry.find("emissive")) material.emissive = color(*v);
    if (const auto v = entry.find("normalScale")) material.normalScale = float(v->number());
    if (const auto v = entry.find("occlusionStrength")) material.occlusionStrength = float(v->number(0, 1));
    if (const auto v = entry.find("doubleSided")) material.doubleSided = v->boolean();
    if (const auto v = entry.find("castsShadows")) material.castsShadows = v->boolean();
    if (const auto v = entry.find("alphaMode")) material.alphaMode = AlphaMode(v->choice({"opaque", "mask", "blend"}));
    if (const auto v = entry.find("alphaCutoff")) material.alphaCutoff = float(v->number(0));
}

/// Changes what the file or an earlier rig made.
void changeMaterials(const JsonNode& entry, Scene& scene) {
    entry.expectKeys({"match"}, kMaterialKeys);
    for (const size_t i : select(entry.at("match"), "material", scene.materials)) {
        setMaterial(entry, scene.materials[i], scene);
    }
}

Material startingPoint(const JsonNode& entry, const Scene& scene) {
    const auto source = entry.find("copyOf");
    if (!source) return {.metallic = 0};
    const size_t index = indexOf(scene.materials, source->string());
    if (index < scene.materials.size()) return scene.materials[index];
    source->fail(fmt::format("the name of a material ({})", someNames(scene.materials)));
}

/// Makes a material, or makes it anew, and gives it to objects.
void makeMaterial(const JsonNode& entry, Scene& scene) {
    entry.expectKeys({"name", "copyOf", "assignTo"}, kMaterialKeys);
    Material material = startingPoint(entry, scene);
    material.name = entry.at("name").string();
    setMaterial(entry, material, scene);

    const size_t index = indexOf(scene.materials, material.name);
    if (index < scene.materials.size()) {
        scene.materials[index] = std::move(material);
    } else if (index < kMaxMaterials) {
        scene.materials.push_back(std::move(material));
    } else {
        throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} materials in the scene, got {}",
                                                  entry.where(), kMaxMaterials, kMaxMaterials + 1));
    }
    if (const auto patterns = entry.find("assignTo")) {
        for (const size_t i : select(*patterns, "object", scene.objects)) scene.objects[i].material = uint32_t(index);
    }
}

}  // namespace

void applyMaterials(const JsonNode& list, Scene& scene) {
    for (const JsonNode& entry : list.elements()) {
        if (entry.find("match")) {
            changeMaterials(entry, scene);
        } else {
            makeMaterial(entry, scene);
        }
    }
}

}  // namespace luciole::rig
