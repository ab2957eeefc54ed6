#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <numeric>

#include "scene/gltf/shading.hpp"

namespace luciole::gltf {

namespace {

enum class Hand : uint8_t { right, left, none };  ///< none: no area in UV space

vec2 uvOf(const Vertex& vertex, uint32_t uvSet) { return uvSet == 0 ? vertex.uv0 : vertex.uv1; }

/// For each vertex the number of its group: vertices of equal position, normal and UV are one to MikkTSpace. Found by
/// sorting, as a file can't make that slow.
std::vector<uint32_t> weld(const Mesh& mesh, uint32_t uvSet) {
    const auto key = [&](uint32_t i) -> std::array<float, 8> {
        const Vertex& v = mesh.vertices[i];
        const vec2 uv = uvOf(v, uvSet);
        return {v.position.x, v.position.y, v.position.z, v.normal.x, v.normal.y, v.normal.z, uv.x, uv.y};
    };
    std::vector<uint32_t> order(mesh.vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    std::vector<uint32_t> groups(order.size());
    uint32_t group = 0;
    for (size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && key(order[i - 1]) != key(order[i])) ++group;
        groups[order[i]] = group;
    }
    return groups;
}

/// Direction in which u grows over a triangle, not scaled, and its handedness. In glTF v runs down the picture, so the
/// right-handed case, bitangent = cross(normal, tangent) towards smaller v, has a negative area in UV space.
struct TriangleFrame {
    dvec3 tangent{0};
    Hand hand = Hand::none;
};

TriangleFrame frameOf(const Mesh& mesh, size_t firstIndex, uint32_t uvSet) {
    const auto corner = [&](size_t i) -> const Vertex& { return mesh.vertices[mesh.indices[firstIndex + i]]; };
    const dvec3 edge1 = dvec3(corner(1).position) - dvec3(corner(0).position);
    const dvec3 edge2 = dvec3(corner(2).position) - dvec3(corner(0).position);
    const dvec2 uv1 = dvec2(uvOf(corner(1), uvSet)) - dvec2(uvOf(corner(0), uvSet));
    const dvec2 uv2 = dvec2(uvOf(corner(2), uvSet)) - dvec2(uvOf(corner(0), uvSet));
    const double area = uv1.x * uv2.y - uv2.x * uv1.y;
    if (!(std::abs(area) > double(FLT_MIN))) return {};
    const dvec3 tangent = (edge1 * uv2.y - edge2 * uv1.y) * (area < 0 ? -1.0 : 1.0);
    return {tangent, area < 0 ? Hand::right : Hand::left};
}

dvec3 unitOrZero(const dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : dvec3(0);
}

dvec3 projected(const dvec3& v, const dvec3& normal) { return unitOrZero(v - normal * glm::dot(normal, v)); }

/// Angle-weighted sums of the triangles' tangents, for each group and hand.
std::vector<std::array<dvec3, 2>> sumTangents(const Mesh& mesh, const std::vector<TriangleFrame>& frames,
                                              const std::vector<uint32_t>& groups) {
    std::vector<std::array<dvec3, 2>> sums(mesh.vertices.size(), {dvec3(0), dvec3(0)});
    for (size_t t = 0; t < frames.size(); ++t) {
        if (frames[t].hand == Hand::none) continue;
        for (size_t c = 0; c < 3; ++c) {
            const uint32_t v = mesh.indices[3 * t + c];
            const dvec3 here(mesh.vertices[v].position), normal(mesh.vertices[v].normal);
            const auto edgeTo = [&](size_t other) {
                return projected(dvec3(mesh.vertices[mesh.indices[3 * t + other]].position) - here, normal);
            };
            const double cosine = glm::dot(edgeTo((c + 1) % 3), edgeTo((c + 2) % 3));
            const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
            sums[groups[v]][size_t(frames[t].hand)] += angle * projected(frames[t].tangent, normal);
        }
    }
    return sums;
}

/// Which hand each vertex gets. A vertex that both hands use is split: the copy, at the end, is the left one's.
std::vector<Hand> splitByHand(Mesh& mesh, const std::vector<TriangleFrame>& frames, std::vector<uint32_t>& groups) {
    const size_t count = mesh.vertices.size();
    std::vector<std::array<bool, 2>> used(count, {false, false});
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const Hand hand = frames[i / 3].hand;
        if (hand != Hand::none) used[mesh.indices[i]][size_t(hand)] = true;
    }
    std::vector<Hand> hands(count);
    std::vector<uint32_t> leftCopy(count);
    for (uint32_t v = 0; v < count; ++v) {
        const auto [right, left] = used[v];
        hands[v] = right ? Hand::right : left ? Hand::left : Hand::none;
        leftCopy[v] = v;
        if (!right || !left) continue;
        leftCopy[v] = uint32_t(mesh.vertices.size());
        mesh.vertices.push_back(Vertex(mesh.vertices[v]));
        groups.push_back(groups[v]);
        hands.push_back(Hand::left);
    }
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        if (frames[i / 3].hand == Hand::left) mesh.indices[i] = leftCopy[mesh.indices[i]];
    }
    return hands;
}

}  // namespace

void deriveTangents(Mesh& mesh, uint32_t uvSet) {
    std::vector<uint32_t> groups = weld(mesh, uvSet);
    std::vector<TriangleFrame> frames;
    frames.reserve(mesh.indices.size() / 3);
    for (size_t i = 0; i < mesh.indices.size(); i += 3) frames.push_back(frameOf(mesh, i, uvSet));
    const auto sums = sumTangents(mesh, frames, groups);
    const std::vector<Hand> hands = splitByHand(mesh, frames, groups);
    for (size_t v = 0; v < mesh.vertices.size(); ++v) {
        Vertex& vertex = mesh.vertices[v];
        const bool left = hands[v] == Hand::left;
        const dvec3 tangent = unitOrZero(sums[groups[v]][left ? 1 : 0]);
        vertex.tangent = tangent == dvec3(0) ? anyTangent(vertex.normal) : vec4(vec3(tangent), left ? -1.0f : 1.0f);
    }
}

}  // namespace luciole::gltf
