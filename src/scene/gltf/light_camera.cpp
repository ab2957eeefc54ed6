#include "scene/gltf/light_camera.hpp"

#include <cfloat>
#include <cmath>

namespace luciole::gltf {

namespace {

bool fitsFloat(const dvec3& v) {
    return std::abs(v.x) <= double(FLT_MAX) && std::abs(v.y) <= double(FLT_MAX) && std::abs(v.z) <= double(FLT_MAX);
}

void readCone(const JsonNode& json, Light& light) {
    const auto spot = json.find("spot");
    if (!spot) json.failWith("expected a key \"spot\", got none");
    constexpr float kHalfPi = float(kPi / 2);
    // As floats, since exporters write pi / 2 with a float's digits, which can be above it.
    const auto outer = spot->find("outerConeAngle");
    light.outerConeAngle = outer ? float(outer->positiveNumber()) : float(kPi / 4);
    if (light.outerConeAngle > kHalfPi) outer->fail("an angle of at most pi / 2");
    const auto inner = spot->find("innerConeAngle");
    light.innerConeAngle = inner ? float(inner->number(0)) : 0.0f;
    if (light.innerConeAngle > light.outerConeAngle) {
        inner->fail(fmt::format("at most the outerConeAngle of {}", light.outerConeAngle));
    }
    // Equal angles, a hard edge, are what exporters write for "no blend"; the extension asks for less.
    if (light.innerConeAngle == light.outerConeAngle) light.innerConeAngle = std::nextafter(light.outerConeAngle, 0.0f);
}

/// Nearest rotation that keeps the direction of -Z and has Y in the plane of the node's own Y and Z.
std::optional<dmat4> rigid(const dmat4& m) {
    if (!isInvertible(m)) return std::nullopt;
    const dvec3 z = glm::normalize(dvec3(m[2]));
    const dvec3 y = glm::normalize(dvec3(m[1]) - z * glm::dot(z, dvec3(m[1])));
    return dmat4(dvec4(glm::cross(y, z), 0), dvec4(y, 0), dvec4(z, 0), m[3]);
}

}  // namespace

std::optional<Light> readLight(const JsonNode& root, const JsonNode& reference, const PlacedNode& node,
                               Warnings& warnings) {
    const auto lists = extension(root, "KHR_lights_punctual");
    if (!lists) reference.fail("no reference to a light, as the file has none");
    const JsonNode json = resolve(*lists, "lights", reference);
    Light light;
    light.name = node.name;
    constexpr LightType kTypes[]{LightType::directional, LightType::point, LightType::spot};
    light.type = kTypes[json.at("type").choice({"directional", "point", "spot"})];
    const dvec3 color = vectorOr<3>(json, "color", dvec3(1), 0) * numberOr(json, "intensity", 1, 0);
    light.color = glm::min(color, dvec3(JsonNode::kMost));
    if (const auto range = json.find("range")) light.range = float(range->positiveNumber());
    if (light.type == LightType::spot) readCone(json, light);

    const dvec3 position(node.worldFromNode[3]);
    const dvec3 axis = -dvec3(node.worldFromNode[2]);
    const bool placed = light.type == LightType::directional || fitsFloat(position);
    const bool aimed = light.type == LightType::point || (fitsFloat(axis) && glm::length(axis) > 0);
    if (!placed || !aimed) {
        warnings.add(fmt::format("{} \"{}\": its matrix gives the light no place or direction; left out",
                                 node.json.path(), node.name));
        return std::nullopt;
    }
    if (light.type != LightType::directional) light.positionWorld = position;
    if (light.type != LightType::point) light.directionWorld = axis / glm::length(axis);
    return light;
}

std::optional<Camera> readCamera(const JsonNode& root, const JsonNode& reference, const PlacedNode& node,
                                 Warnings& warnings) {
    const JsonNode json = resolve(root, "cameras", reference);
    Camera camera;
    camera.name = node.name;
    camera.orthographic = json.at("type").choice({"perspective", "orthographic"}) == 1;
    if (camera.orthographic) {
        const JsonNode lens = json.at("orthographic");
        camera.halfHeight = float(lens.at("ymag").positiveNumber());
        camera.zNear = float(lens.at("znear").number(0));
        camera.zFar = float(lens.at("zfar").positiveNumber());
        if (camera.zFar <= camera.zNear) lens.at("zfar").fail(fmt::format("more than the znear of {}", camera.zNear));
    } else {
        const JsonNode lens = json.at("perspective");
        camera.yFov = float(lens.at("yfov").positiveNumber());
        if (camera.yFov >= float(kPi)) lens.at("yfov").fail("an angle below pi");
        camera.zNear = float(lens.at("znear").positiveNumber());
        if (camera.zNear < kLeastNear) {
            warnings.add(fmt::format("{} \"{}\": its znear of {} is taken as {}", node.json.path(), node.name, camera.zNear, kLeastNear));
            camera.zNear = kLeastNear;
        }
    }
    const auto worldFromView = rigid(node.worldFromNode);
    if (!worldFromView) {
        warnings.add(fmt::format("{} \"{}\": its matrix can't be inverted; the camera is left out", node.json.path(),
                                 node.name));
        return std::nullopt;
    }
    camera.worldFromView = mat4(*worldFromView);
    return camera;
}

}  // namespace luciole::gltf
