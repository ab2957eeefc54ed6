#include "scene/gltf/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/gltf/shading.hpp"

namespace luciole::gltf {

namespace {

/// glTF 2.0, section 3.7.2.1.
constexpr std::array<std::string_view, 7> kModes{"points",    "lines",           "line loops",   "line strips",
                                                 "triangles", "triangle strips", "triangle fans"};
constexpr uint32_t kTriangles = 4, kTriangleStrip = 5;

uint64_t triangleIndexCount(uint32_t mode, uint64_t indices) {
    if (mode == kTriangles) return indices / 3 * 3;
    return indices < 3 ? 0 : (indices - 2) * 3;
}

/// A list of triangles from a strip or fan, with the winding that section 3.7.2.1 gives.
std::vector<uint32_t> toList(const std::vector<uint32_t>& in, uint32_t mode) {
    std::vector<uint32_t> list;
    list.reserve(triangleIndexCount(mode, in.size()));
    for (size_t i = 0; i + 2 < in.size(); ++i) {
        const std::array<uint32_t, 3> triangle =
            mode == kTriangleStrip ? std::array<uint32_t, 3>{in[i], in[i + 1 + i % 2], in[i + 2 - i % 2]}
                                   : std::array<uint32_t, 3>{in[i + 1], in[i + 2], in[0]};
        list.insert(list.end(), triangle.begin(), triangle.end());
    }
    return list;
}

vec2 vec2At(const Attribute& a, size_t i) { return {a[i][0], a[i][1]}; }
vec3 vec3At(const Attribute& a, size_t i) { return {a[i][0], a[i][1], a[i][2]}; }

}  // namespace

uint32_t Meshes::load(const JsonNode& primitive, const std::string& name, uint32_t tangentUvSet) {
    const auto mode = uint32_t(integerOr(primitive, "mode", kTriangles, 0, kModes.size() - 1));
    if (mode < kTriangles) {
        warnings_.add(fmt::format("{}: {} are not drawn", primitive.path(), kModes[mode]));
        return kNone;
    }
    const JsonNode attributes = primitive.at("attributes");
    if (!attributes.find("POSITION")) {
        warnings_.add(fmt::format("{}: has no POSITION; not drawn", primitive.path()));
        return kNone;
    }
    const auto accessor = [&](const JsonNode& owner, std::string_view semantic) {
        const auto reference = owner.find(semantic);
        return reference ? indexInto(root_, "accessors", *reference) : kNone;
    };
    const bool hasTangents = attributes.find("NORMAL") && attributes.find("TANGENT");
    const uint32_t derivedFrom = hasTangents ? kNone : tangentUvSet;
    const Key key{mode,
                  accessor(primitive, "indices"),
                  accessor(attributes, "POSITION"),
                  accessor(attributes, "NORMAL"),
                  accessor(attributes, "TANGENT"),
                  accessor(attributes, "TEXCOORD_0"),
                  accessor(attributes, "TEXCOORD_1"),
                  accessor(attributes, "COLOR_0"),
                  derivedFrom};
    if (const auto found = known_.find(key); found != known_.end()) return found->second;

    Mesh mesh = read(primitive, mode, derivedFrom);
    if (mesh.indices.empty()) {
        warnings_.add(fmt::format("{}: has no triangles; not drawn", primitive.path()));
        return known_[key] = kNone;
    }
    mesh.name = name;
    meshes_.push_back(std::move(mesh));
    return known_[key] = uint32_t(meshes_.size() - 1);
}

Mesh Meshes::read(const JsonNode& primitive, uint32_t mode, uint32_t tangentUvSet) {
    const JsonNode attributes = primitive.at("attributes");
    Mesh mesh;
    mesh.vertices = readVertices(attributes);
    mesh.indices = readTriangles(primitive, mode, mesh.vertices.size());
    if (attributes.find("NORMAL")) {
        repairNormals(mesh);
    } else {
        charge(primitive, vertexTotal_, mesh.indices.size(), "vertices");
        makeFlat(mesh);
    }
    if (attributes.find("NORMAL") && attributes.find("TANGENT")) {
        repairTangents(mesh);
    } else if (tangentUvSet != kNone) {
        const size_t before = mesh.vertices.size();
        deriveTangents(mesh, tangentUvSet);
        charge(primitive, vertexTotal_, mesh.vertices.size() - before, "vertices");
    } else {
        for (Vertex& vertex : mesh.vertices) vertex.tangent = anyTangent(vertex.normal);
    }
    return mesh;
}

std::vector<Vertex> Meshes::readVertices(const JsonNode& attributes) {
    const JsonNode position = attributes.at("POSITION");
    const Attribute positions = accessors_.floats(position, 3, 3);
    const size_t count = positions.count();
    charge(attributes, vertexTotal_, count, "vertices");
    std::vector<Vertex> vertices(count);
    for (size_t i = 0; i < count; ++i) {
        const vec3 p = vec3At(positions, i);
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            position.failWith(fmt::format("expected finite numbers, got ({}, {}, {}) at vertex {}", p.x, p.y, p.z, i));
        }
        vertices[i].position = p;
    }
    if (const auto json = attributes.find("NORMAL")) {
        const Attribute normals = readAttribute(*json, 3, 3, count, true);
        for (size_t i = 0; i < count; ++i) vertices[i].normal = vec3At(normals, i);
    }
    if (const auto json = attributes.find("TANGENT")) {
        const Attribute tangents = readAttribute(*json, 4, 4, count, true);
        for (size_t i = 0; i < count; ++i) vertices[i].tangent = vec4(vec3At(tangents, i), tangents[i][3]);
    }
    if (const auto json = attributes.find("TEXCOORD_0")) {
        const Attribute uvs = readAttribute(*json, 2, 2, count, false);
        for (size_t i = 0; i < count; ++i) vertices[i].uv0 = vec2At(uvs, i);
    }
    if (const auto json = attributes.find("TEXCOORD_1")) {
        const Attribute uvs = readAttribute(*json, 2, 2, count, false);
        for (size_t i = 0; i < count; ++i) vertices[i].uv1 = vec2At(uvs, i);
    }
    if (const auto json = attributes.find("COLOR_0")) {
        const Attribute colors = readAttribute(*json, 3, 4, count, true);
        for (size_t i = 0; i < count; ++i) {
            vertices[i].color = vec4(vec3At(colors, i), colors.components == 4 ? colors[i][3] : 1.0f);
        }
    }
    return vertices;
}

Attribute Meshes::readAttribute(const JsonNode& reference, uint32_t low, uint32_t high, size_t count,
                                bool forceNormalized) {
    Attribute attribute = accessors_.floats(reference, low, high, forceNormalized);
    if (attribute.count() != count) {
        reference.failWith(fmt::format("expected {} elements as in POSITION, got {}", count, attribute.count()));
    }
    for (float& value : attribute.values) {
        if (std::isfinite(value)) continue;
        warnings_.add(fmt::format("{}: values that are not finite are replaced by 0", reference.path()));
        value = 0;
    }
    return attribute;
}

std::vector<uint32_t> Meshes::readTriangles(const JsonNode& primitive, uint32_t mode, size_t vertexCount) {
    std::vector<uint32_t> indices;
    if (const auto reference = primitive.find("indices")) {
        indices = accessors_.indices(*reference);
        const auto wrong = std::find_if(indices.begin(), indices.end(), [&](uint32_t i) { return i >= vertexCount; });
        if (wrong != indices.end()) {
            reference->failWith(fmt::format("expected indices below {}, the number of vertices, got {} at {}",
                                            vertexCount, *wrong, wrong - indices.begin()));
        }
    } else {
        indices.resize(vertexCount);
        std::iota(indices.begin(), indices.end(), 0u);
    }
    const uint64_t count = triangleIndexCount(mode, indices.size());
    charge(primitive, indexTotal_, count, "indices");
    if (mode != kTriangles) return toList(indices, mode);
    if (count != indices.size()) {
        warnings_.add(fmt::format("{}: {} indices are no whole number of triangles; the last {} are ignored",
                                  primitive.path(), indices.size(), indices.size() - count));
    }
    indices.resize(count);
    return indices;
}

void Meshes::charge(const JsonNode& primitive, uint64_t& total, uint64_t more, std::string_view what) const {
    total += more;
    if (const uint64_t limit = accessors_.allowance(); total > limit) {
        throw Error(ErrorKind::limit,
                    fmt::format("{}: expected at most {} {} in all, got {}", primitive.where(), limit, what, total));
    }
}

}  // namespace luciole::gltf
