#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <luciole/scene.hpp>

#include "scene/gltf/accessors.hpp"
#include "scene/gltf/warnings.hpp"

namespace luciole::gltf {

/// Reads primitives as triangle lists with normals and tangents. Primitives of the same accessors share a mesh.
class Meshes {
public:
    /// \param meshes of the scene, to be added to; all references must outlive this
    Meshes(const JsonNode& root, Accessors& accessors, const LoadLimits& limits, Warnings& warnings,
           std::vector<Mesh>& meshes)
        : root_(root), accessors_(accessors), limits_(limits), warnings_(warnings), meshes_(meshes) {}

    /// \param name given to the mesh if it is new
    /// \param tangentUvSet UV set that missing tangents are derived from; kNone if nobody will look at them
    /// \return index of the mesh; kNone if there is nothing to draw, which is warned of
    uint32_t load(const JsonNode& primitive, const std::string& name, uint32_t tangentUvSet);

private:
    using Key = std::array<uint32_t, 9>;

    Mesh read(const JsonNode& primitive, uint32_t mode, uint32_t tangentUvSet);
    std::vector<Vertex> readVertices(const JsonNode& attributes);
    std::vector<uint32_t> readTriangles(const JsonNode& primitive, uint32_t mode, size_t vertexCount);
    Attribute readAttribute(const JsonNode& reference, uint32_t low, uint32_t high, size_t count, bool forceNormalized);
    void charge(const JsonNode& primitive, uint64_t& total, uint64_t more, std::string_view what) const;

    JsonNode root_;
    Accessors& accessors_;
    const LoadLimits& limits_;
    Warnings& warnings_;
    std::vector<Mesh>& meshes_;
    std::map<Key, uint32_t> known_;
    uint64_t vertexTotal_ = 0;
    uint64_t indexTotal_ = 0;
};

}  // namespace luciole::gltf
