#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/ranges.h>

#include "scene/gltf/container.hpp"
#include "scene/gltf/light_camera.hpp"
#include "scene/gltf/material.hpp"
#include "scene/gltf/mesh.hpp"

/// The glTF 2.0 reader: bytes -> JSON -> Scene. Nothing is trusted. JSON is measured before it is built (json.hpp), and
/// each index, count and range is checked where it is used, so that the message can name its path.
namespace luciole {
namespace gltf {

namespace {

constexpr std::array<std::string_view, 5> kSupported{"KHR_lights_punctual", "KHR_materials_emissive_strength",
                                                     "KHR_materials_unlit", "KHR_mesh_quantization",
                                                     "KHR_texture_transform"};

void checkVersion(const JsonNode& root) {
    const JsonNode asset = root.at("asset");
    const JsonNode version = asset.at("version");
    if (!version.string().starts_with("2.")) version.fail("2.x");
    const auto least = asset.find("minVersion");
    if (least && least->string() != "2.0") least->fail("2.0");
}

void checkExtensions(const JsonNode& root, Warnings& warnings) {
    const auto isSupported = [](const std::string& name) {
        return std::find(kSupported.begin(), kSupported.end(), name) != kSupported.end();
    };
    const auto required = root.find("extensionsRequired");
    for (size_t i = 0; required && i < required->size(); ++i) {
        const JsonNode name = (*required)[i];
        if (!isSupported(name.string())) name.fail(fmt::format("one of {}", fmt::join(kSupported, ", ")));
    }
    const auto used = root.find("extensionsUsed");
    for (size_t i = 0; used && i < used->size(); ++i) {
        const std::string& name = (*used)[i].string();
        if (!isSupported(name)) warnings.add(fmt::format("extension {} is not supported; ignored", name));
    }
}

/// Reads one document into one Scene.
class Reader {
public:
    Reader(const JsonNode& root, const Container& container, const Files& files, const LoadLimits& limits)
        : root_(root),
          limits_(limits),
          warnings_(scene_.warnings),
          buffers_(root, container.binaryChunk, files),
          accessors_(root, buffers_, limits),
          textures_(root, buffers_, files, limits, warnings_, scene_),
          materials_(root, textures_, scene_),
          meshes_(root, accessors_, limits, warnings_, scene_.meshes) {}

    Scene read() {
        checkVersion(root_);
        checkExtensions(root_, warnings_);
        const auto shown = defaultScene(root_);
        if (shown) scene_.name = stringOr(*shown, "name", "");
        forEachNode(root_, warnings_, [this](const PlacedNode& node) { addNode(node); });
        if (const auto animations = root_.find("animations"); animations && animations->size() > 0) {
            warnings_.add("animations are not supported; everything is shown at rest");
        }
        return std::move(scene_);
    }

private:
    void addNode(const PlacedNode& node) {
        if (const auto reference = node.json.find("mesh")) addObjects(*reference, node);
        if (const auto reference = node.json.find("skin")) checkSkin(*reference);
        if (const auto reference = node.json.find("camera")) {
            if (auto camera = readCamera(root_, *reference, node, warnings_)) scene_.cameras.push_back(*camera);
        }
        if (const auto punctual = extension(node.json, "KHR_lights_punctual")) {
            if (auto light = readLight(root_, punctual->at("light"), node, warnings_)) scene_.lights.push_back(*light);
        }
    }

    void addObjects(const JsonNode& reference, const PlacedNode& node) {
        const uint32_t meshIndex = indexInto(root_, "meshes", reference);
        const JsonNode mesh = root_.at("meshes")[meshIndex];
        if (nextObjectId_ > kMaxObjectId) {
            throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} nodes with a mesh, got more",
                                                      node.json.where(), kMaxObjectId + 1));
        }
        const uint32_t objectId = nextObjectId_++;
        if (!isInvertible(node.worldFromNode)) {
            warnings_.add(
                fmt::format("{} \"{}\": its matrix can't be inverted; not drawn", node.json.path(), node.name));
            return;
        }
        for (const Drawn& drawn : drawnOf(meshIndex, mesh)) {
            if (scene_.objects.size() >= limits_.maxElements) {
                throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} objects in all, got more",
                                                          node.json.where(), limits_.maxElements));
            }
            scene_.objects.push_back({node.name, drawn.mesh, drawn.material, mat4(node.worldFromNode), objectId});
        }
    }

    /// What a mesh's primitives become. Read once however many nodes place the mesh, so that those which are not drawn
    /// cost once, too.
    struct Drawn {
        uint32_t mesh, material;
    };
    const std::vector<Drawn>& drawnOf(uint32_t meshIndex, const JsonNode& mesh) {
        const auto [found, isNew] = drawn_.try_emplace(meshIndex);
        if (!isNew) return found->second;
        const JsonNode primitives = mesh.at("primitives");
        const std::string name = stringOr(mesh, "name", fmt::format("mesh {}", meshIndex));
        for (size_t i = 0; i < primitives.size(); ++i) {
            const JsonNode primitive = primitives[i];
            if (primitive.find("targets")) warnings_.add("morph targets are not supported; meshes are shown without");
            const uint32_t material = materials_.load(primitive.find("material"));
            const TextureUse& normalTexture = scene_.materials[material].normalTexture;
            const uint32_t tangentUvSet = normalTexture.texture == kNone ? kNone : normalTexture.uvSet;
            const uint32_t loaded = meshes_.load(primitive, name, tangentUvSet);
            if (loaded != kNone) found->second.push_back({loaded, material});
        }
        return found->second;
    }

    void checkSkin(const JsonNode& reference) {
        const JsonNode skin = resolve(root_, "skins", reference);
        if (!checkedSkins_.insert(skin.path()).second) return;
        const JsonNode joints = skin.at("joints");
        for (size_t i = 0; i < joints.size(); ++i) indexInto(root_, "nodes", joints[i]);
        if (const auto skeleton = skin.find("skeleton")) indexInto(root_, "nodes", *skeleton);
        if (const auto matrices = skin.find("inverseBindMatrices")) indexInto(root_, "accessors", *matrices);
        warnings_.add("skins are not supported; meshes are shown at their nodes, in the pose that they were made in");
    }

    JsonNode root_;
    const LoadLimits& limits_;
    Scene scene_;
    Warnings warnings_;
    Buffers buffers_;
    Accessors accessors_;
    Textures textures_;
    Materials materials_;
    Meshes meshes_;
    std::map<uint32_t, std::vector<Drawn>> drawn_;
    std::set<std::string> checkedSkins_;
    uint32_t nextObjectId_ = 0;
};

}  // namespace

}  // namespace gltf

Scene loadGltf(std::span<const std::byte> bytes, const std::string& nameForErrors, const std::filesystem::path& folder,
               const LoadOptions& options) {
    const gltf::Container container = gltf::splitContainer(bytes, nameForErrors);
    const nlohmann::json document = parseJson(container.json, nameForErrors, options.limits);
    const JsonNode root(document, nameForErrors);
    const gltf::Files files(folder, options);
    Scene scene = gltf::Reader(root, container, files, options.limits).read();
    if (scene.name.empty()) scene.name = std::filesystem::path(nameForErrors).stem().string();
    validate(scene);
    return scene;
}

}  // namespace luciole
