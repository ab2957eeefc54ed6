#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include <luciole/error.hpp>

#include "scene/light_volume.hpp"
#include "scene/rig/sections.hpp"
#include "scene/rig/values.hpp"

namespace luciole::rig {
namespace {

void expectTriangles(const JsonNode& node, uint64_t count) {
    if (count > kMaxVolumeTriangles)
        throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} triangles in a light volume, got {}",
                                                  node.where(), kMaxVolumeTriangles, count));
}

/// Adds an object's geometry in world space, outside on the side of the front faces.
void append(const Mesh& mesh, const mat4& worldFromObject, LightVolume& volume) {
    const auto first = uint32_t(volume.positionsWorld.size());
    const dmat4 world(worldFromObject);
    for (const Vertex& vertex : mesh.vertices)
        volume.positionsWorld.emplace_back(world * dvec4(dvec3(vertex.position), 1));
    const bool mirrored = determinant(dmat3(world)) < 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        volume.indices.push_back(first + mesh.indices[i]);
        volume.indices.push_back(first + mesh.indices[i + (mirrored ? 2 : 1)]);
        volume.indices.push_back(first + mesh.indices[i + (mirrored ? 1 : 2)]);
    }
}

/// Vertices of all volumes; objects may be thousands of one mesh, so that a small file can ask for a lot.
void expectRoom(const JsonNode& node, const Scene& scene, uint64_t more, const LoadLimits& limits) {
    uint64_t vertices = more;
    for (const LightVolume& volume : scene.lightVolumes) vertices += volume.positionsWorld.size();
    if (vertices > limits.maxVertices)
        throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} vertices in the scene's light volumes, got {}",
                                                  node.where(), limits.maxVertices, vertices));
}

/// The objects' geometry; they leave the scene.
LightVolume ofObjects(const JsonNode& node, Scene& scene, const LoadLimits& limits) {
    const std::vector<size_t> chosen = select(node, "object", scene.objects);
    uint64_t triangles = 0, vertices = 0;
    for (const size_t i : chosen) {
        triangles += scene.meshes[scene.objects[i].mesh].indices.size() / 3;
        vertices += scene.meshes[scene.objects[i].mesh].vertices.size();
    }
    expectTriangles(node, triangles);
    expectRoom(node, scene, vertices, limits);

    LightVolume volume;
    std::vector<Object> kept;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        Object& object = scene.objects[i];
        if (std::binary_search(chosen.begin(), chosen.end(), i)) {
            append(scene.meshes[object.mesh], object.worldFromObject, volume);
        } else {
            kept.push_back(std::move(object));
        }
    }
    scene.objects = std::move(kept);
    return volume;
}

LightVolume ofBox(const JsonNode& node) {
    node.expectKeys({"low", "high"});
    const std::array ends{node.at("low").vector3(), node.at("high").vector3()};
    for (int axis = 0; axis < 3; ++axis)
        if (!(ends[0][axis] < ends[1][axis]))
            node.failWith(fmt::format("expected low < high on each axis, got {} and {} along {}", ends[0][axis],
                                      ends[1][axis], "xyz"[axis]));
    LightVolume volume;
    for (size_t corner = 0; corner < 8; ++corner)  // bits: x, y, z
        volume.positionsWorld.emplace_back(ends[corner & 1].x, ends[corner >> 1 & 1].y, ends[corner >> 2].z);
    volume.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,   // -z, +z, -y
                      2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};  // +y, -x, +x
    return volume;
}

LightVolume ofMesh(const JsonNode& node) {
    node.expectKeys({"positions", "indices"});
    LightVolume volume;
    for (const JsonNode& position : node.at("positions").elements()) volume.positionsWorld.push_back(position.vector3());
    const JsonNode positions = node.at("positions"), indices = node.at("indices");
    if (positions.size() == 0) positions.fail("at least one position");
    const std::vector<JsonNode> triangles = indices.elements();
    if (triangles.empty()) indices.fail("at least one triangle");
    expectTriangles(indices, triangles.size());
    for (const JsonNode& triangle : triangles) {
        if (!triangle.isArray() || triangle.size() != 3) triangle.fail("three indices");
        for (size_t k = 0; k < 3; ++k)
            volume.indices.push_back(uint32_t(triangle[k].integer(0, volume.positionsWorld.size() - 1)));
    }
    return volume;
}

/// The key by which an entry gives its geometry.
std::string_view sourceOf(const JsonNode& entry) {
    std::string_view source;
    int count = 0;
    for (const std::string_view key : {"object", "box", "mesh"})
        if (entry.find(key)) {
            source = key;
            ++count;
        }
    if (count != 1) entry.failWith(fmt::format("expected exactly one of object, box and mesh, got {}", count));
    return source;
}

LightVolume volumeOf(const JsonNode& entry, Scene& scene, const LoadLimits& limits) {
    entry.expectKeys({"name", "object", "box", "mesh"});
    const std::string& name = entry.at("name").string();
    const JsonNode source = entry.at(sourceOf(entry));
    LightVolume volume = entry.find("object") ? ofObjects(source, scene, limits)
                         : entry.find("box")  ? ofBox(source)
                                              : ofMesh(source);
    volume.name = name;
    if (const auto fault = faultOf(volume))
        source.failWith(fmt::format("{}: expected {}, got {}", fault->field, fault->expected, fault->got));
    return volume;
}

}  // namespace

void applyLightVolumes(const JsonNode& list, Scene& scene, const LoadLimits& limits) {
    for (const JsonNode& entry : list.elements()) {
        LightVolume volume = volumeOf(entry, scene, limits);
        const size_t index = indexOf(scene.lightVolumes, volume.name);
        if (index < scene.lightVolumes.size()) {
            scene.lightVolumes[index] = std::move(volume);
        } else {
            scene.lightVolumes.push_back(std::move(volume));
        }
    }
}

}  // namespace luciole::rig
