#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <luciole/error.hpp>
#include <luciole/output.hpp>
#include <luciole/scene_io.hpp>
#include <nlohmann/json.hpp>

#include "io/image_codec.hpp"

namespace luciole {

namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "GLB stores little-endian numbers, and so do we");

constexpr int kFloat = 5126, kUint16 = 5123, kUint32 = 5125;  // glTF 2.0 section 3.6.2.2
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;

/// Counts what glTF can't say, so that a thousand lights make one line.
class Losses {
public:
    void add(const std::string& what, const std::string& name) {
        auto& [count, first] = entries_[what];
        if (count++ == 0) first = name;
    }
    std::vector<std::string> lines() const {
        std::vector<std::string> lines;
        for (const auto& [what, entry] : entries_)
            lines.push_back(entry.first == 1
                                ? fmt::format("{}: \"{}\"", what, entry.second)
                                : fmt::format("{}: {} of them, \"{}\" the first", what, entry.first, entry.second));
        return lines;
    }

private:
    std::map<std::string, std::pair<uint64_t, std::string>> entries_;
};

template <int N>
Json toJson(const glm::vec<N, float>& v) {
    Json json = Json::array();
    for (int i = 0; i < N; ++i) json.push_back(v[i]);
    return json;
}

Json toJson(const mat4& m) {
    Json json = Json::array();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) json.push_back(m[column][row]);
    return json;
}

/// The least power of two that is at least 1 and no channel of `color` exceeds: dividing by it is exact.
float exactScale(vec3 color) {
    const float largest = std::max({color.r, color.g, color.b});
    return largest <= 1 ? 1.0f : std::exp2(std::ceil(std::log2(largest)));
}

/// The BIN chunk and the buffer views and accessors that cut it up.
class Binary {
public:
    Json views = Json::array(), accessors = Json::array();

    size_t addView(std::span<const std::byte> bytes, std::optional<int> target) {
        Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}};
        if (target) view["target"] = *target;
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        views.push_back(std::move(view));
        return views.size() - 1;
    }

    template <class T>
    size_t addAccessor(const std::vector<T>& values, const char* type, int componentType, int target) {
        const size_t view = addView(std::as_bytes(std::span(values)), target);
        accessors.push_back(
            {{"bufferView", view}, {"componentType", componentType}, {"count", values.size()}, {"type", type}});
        return accessors.size() - 1;
    }

    const std::vector<std::byte>& bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
};

/// What the materials' textures read has to be there, be it all zero.
uint32_t uvSetsUsed(const Scene& scene) {
    uint32_t used = 0;
    for (const Material& m : scene.materials)
        for (const TextureUse* use : {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture,
                                      &m.occlusionTexture, &m.emissiveTexture})
            if (use->texture != kNone) used = std::max(used, use->uvSet + 1);
    return used;
}

class Writer {
public:
    explicit Writer(const Scene& scene) : scene_(scene), uvSetsUsed_(uvSetsUsed(scene)) {}

    std::vector<std::byte> write();
    Losses losses;

private:
    /// Accessors of a Mesh, shared by all glTF meshes that show it with different materials.
    const Json& primitiveOf(uint32_t mesh);
    template <class Member>
    void addAttribute(Json& attributes, const char* semantic, const Mesh& mesh, Member member, const char* type);
    void addIndices(Json& primitive, const Mesh& mesh);
    size_t gltfMesh(uint32_t mesh, uint32_t material);

    void addNode(Json node) {
        sceneNodes_.push_back(nodes_.size());
        nodes_.push_back(std::move(node));
    }
    void addObjects();
    void addCameras();
    void addLights();
    Json light(const Light& light);
    void addMaterials();
    Json material(const Material& material);
    Json textureInfo(const TextureUse& use, const std::string& materialName);
    void addTextures();
    void reportRest();
    Json document();

    const Scene& scene_;
    const uint32_t uvSetsUsed_;
    Binary binary_;
    std::map<uint32_t, Json> primitives_;
    std::map<std::pair<uint32_t, uint32_t>, size_t> meshIndices_;
    std::set<std::string> extensions_;
    Json meshes_ = Json::array(), nodes_ = Json::array(), sceneNodes_ = Json::array(), cameras_ = Json::array();
    Json lights_ = Json::array(), materials_ = Json::array();
    Json images_ = Json::array(), textures_ = Json::array(), samplers_ = Json::array();
};

template <class Member>
void Writer::addAttribute(Json& attributes, const char* semantic, const Mesh& mesh, Member member, const char* type) {
    std::vector<std::remove_cvref_t<decltype(std::declval<Vertex>().*member)>> values;
    values.reserve(mesh.vertices.size());
    for (const Vertex& vertex : mesh.vertices) values.push_back(vertex.*member);
    attributes[semantic] = binary_.addAccessor(values, type, kFloat, kArrayBuffer);
}

/// 16 bits where they do: 65535 itself is taken by primitive restart.
void Writer::addIndices(Json& primitive, const Mesh& mesh) {
    if (mesh.vertices.size() <= 65535) {
        std::vector<uint16_t> narrow(mesh.indices.size());
        std::ranges::transform(mesh.indices, narrow.begin(), [](uint32_t i) { return uint16_t(i); });
        primitive["indices"] = binary_.addAccessor(narrow, "SCALAR", kUint16, kElementArrayBuffer);
    } else {
        primitive["indices"] = binary_.addAccessor(mesh.indices, "SCALAR", kUint32, kElementArrayBuffer);
    }
}

const Json& Writer::primitiveOf(uint32_t index) {
    const auto [entry, isNew] = primitives_.try_emplace(index);
    if (!isNew) return entry->second;
    const Mesh& mesh = scene_.meshes[index];
    const auto differs = [&](auto member) {
        return std::ranges::any_of(mesh.vertices, [&](const Vertex& v) { return v.*member != Vertex{}.*member; });
    };
    Json attributes;
    addAttribute(attributes, "POSITION", mesh, &Vertex::position, "VEC3");
    vec3 low = mesh.vertices.front().position, high = low;
    for (const Vertex& vertex : mesh.vertices) {
        low = glm::min(low, vertex.position);
        high = glm::max(high, vertex.position);
    }
    binary_.accessors.back()["min"] = toJson(low);
    binary_.accessors.back()["max"] = toJson(high);
    addAttribute(attributes, "NORMAL", mesh, &Vertex::normal, "VEC3");
    if (differs(&Vertex::tangent)) addAttribute(attributes, "TANGENT", mesh, &Vertex::tangent, "VEC4");
    const bool hasUv1 = uvSetsUsed_ > 1 || differs(&Vertex::uv1);
    // UV sets are numbered without gaps.
    if (hasUv1 || uvSetsUsed_ > 0 || differs(&Vertex::uv0))
        addAttribute(attributes, "TEXCOORD_0", mesh, &Vertex::uv0, "VEC2");
    if (hasUv1) addAttribute(attributes, "TEXCOORD_1", mesh, &Vertex::uv1, "VEC2");
    if (differs(&Vertex::color)) addAttribute(attributes, "COLOR_0", mesh, &Vertex::color, "VEC4");
    entry->second["attributes"] = std::move(attributes);
    addIndices(entry->second, mesh);
    return entry->second;
}

size_t Writer::gltfMesh(uint32_t mesh, uint32_t material) {
    const auto [entry, isNew] = meshIndices_.try_emplace({mesh, material}, meshes_.size());
    if (isNew) {
        Json primitive = primitiveOf(mesh);
        primitive["material"] = material;
        meshes_.push_back({{"name", scene_.meshes[mesh].name}, {"primitives", Json::array({std::move(primitive)})}});
    }
    return entry->second;
}

void Writer::addObjects() {
    for (const Object& object : scene_.objects) {
        if (scene_.meshes[object.mesh].indices.empty()) {
            losses.add("objects without triangles left out", object.name);
            continue;
        }
        const mat3 linear(object.worldFromObject);
        const auto skew = [&](int i, int j) {
            const float product = glm::length(linear[i]) * glm::length(linear[j]);
            return std::abs(glm::dot(linear[i], linear[j])) > 1e-4f * product;
        };
        if (skew(0, 1) || skew(1, 2) || skew(2, 0))
            losses.add("sheared matrices, which glTF doesn't allow, written as they are", object.name);
        Json node = {{"name", object.name}, {"mesh", gltfMesh(object.mesh, object.material)}};
        if (object.worldFromObject != mat4(1)) node["matrix"] = toJson(object.worldFromObject);
        addNode(std::move(node));
    }
}

void Writer::addCameras() {
    for (const Camera& camera : scene_.cameras) {
        Json json = {{"name", camera.name}};
        if (camera.orthographic)
            json.update({{"type", "orthographic"},
                         {"orthographic",
                          {{"xmag", camera.halfHeight},
                           {"ymag", camera.halfHeight},
                           {"znear", camera.zNear},
                           {"zfar", camera.zFar}}}});
        else
            json.update({{"type", "perspective"}, {"perspective", {{"yfov", camera.yFov}, {"znear", camera.zNear}}}});
        addNode({{"name", camera.name}, {"camera", cameras_.size()}, {"matrix", toJson(camera.worldFromView)}});
        cameras_.push_back(std::move(json));
    }
}

/// Rigid matrix whose -Z is exactly `direction`.
mat4 nodeMatrix(vec3 position, vec3 direction) {
    const vec3 z = -direction;
    const vec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.99f ? vec3(0, 1, 0) : vec3(1, 0, 0), z));
    return {vec4(x, 0), vec4(glm::cross(z, x), 0), vec4(z, 0), vec4(position, 1)};
}

Json Writer::light(const Light& light) {
    constexpr std::array<const char*, 3> kTypes = {"directional", "point", "spot"};
    const float intensity = exactScale(light.color);
    Json json = {{"name", light.name},
                 {"type", kTypes[size_t(light.type)]},
                 {"color", toJson(light.color / intensity)},
                 {"intensity", intensity}};
    if (light.type != LightType::directional && std::isfinite(light.range)) json["range"] = light.range;
    if (light.type == LightType::spot) {
        constexpr auto kWidest = float(kPi / 2);
        if (light.outerConeAngle > kWidest) losses.add("cones wider than glTF's limit narrowed", light.name);
        const float outer = std::min(light.outerConeAngle, kWidest);
        json["spot"] = {{"innerConeAngle", std::min(light.innerConeAngle, std::nextafter(outer, 0.0f))},
                        {"outerConeAngle", outer}};
    }
    if (light.attenuation != kNone) losses.add("attenuation functions of lights left out", light.name);
    if (light.falloff != kNone) losses.add("falloff functions of lights left out", light.name);
    if (light.contribution != LightContribution::diffuseAndSpecular)
        losses.add("lights that are diffuse or specular only written as both", light.name);
    if (light.infiniteViewer) losses.add("infinite viewers of lights left out", light.name);
    if (light.linkGroup != kNone) losses.add("link groups of lights left out", light.name);
    if (light.volume != kNone) losses.add("volumes of lights left out", light.name);
    if (!light.castsShadows || light.shadowSoftness != 1 || light.shadowResolution != 1) losses.add("settings of lights' shadows left out", light.name);
    return json;
}

void Writer::addLights() {
    for (const Light& source : scene_.lights) {
        Json node = {{"name", source.name}, {"extensions", {{"KHR_lights_punctual", {{"light", lights_.size()}}}}}};
        if (source.type == LightType::point) {
            node["translation"] = toJson(source.positionWorld);
        } else {
            const bool placed = source.type == LightType::spot;
            node["matrix"] = toJson(nodeMatrix(placed ? source.positionWorld : vec3(0), source.directionWorld));
        }
        addNode(std::move(node));
        lights_.push_back(light(source));
        extensions_.insert("KHR_lights_punctual");
    }
}

/// KHR_texture_transform: matrix = translation * rotation * scale, with rotation (cos, sin; -sin, cos).
/// \return nothing for the identity; `sheared` if the matrix can't be said exactly
std::optional<Json> textureTransform(const std::array<vec3, 2>& rows, bool& sheared) {
    const vec2 offset(rows[0].z, rows[1].z), u(rows[0].x, rows[1].x), v(rows[0].y, rows[1].y);
    sheared = std::abs(glm::dot(u, v)) > 1e-4f * glm::length(u) * glm::length(v);
    if (offset == vec2(0) && u == vec2(1, 0) && v == vec2(0, 1)) return std::nullopt;
    Json json = {{"offset", toJson(offset)}};
    if (u.y == 0 && v.x == 0) {
        json["scale"] = toJson(vec2(u.x, v.y));
    } else {
        const float rotation = std::atan2(-u.y, u.x);
        json["rotation"] = rotation;
        json["scale"] = toJson(vec2(glm::length(u), std::sin(rotation) * v.x + std::cos(rotation) * v.y));
    }
    return json;
}

Json Writer::textureInfo(const TextureUse& use, const std::string& materialName) {
    Json json = {{"index", use.texture}};
    if (use.uvSet != 0) json["texCoord"] = use.uvSet;
    bool sheared = false;
    if (auto transform = textureTransform(use.uvTransform, sheared)) {
        json["extensions"]["KHR_texture_transform"] = std::move(*transform);
        extensions_.insert("KHR_texture_transform");
    }
    if (sheared) losses.add("sheared texture transforms of materials squared up", materialName);
    return json;
}

/// What comes nearest to `source` among metallic-roughness materials.
Material asMetallicRoughness(const Scene& scene, const Material& source) {
    Material material = source;
    const ShapedParameters& shaped = source.shaped;
    material.equation = LightEquation::metallicRoughness;
    material.baseColor = vec4(vec3(source.baseColor) * shaped.kd, source.baseColor.a);
    material.metallic = shaped.specularBlend;
    material.emissive = shaped.specularColor * shaped.ks * shaped.kEmissive;
    // Width of the highlight: alpha^2 = 2 / (n + 2) (Walter et al. 2007, "Microfacet Models for Refraction", 5.2).
    const Function& highlight = scene.functions[shaped.specularFunction];
    const float exponent = highlight.kind == Function::Kind::blinnPhong ? highlight.parameter : 0;
    material.roughness = std::pow(2 / (exponent + 2), 0.25f);
    return material;
}

Json Writer::material(const Material& source) {
    Material m = source;
    if (m.equation == LightEquation::shaped) {
        m = asMetallicRoughness(scene_, source);
        losses.add("shaped materials approximated by metallic-roughness", m.name);
    }
    if (m.surface != SurfaceShader::textured) {
        m.baseColor = vec4(glm::mix(vec3(m.baseColor), m.proceduralColor, 0.5f), m.baseColor.a);
        losses.add("checker and marble surfaces written in their mean colour", m.name);
    }
    const vec4 color = glm::clamp(m.baseColor, vec4(0), vec4(1));
    if (color != m.baseColor) losses.add("base colours beyond 1 cut", m.name);

    Json pbr = {{"baseColorFactor", toJson(color)}, {"metallicFactor", m.metallic}, {"roughnessFactor", m.roughness}};
    Json json = {{"name", m.name}};
    const auto texture = [&](Json& at, const char* key, const TextureUse& use) {
        if (use.texture != kNone) at[key] = textureInfo(use, m.name);
        return use.texture != kNone;
    };
    texture(pbr, "baseColorTexture", m.baseColorTexture);
    texture(pbr, "metallicRoughnessTexture", m.metallicRoughnessTexture);
    json["pbrMetallicRoughness"] = std::move(pbr);
    if (texture(json, "normalTexture", m.normalTexture)) json["normalTexture"]["scale"] = m.normalScale;
    if (texture(json, "occlusionTexture", m.occlusionTexture))
        json["occlusionTexture"]["strength"] = m.occlusionStrength;
    texture(json, "emissiveTexture", m.emissiveTexture);
    if (m.emissive != vec3(0)) {
        const float strength = exactScale(m.emissive);
        json["emissiveFactor"] = toJson(m.emissive / strength);
        if (strength != 1) {
            json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
            extensions_.insert("KHR_materials_emissive_strength");
        }
    }
    if (m.alphaMode == AlphaMode::mask) json.update({{"alphaMode", "MASK"}, {"alphaCutoff", m.alphaCutoff}});
    if (m.alphaMode == AlphaMode::blend) json["alphaMode"] = "BLEND";
    if (m.doubleSided) json["doubleSided"] = true;
    if (!m.castsShadows) losses.add("materials that cast no shadows written as if they did", m.name);
    if (m.equation == LightEquation::unlit) {
        json["extensions"]["KHR_materials_unlit"] = Json::object();
        extensions_.insert("KHR_materials_unlit");
    }
    return json;
}

void Writer::addMaterials() {
    for (const Material& source : scene_.materials) materials_.push_back(material(source));
}

Json samplerJson(const Sampler& sampler) {
    constexpr std::array<int, 3> kWraps = {10497, 33648, 33071};  // glTF 2.0 section 5.26
    constexpr int kNearest = 9728, kLinear = 9729;
    int minFilter = sampler.minFilter == Filter::nearest ? kNearest : kLinear;
    if (sampler.mipFilter != MipFilter::none)
        minFilter = 9984 + (sampler.minFilter == Filter::linear) + 2 * (sampler.mipFilter == MipFilter::linear);
    return {{"magFilter", sampler.magFilter == Filter::nearest ? kNearest : kLinear},
            {"minFilter", minFilter},
            {"wrapS", kWraps[size_t(sampler.wrapU)]},
            {"wrapT", kWraps[size_t(sampler.wrapV)]}};
}

void Writer::addTextures() {
    for (const Texels& texels : scene_.texels) {
        const auto png = encodePng(texels.width, texels.height, 4, std::span<const uint8_t>(texels.rgba));
        images_.push_back(
            {{"name", texels.name}, {"mimeType", "image/png"}, {"bufferView", binary_.addView(png, std::nullopt)}});
    }
    for (const Texture& texture : scene_.textures) {
        Json sampler = samplerJson(texture.sampler);
        const auto known = std::ranges::find(samplers_, sampler);
        textures_.push_back({{"sampler", known - samplers_.begin()}, {"source", texture.texels}});
        if (known == samplers_.end()) samplers_.push_back(std::move(sampler));
    }
}

void Writer::reportRest() {
    if (scene_.ambience.sky != vec3(0) || scene_.ambience.ground != vec3(0))
        losses.add("ambience left out", scene_.name);
    if (scene_.exposureEv != 0) losses.add("exposure left out", scene_.name);
}

Json Writer::document() {
    Json scene = {{"name", scene_.name}};
    Json json = {{"asset", {{"version", "2.0"}, {"generator", "Luciole"}}}};
    if (!extensions_.empty()) json["extensionsUsed"] = extensions_;
    json["scene"] = 0;
    // glTF allows no empty arrays.
    const auto put = [](Json& at, const char* key, Json& array) {
        if (!array.empty()) at[key] = std::move(array);
    };
    put(scene, "nodes", sceneNodes_);
    json["scenes"] = Json::array({std::move(scene)});
    put(json, "nodes", nodes_);
    put(json, "cameras", cameras_);
    put(json, "meshes", meshes_);
    put(json, "materials", materials_);
    put(json, "textures", textures_);
    put(json, "images", images_);
    put(json, "samplers", samplers_);
    put(json, "accessors", binary_.accessors);
    put(json, "bufferViews", binary_.views);
    if (!binary_.bytes().empty()) json["buffers"] = Json::array({{{"byteLength", binary_.bytes().size()}}});
    if (!lights_.empty()) json["extensions"]["KHR_lights_punctual"]["lights"] = std::move(lights_);
    return json;
}

void append32(std::vector<std::byte>& bytes, uint64_t value) {
    const auto word = std::as_bytes(std::span(&value, 1)).first(4);
    bytes.insert(bytes.end(), word.begin(), word.end());
}

/// GLB: glTF 2.0 section 4.4.
std::vector<std::byte> Writer::write() {
    addObjects();
    addCameras();
    addLights();
    addMaterials();
    addTextures();
    reportRest();
    std::string json = document().dump(-1, ' ', false, Json::error_handler_t::replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');

    constexpr uint64_t kHeader = 12, kChunkHeader = 8, kMaxBytes = std::numeric_limits<uint32_t>::max();
    const std::vector<std::byte>& binary = binary_.bytes();
    const uint64_t size = kHeader + kChunkHeader + json.size() + (binary.empty() ? 0 : kChunkHeader + binary.size());
    if (size > kMaxBytes)
        throw Error(ErrorKind::limit,
                    fmt::format("a GLB file holds at most {} bytes, this one needs {}", kMaxBytes, size));
    std::vector<std::byte> bytes;
    bytes.reserve(size);
    for (const uint64_t word : {uint64_t(0x46546C67), uint64_t(2), size}) append32(bytes, word);
    for (const uint64_t word : {uint64_t(json.size()), uint64_t(0x4E4F534A)}) append32(bytes, word);
    const auto text = std::as_bytes(std::span(json));
    bytes.insert(bytes.end(), text.begin(), text.end());
    if (binary.empty()) return bytes;
    for (const uint64_t word : {uint64_t(binary.size()), uint64_t(0x004E4942)}) append32(bytes, word);
    bytes.insert(bytes.end(), binary.begin(), binary.end());
    return bytes;
}

}  // namespace

std::vector<std::string> writeGlb(const Scene& scene, const std::filesystem::path& file) {
    Writer writer(scene);
    writeFileAtomically(file, writer.write());
    return writer.losses.lines();
}

}  // namespace luciole
