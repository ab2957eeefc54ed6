#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <luciole/error.hpp>
#include <luciole/scene.hpp>

#include "scene/light_volume.hpp"

namespace luciole {
namespace {

constexpr float kUnitTolerance = 1e-3f;  // files store directions with few digits; more than this is not a rounding

bool isFinite(float v) { return std::isfinite(v); }
template <int N>
bool isFinite(const glm::vec<N, float>& v) {
    for (int i = 0; i < N; ++i) {
        if (!std::isfinite(v[i])) return false;
    }
    return true;
}
bool isFinite(const mat4& m) { return isFinite(m[0]) && isFinite(m[1]) && isFinite(m[2]) && isFinite(m[3]); }

bool isUnit(vec3 v) { return std::abs(glm::length(v) - 1) <= kUnitTolerance; }
bool isNonNegative(vec3 v) { return v.x >= 0 && v.y >= 0 && v.z >= 0; }

/// Rotation and translation only.
bool isRigid(const mat4& m) {
    const vec3 x(m[0]), y(m[1]), z(m[2]);
    const auto perpendicular = [](vec3 a, vec3 b) { return std::abs(glm::dot(a, b)) <= kUnitTolerance; };
    const bool lastRow = m[0].w == 0 && m[1].w == 0 && m[2].w == 0 && m[3].w == 1;
    return lastRow && isUnit(x) && isUnit(y) && isUnit(z) && perpendicular(x, y) && perpendicular(y, z) &&
           perpendicular(z, x) && glm::dot(glm::cross(x, y), z) > 0;
}

std::string print(float v) { return fmt::format("{}", v); }
std::string print(vec2 v) { return fmt::format("({}, {})", v.x, v.y); }
std::string print(vec3 v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }
std::string print(vec4 v) { return fmt::format("({}, {}, {}, {})", v.x, v.y, v.z, v.w); }
std::string print(const mat4& m) {
    return fmt::format("columns {} {} {} {}", print(m[0]), print(m[1]), print(m[2]), print(m[3]));
}

/// One element of the scene under test: `lights[3] "lamp"`. Text is made only when a rule is broken.
class Element {
public:
    Element(std::string_view list, size_t index, std::string_view name) : list_(list), index_(index), name_(name) {}
    explicit Element(std::string_view single) : list_(single) {}

    [[noreturn]] void fail(std::string_view field, std::string_view expected, std::string_view got) const {
        const std::string index = index_ == kSingle ? "" : fmt::format("[{}]", index_);
        const std::string name = name_.empty() ? "" : fmt::format(" \"{}\"", name_);
        throw Error(ErrorKind::scene,
                    fmt::format("{}{}{}: {}: expected {}, got {}", list_, index, name, field, expected, got));
    }
    template <typename T>
    void expect(bool rule, std::string_view field, std::string_view expected, const T& got) const {
        if (!rule) fail(field, expected, print(got));
    }
    template <typename T>
    void finite(std::string_view field, const T& got) const {
        expect(isFinite(got), field, "finite numbers", got);
    }
    void unit(std::string_view field, vec3 got) const { expect(isUnit(got), field, "unit length", got); }
    void atLeastZero(std::string_view field, float got) const {
        expect(got >= 0 && isFinite(got), field, "a finite number >= 0", got);
    }
    void atLeastZero(std::string_view field, vec3 got) const {
        expect(isNonNegative(got) && isFinite(got), field, "finite numbers >= 0", got);
    }
    void within(std::string_view field, float got, float low, float high) const {
        if (!(got >= low && got <= high)) fail(field, fmt::format("[{}, {}]", low, high), print(got));
    }
    void index(std::string_view field, size_t got, size_t size) const {
        if (got >= size) fail(field, fmt::format("an index below {}", size), fmt::format("{}", got));
    }
    void optionalIndex(std::string_view field, uint32_t got, size_t size) const {
        if (got != kNone) index(field, got, size);
    }

private:
    static constexpr size_t kSingle = ~size_t(0);
    std::string_view list_;
    size_t index_ = kSingle;
    std::string_view name_;
};

void checkLimit(std::string_view list, size_t count, size_t limit) {
    if (count > limit)
        throw Error(ErrorKind::limit, fmt::format("{}: expected at most {}, got {}", list, limit, count));
}

void checkVertex(const Element& element, size_t i, const Vertex& v) {
    const auto field = [i](std::string_view name) { return fmt::format("vertices[{}].{}", i, name); };
    if (!isFinite(v.position)) element.fail(field("position"), "finite numbers", print(v.position));
    if (!isUnit(v.normal)) element.fail(field("normal"), "unit length", print(v.normal));
    if (!isUnit(vec3(v.tangent))) element.fail(field("tangent"), "unit length", print(v.tangent));
    if (std::abs(v.tangent.w) != 1) element.fail(field("tangent.w"), "1 or -1", print(v.tangent.w));
    if (!isFinite(v.uv0)) element.fail(field("uv0"), "finite numbers", print(v.uv0));
    if (!isFinite(v.uv1)) element.fail(field("uv1"), "finite numbers", print(v.uv1));
    if (!isFinite(v.color)) element.fail(field("color"), "finite numbers", print(v.color));
}

void checkMesh(const Element& element, const Mesh& mesh) {
    for (size_t i = 0; i < mesh.vertices.size(); ++i) checkVertex(element, i, mesh.vertices[i]);
    if (mesh.indices.size() % 3 != 0) {
        element.fail("indices", "a multiple of 3", fmt::format("{}", mesh.indices.size()));
    }
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        if (mesh.indices[i] >= mesh.vertices.size()) {
            element.index(fmt::format("indices[{}]", i), mesh.indices[i], mesh.vertices.size());
        }
    }
}

void checkObject(const Element& element, const Object& object, const Scene& scene) {
    element.index("mesh", object.mesh, scene.meshes.size());
    element.index("material", object.material, scene.materials.size());
    element.finite("worldFromObject", object.worldFromObject);
}

void checkTexels(const Element& element, const Texels& texels) {
    const uint64_t expected = uint64_t(texels.width) * texels.height;
    if (expected == 0 || texels.rgba.size() / 4 != expected || texels.rgba.size() % 4 != 0) {
        element.fail("rgba", fmt::format("{} x {} x 4 bytes, at least one texel", texels.width, texels.height),
                     fmt::format("{}", texels.rgba.size()));
    }
}

void checkTextureUse(const Element& element, std::string_view field, const TextureUse& use, const Scene& scene) {
    element.optionalIndex(field, use.texture, scene.textures.size());
    if (use.uvSet > 1) element.fail(fmt::format("{}.uvSet", field), "0 or 1", fmt::format("{}", use.uvSet));
    for (const vec3& row : use.uvTransform) {
        if (!isFinite(row)) element.fail(fmt::format("{}.uvTransform", field), "finite numbers", print(row));
    }
}

void checkFunction(const Element& element, const Function& function) {
    const float p = function.parameter;
    switch (function.kind) {
        case Function::Kind::lambert:
            break;
        case Function::Kind::wrap:
            element.within("parameter", p, 0, 1);
            break;
        case Function::Kind::orenNayar:
        case Function::Kind::blinnPhong:
            element.atLeastZero("parameter", p);
            break;
        case Function::Kind::constant:
            element.finite("parameter", p);
            break;
        case Function::Kind::toon:
            element.expect(p >= 1 && isFinite(p) && p == std::floor(p), "parameter", "a whole number >= 1", p);
            break;
        case Function::Kind::sampled:
            if (function.samples.size() < 2) {
                element.fail("samples", "at least 2", fmt::format("{}", function.samples.size()));
            }
            for (const vec2& sample : function.samples) element.finite("samples", sample);
            break;
    }
}

void checkShaped(const Element& element, const ShapedParameters& shaped, const Scene& scene) {
    element.index("shaped.diffuseFunction", shaped.diffuseFunction, scene.functions.size());
    element.index("shaped.specularFunction", shaped.specularFunction, scene.functions.size());
    element.finite("shaped.specularColor", shaped.specularColor);
    element.atLeastZero("shaped.kd", shaped.kd);
    element.atLeastZero("shaped.ks", shaped.ks);
    element.within("shaped.specularBlend", shaped.specularBlend, 0, 1);
    element.atLeastZero("shaped.kAmbient", shaped.kAmbient);
    element.atLeastZero("shaped.kEmissive", shaped.kEmissive);
}

void checkMaterial(const Element& element, const Material& material, const Scene& scene) {
    element.finite("alphaCutoff", material.alphaCutoff);
    element.finite("baseColor", material.baseColor);
    element.finite("metallic", material.metallic);
    element.finite("roughness", material.roughness);
    element.finite("emissive", material.emissive);
    element.finite("normalScale", material.normalScale);
    element.finite("occlusionStrength", material.occlusionStrength);
    checkTextureUse(element, "baseColorTexture", material.baseColorTexture, scene);
    checkTextureUse(element, "metallicRoughnessTexture", material.metallicRoughnessTexture, scene);
    checkTextureUse(element, "normalTexture", material.normalTexture, scene);
    checkTextureUse(element, "occlusionTexture", material.occlusionTexture, scene);
    checkTextureUse(element, "emissiveTexture", material.emissiveTexture, scene);
    if (material.equation == LightEquation::shaped) checkShaped(element, material.shaped, scene);
    if (material.surface != SurfaceShader::textured) {
        element.finite("proceduralColor", material.proceduralColor);
        const float scale = material.proceduralScale;
        element.expect(scale > 0 && isFinite(scale), "proceduralScale", "a finite number > 0", scale);
    }
}

void checkLight(const Element& element, const Light& light, const Scene& scene) {
    const bool placed = light.type != LightType::directional;
    const bool aimed = light.type != LightType::point;
    if (placed) element.finite("positionWorld", light.positionWorld);
    if (aimed) element.unit("directionWorld", light.directionWorld);
    element.atLeastZero("color", light.color);
    element.expect(light.range > 0, "range", "> 0", light.range);
    if (light.type == LightType::spot) {
        element.expect(light.outerConeAngle > 0 && light.outerConeAngle <= float(kPi), "outerConeAngle", "(0, pi]",
                       light.outerConeAngle);
        element.expect(light.innerConeAngle >= 0 && light.innerConeAngle < light.outerConeAngle, "innerConeAngle",
                       "[0, outerConeAngle)", light.innerConeAngle);
    }
    element.optionalIndex("attenuation", light.attenuation, scene.functions.size());
    if (placed && light.attenuation != kNone) {
        element.expect(isFinite(light.range), "range", "finite, as the light has an attenuation function", light.range);
        // Calver 2003, "Shaped Lights": the last texel should be 0, or the light ends in a hard edge.
        const auto last = float(evaluate(scene.functions[light.attenuation], 1, 0).x);
        element.expect(last == 0, "attenuation", "a function that is 0 at 1, the range's end (such as linear or smooth)", last);
    }
    element.optionalIndex("falloff", light.falloff, scene.functions.size());
    element.optionalIndex("linkGroup", light.linkGroup, scene.linkGroups.size());
    element.within("shadowSoftness", light.shadowSoftness, 0, 4);
    element.within("shadowResolution", light.shadowResolution, 1.0f / 16, 16);
    element.optionalIndex("volume", light.volume, scene.lightVolumes.size());
}

void checkVolume(const Element& element, const LightVolume& volume) {
    if (const auto fault = faultOf(volume)) element.fail(fault->field, fault->expected, fault->got);
}

void checkCamera(const Element& element, const Camera& camera) {
    element.finite("worldFromView", camera.worldFromView);
    element.expect(isRigid(camera.worldFromView), "worldFromView", "rotation and translation only",
                   camera.worldFromView);
    // Embree refuses rays that start 1e18 and more from the origin.
    const float distance = length(vec3(camera.worldFromView[3]));
    element.expect(distance <= 1e17f, "worldFromView", "at most 1e17 m from the origin", distance);
    if (!camera.orthographic) {
        element.expect(camera.yFov >= 1e-4f && camera.yFov < float(kPi), "yFov", "[0.0001, pi)", camera.yFov);
        element.expect(camera.zNear >= kLeastNear && isFinite(camera.zNear), "zNear", "a finite number >= 1e-18", camera.zNear);
        return;
    }
    element.expect(camera.halfHeight > 0 && isFinite(camera.halfHeight), "halfHeight", "a finite number > 0",
                   camera.halfHeight);
    element.atLeastZero("zNear", camera.zNear);
    element.expect(camera.zFar > camera.zNear && isFinite(camera.zFar), "zFar", "a finite number > zNear", camera.zFar);
}

template <typename Elements, typename Check>
void forEach(std::string_view list, const Elements& elements, const Check& check) {
    for (size_t i = 0; i < elements.size(); ++i) check(Element(list, i, elements[i].name), elements[i]);
}

void checkLimits(const Scene& scene) {
    checkLimit("materials", scene.materials.size(), kMaxMaterials);
    checkLimit("functions", scene.functions.size(), kMaxFunctions);
    checkLimit("linkGroups", scene.linkGroups.size(), kMaxLinkGroups);
    for (size_t i = 0; i < scene.lightVolumes.size(); ++i) {
        const LightVolume& volume = scene.lightVolumes[i];
        if (volume.indices.size() / 3 > kMaxVolumeTriangles) {
            checkLimit(fmt::format("lightVolumes[{}] \"{}\": triangles", i, volume.name), volume.indices.size() / 3,
                       kMaxVolumeTriangles);
        }
    }
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        if (scene.objects[i].objectId > kMaxObjectId) {
            checkLimit(fmt::format("objects[{}] \"{}\": objectId", i, scene.objects[i].name), scene.objects[i].objectId,
                       kMaxObjectId);
        }
    }
}

}  // namespace

void validate(const Scene& scene) {
    checkLimits(scene);
    forEach("meshes", scene.meshes, checkMesh);
    forEach("objects", scene.objects, [&](const Element& e, const Object& o) { checkObject(e, o, scene); });
    forEach("texels", scene.texels, checkTexels);
    for (size_t i = 0; i < scene.textures.size(); ++i) {
        Element("textures", i, "").index("texels", scene.textures[i].texels, scene.texels.size());
    }
    forEach("functions", scene.functions, checkFunction);
    forEach("materials", scene.materials, [&](const Element& e, const Material& m) { checkMaterial(e, m, scene); });
    forEach("lightVolumes", scene.lightVolumes, checkVolume);
    validate(scene.lights, scene);
    forEach("cameras", scene.cameras, checkCamera);
    const Element ambience("ambience");
    ambience.finite("sky", scene.ambience.sky);
    ambience.finite("ground", scene.ambience.ground);
    ambience.unit("upWorld", scene.ambience.upWorld);
    Element("scene").finite("exposureEv", scene.exposureEv);
}

void validate(std::span<const Light> lights, const Scene& scene) {
    forEach("lights", lights, [&](const Element& e, const Light& l) { checkLight(e, l, scene); });
}

void validate(const Camera& camera) { checkCamera(Element("camera"), camera); }

}  // namespace luciole
