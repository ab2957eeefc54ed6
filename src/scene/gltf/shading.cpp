#include "scene/gltf/shading.hpp"

#include <cmath>

namespace luciole::gltf {

namespace {

constexpr double kLeastLength = 1e-6;  // of a stored unit vector; shorter ones have no direction worth keeping

/// Twice the triangle's area along its normal.
dvec3 areaNormal(const Mesh& mesh, size_t firstIndex) {
    const auto corner = [&](size_t i) { return dvec3(mesh.vertices[mesh.indices[firstIndex + i]].position); };
    return glm::cross(corner(1) - corner(0), corner(2) - corner(0));
}

vec3 directionOf(const dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? vec3(v / length) : vec3(0, 0, 1);
}

}  // namespace

void makeFlat(Mesh& mesh) {
    std::vector<Vertex> vertices;
    vertices.reserve(mesh.indices.size());
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        vertices.push_back(mesh.vertices[mesh.indices[i]]);
        vertices.back().normal = directionOf(areaNormal(mesh, i / 3 * 3));
    }
    mesh.vertices = std::move(vertices);
    for (size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = uint32_t(i);
}

void repairNormals(Mesh& mesh) {
    bool broken = false;
    for (Vertex& vertex : mesh.vertices) {
        const double length = glm::length(dvec3(vertex.normal));
        vertex.normal = length > kLeastLength ? vec3(dvec3(vertex.normal) / length) : vec3(0);
        broken = broken || vertex.normal == vec3(0);
    }
    if (!broken) return;
    std::vector<dvec3> sums(mesh.vertices.size(), dvec3(0));
    for (size_t i = 0; i < mesh.indices.size(); ++i) sums[mesh.indices[i]] += areaNormal(mesh, i / 3 * 3);
    for (size_t v = 0; v < mesh.vertices.size(); ++v) {
        if (mesh.vertices[v].normal == vec3(0)) mesh.vertices[v].normal = directionOf(sums[v]);
    }
}

void repairTangents(Mesh& mesh) {
    for (Vertex& vertex : mesh.vertices) {
        const dvec3 tangent(vertex.tangent);
        const double length = glm::length(tangent);
        const bool usable = glm::length(glm::cross(tangent, dvec3(vertex.normal))) > kLeastLength * length;
        vertex.tangent = length > kLeastLength && usable
                             ? vec4(vec3(tangent / length), vertex.tangent.w < 0 ? -1.0f : 1.0f)
                             : anyTangent(vertex.normal);
    }
}

vec4 anyTangent(vec3 normal) {
    const dvec3 n(normal);
    const dvec3 axis = std::abs(n.x) < 0.7 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    return vec4(vec3(glm::normalize(axis - n * glm::dot(axis, n))), 1);
}

}  // namespace luciole::gltf
