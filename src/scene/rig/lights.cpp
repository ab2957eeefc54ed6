#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <luciole/error.hpp>

#include "scene/rig/scatter.hpp"
#include "scene/rig/sections.hpp"
#include "scene/rig/values.hpp"

namespace luciole::rig {
namespace {

constexpr std::array<std::string_view, 19> kLightKeys{"type",           "position",       "direction",    "target",
                                                      "color",          "intensity",      "range",        "innerConeAngle",
                                                      "outerConeAngle", "attenuation",    "falloff",      "contribution",
                                                      "infiniteViewer", "linkGroup",      "volume",       "name",
                                                      "castsShadows",   "shadowSoftness", "shadowResolution"};

LightType lightType(const JsonNode& node) { return LightType(node.choice({"directional", "point", "spot"})); }

void setColor(const JsonNode& entry, Light& light) {
    std::optional<vec3> newColor;
    std::optional<double> newIntensity;
    if (const auto v = entry.find("color")) newColor = color(*v);
    if (const auto v = entry.find("intensity")) newIntensity = v->number(0);
    recolor(light, newColor, newIntensity, entry);
}

void setPlace(const JsonNode& entry, Light& light) {
    if (const auto v = entry.find("position")) light.positionWorld = v->vector3();
    const auto target = entry.find("target");
    if (const auto v = entry.find("direction")) {
        if (target) target->failWith("expected either a direction or a target, got both");
        light.directionWorld = direction(*v);
    } else if (target) {
        const dvec3 towards = dvec3(target->vector3()) - dvec3(light.positionWorld);
        if (!(glm::length(towards) > 0)) target->fail("a place other than the light's position");
        light.directionWorld = vec3(glm::normalize(towards));
    }
}

void setCone(const JsonNode& entry, Light& light) {
    const auto inner = entry.find("innerConeAngle");
    const auto outer = entry.find("outerConeAngle");
    if (inner) light.innerConeAngle = float(glm::radians(inner->number(0, 180)));
    if (outer) light.outerConeAngle = float(glm::radians(outer->number(0, 180)));
    if ((inner || outer) && !(light.innerConeAngle < light.outerConeAngle)) {
        entry.failWith(fmt::format("expected innerConeAngle < outerConeAngle, got {:.6g} and {:.6g} degrees",
                                   glm::degrees(light.innerConeAngle), glm::degrees(light.outerConeAngle)));
    }
}

/// A function, or null for what glTF does.
void setFunction(const JsonNode& entry, std::string_view key, uint32_t& function, Scene& scene) {
    if (const auto v = entry.find(key)) function = v->isNull() ? kNone : functionIndex(*v, scene);
}

/// Index of the element of this name, or kNone for null.
template <typename Named>
uint32_t indexOrNone(const JsonNode& node, std::string_view noun, const std::vector<Named>& list) {
    if (node.isNull()) return kNone;
    const size_t index = indexOf(list, node.string());
    if (index == list.size()) node.fail(fmt::format("the name of a {} ({})", noun, someNames(list)));
    return uint32_t(index);
}

void setLight(const JsonNode& entry, Light& light, Scene& scene) {
    if (const auto v = entry.find("name")) light.name = v->string();
    if (const auto v = entry.find("type")) light.type = lightType(*v);
    setPlace(entry, light);
    setColor(entry, light);
    if (const auto v = entry.find("range")) {
        light.range = v->isNull() ? std::numeric_limits<float>::infinity() : float(v->positiveNumber());
    }
    setCone(entry, light);
    setFunction(entry, "attenuation", light.attenuation, scene);
    setFunction(entry, "falloff", light.falloff, scene);
    if (const auto v = entry.find("contribution")) {
        light.contribution = LightContribution(v->choice({"diffuseAndSpecular", "diffuseOnly", "specularOnly"}));
    }
    if (const auto v = entry.find("infiniteViewer")) light.infiniteViewer = v->boolean();
    if (const auto v = entry.find("linkGroup")) light.linkGroup = indexOrNone(*v, "link group", scene.linkGroups);
    if (const auto v = entry.find("volume")) light.volume = indexOrNone(*v, "light volume", scene.lightVolumes);
    if (const auto v = entry.find("castsShadows")) light.castsShadows = v->boolean();
    if (const auto v = entry.find("shadowSoftness")) light.shadowSoftness = float(v->number(0, 4));
    if (const auto v = entry.find("shadowResolution")) light.shadowResolution = float(v->number(1.0 / 16, 16));
}

/// An attenuation function is read at distance / range.
void expectRange(const JsonNode& entry, const Light& light) {
    if (light.type != LightType::directional && light.attenuation != kNone && std::isinf(light.range)) {
        entry.failWith(
            fmt::format("expected a range, as light \"{}\" has an attenuation function, got none", light.name));
    }
}

void expectRoom(const JsonNode& entry, const Scene& scene, uint64_t more, const LoadLimits& limits) {
    if (scene.lights.size() + more > limits.maxElements) {
        throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} lights in the scene, got {}", entry.where(),
                                                  limits.maxElements, scene.lights.size() + more));
    }
}

void addScattered(const JsonNode& entry, const JsonNode& node, Scene& scene, const LoadLimits& limits) {
    if (const auto position = entry.find("position"))
        position->failWith("a scattered light takes its position from `scatter`");
    if (entry.at("type").string() == "directional") node.failWith("a directional light has no place to scatter");
    Scatter scatter(node, scene);
    expectRoom(entry, scene, scatter.count(), limits);
    for (uint32_t i = 0; i < scatter.count(); ++i) {
        Light light{.name = "light", .positionWorld = scatter.place(i)};
        setLight(entry, light, scene);
        light.name += fmt::format(" {}", i);
        scatter.vary(light);
        expectRange(entry, light);
        scene.lights.push_back(std::move(light));
    }
}

/// One new light, or many from one entry.
void addLights(const JsonNode& entry, Scene& scene, const LoadLimits& limits) {
    entry.expectKeys({"scatter"}, kLightKeys);
    const auto type = lightType(entry.at("type"));
    if (type != LightType::point && !entry.find("target")) entry.at("direction");
    if (const auto scatter = entry.find("scatter")) {
        addScattered(entry, *scatter, scene, limits);
        return;
    }
    if (type != LightType::directional) entry.at("position");
    expectRoom(entry, scene, 1, limits);
    Light light;
    setLight(entry, light, scene);
    expectRange(entry, light);
    scene.lights.push_back(std::move(light));
}

void changeLights(const JsonNode& entry, Scene& scene) {
    entry.expectKeys({"match", "intensityScale"}, kLightKeys);
    for (const size_t i : select(entry.at("match"), "light", scene.lights)) {
        Light& light = scene.lights[i];
        setLight(entry, light, scene);
        if (const auto v = entry.find("intensityScale")) light.color *= float(v->number(0));
        expectRange(entry, light);
    }
}

void removeLights(const JsonNode& entry, Scene& scene) {
    entry.expectKeys({"remove"});
    std::vector<Light> kept;
    const std::vector<size_t> removed = select(entry.at("remove"), "light", scene.lights);
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        if (!std::binary_search(removed.begin(), removed.end(), i)) kept.push_back(std::move(scene.lights[i]));
    }
    scene.lights = std::move(kept);
}

}  // namespace

void applyLights(const JsonNode& list, Scene& scene, const LoadLimits& limits) {
    for (const JsonNode& entry : list.elements()) {
        if (entry.find("remove")) {
            removeLights(entry, scene);
        } else if (entry.find("match")) {
            changeLights(entry, scene);
        } else {
            addLights(entry, scene, limits);
        }
    }
}

}  // namespace luciole::rig
