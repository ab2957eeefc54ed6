#include "scene/gltf/nodes.hpp"

#include <cfloat>
#include <cmath>
#include <vector>

#include <glm/gtc/quaternion.hpp>

namespace luciole::gltf {

namespace {

/// 16 numbers, column by column.
dmat4 matrixOf(const JsonNode& json) {
    if (!json.isArray() || json.size() != 16) json.fail("an array of 16 numbers");
    dmat4 m(1);
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = json[size_t(i)].number();
    const dvec4 lastRow(m[0].w, m[1].w, m[2].w, m[3].w);
    constexpr double kRounding = 1e-4;  // what exporters that multiply in float leave in the last row
    if (glm::length(lastRow - dvec4(0, 0, 0, 1)) > kRounding) json.failWith("expected a last row of 0, 0, 0, 1");
    m[0].w = m[1].w = m[2].w = 0;
    m[3].w = 1;
    return m;
}

dmat4 rotationOf(const JsonNode& json, Warnings& warnings) {
    const dvec4 xyzw = vectorOf<4>(json);
    const double length = glm::length(xyzw);
    if (length > 0) return glm::mat4_cast(glm::dquat(xyzw.w, xyzw.x, xyzw.y, xyzw.z) / length);
    warnings.add(fmt::format("{}: a quaternion of zeros is taken as no rotation", json.path()));
    return dmat4(1);
}

dmat4 parentFromNode(const JsonNode& node, Warnings& warnings) {
    if (const auto matrix = node.find("matrix")) return matrixOf(*matrix);
    const dvec3 scale = vectorOr<3>(node, "scale", dvec3(1));
    const auto rotation = node.find("rotation");
    dmat4 m = rotation ? rotationOf(*rotation, warnings) : dmat4(1);
    for (int i = 0; i < 3; ++i) m[i] *= scale[i];
    m[3] = dvec4(vectorOr<3>(node, "translation", dvec3(0)), 1);
    return m;
}

/// The parent of each node, kNone for roots.
std::vector<uint32_t> parentsOf(const JsonNode& root) {
    const auto nodes = root.find("nodes");
    if (!nodes) return {};
    std::vector<uint32_t> parents(nodes->size(), kNone);
    for (size_t i = 0; i < parents.size(); ++i) {
        const auto children = (*nodes)[i].find("children");
        for (size_t k = 0; children && k < children->size(); ++k) {
            const JsonNode reference = (*children)[k];
            const uint32_t child = indexInto(root, "nodes", reference);
            if (parents[child] != kNone) {
                reference.failWith(fmt::format("expected a node without a parent, got node {}, a child of node {}",
                                               child, parents[child]));
            }
            parents[child] = uint32_t(i);
        }
    }
    return parents;
}

/// The roots of what is shown. As each node has one parent at most and these have none, no circle can be reached.
std::vector<uint32_t> rootsOf(const JsonNode& root) {
    const std::vector<uint32_t> parents = parentsOf(root);
    std::vector<uint32_t> roots;
    const auto scene = defaultScene(root);
    if (!scene) {
        for (uint32_t i = 0; i < parents.size(); ++i) {
            if (parents[i] == kNone) roots.push_back(i);
        }
        return roots;
    }
    const auto references = scene->find("nodes");
    std::vector<bool> listed(parents.size(), false);
    for (size_t i = 0; references && i < references->size(); ++i) {
        const JsonNode reference = (*references)[i];
        const uint32_t node = indexInto(root, "nodes", reference);
        if (parents[node] != kNone) {
            reference.failWith(
                fmt::format("expected a root node, got node {}, a child of node {}", node, parents[node]));
        }
        if (listed[node]) reference.failWith(fmt::format("expected each node once, got node {} twice", node));
        listed[node] = true;
        roots.push_back(node);
    }
    return roots;
}

}  // namespace

std::optional<JsonNode> defaultScene(const JsonNode& root) {
    if (const auto reference = root.find("scene")) return resolve(root, "scenes", *reference);
    const auto scenes = root.find("scenes");
    if (!scenes || scenes->size() == 0) return std::nullopt;
    return (*scenes)[0];
}

void forEachNode(const JsonNode& root, Warnings& warnings, const std::function<void(const PlacedNode&)>& visit) {
    struct Pending {
        uint32_t node;
        dmat4 worldFromParent;
    };
    std::vector<Pending> stack;  // not the call stack, which a deep tree would overflow
    const std::vector<uint32_t> roots = rootsOf(root);
    for (size_t i = roots.size(); i-- > 0;) stack.push_back({roots[i], dmat4(1)});
    while (!stack.empty()) {
        const Pending pending = stack.back();
        stack.pop_back();
        const JsonNode json = root.at("nodes")[pending.node];
        const dmat4 worldFromNode = pending.worldFromParent * parentFromNode(json, warnings);
        visit({json, stringOr(json, "name", fmt::format("node {}", pending.node)), worldFromNode});
        const auto children = json.find("children");
        for (size_t k = children ? children->size() : 0; k-- > 0;) {
            stack.push_back({indexInto(root, "nodes", (*children)[k]), worldFromNode});
        }
    }
}

bool isInvertible(const dmat4& m) {
    double volume = 1;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 3; ++r) {
            if (!(std::abs(m[c][r]) <= double(FLT_MAX))) return false;
        }
        if (c < 3) volume *= glm::length(dvec3(m[c]));
    }
    constexpr double kLeastSine = 1e-7;  // between the axes; below it, a float matrix has no inverse to speak of
    const double determinant = std::abs(glm::determinant(dmat3(m)));
    return determinant > double(FLT_MIN) && determinant <= double(FLT_MAX) && determinant > kLeastSine * volume;
}

}  // namespace luciole::gltf
