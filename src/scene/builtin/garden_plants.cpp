#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/builtin/garden.hpp"
#include "scene/builtin/shapes.hpp"

namespace luciole::garden {

namespace {

const vec3 kUp(0, 1, 0);

float between(Random& random, double low, double high) { return float(random.between(low, high)); }

vec3 unitVector(Random& random) {
    const float y = between(random, -1, 1), angle = between(random, 0, 2 * kPi);
    const float r = std::sqrt(1 - y * y);
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

/// Any unit vector square to `normal`.
vec3 squareTo(vec3 normal) {
    return glm::normalize(glm::cross(normal, std::abs(normal.y) < 0.9f ? kUp : vec3(1, 0, 0)));
}

/// A blade of grass: a strip of `pieces` quads and a tip, bent over by `bend`. Its normals lean upwards, so that light
/// wraps around the tuft as a whole.
void addBlade(Mesh& mesh, vec3 root, vec3 lean, float length, float width, float bend, int pieces, vec3 dark,
              vec3 light) {
    const vec3 across = glm::normalize(glm::cross(lean, kUp));
    const auto first = uint32_t(mesh.vertices.size());
    const auto add = [&](float t, float side) {
        const vec3 at = root + length * (t * (1 - 0.35f * bend * t) * kUp + bend * t * t * lean);
        const vec3 normal = glm::normalize(kUp + 0.8f * (lean - bend * t * kUp) + 0.4f * side * across);
        mesh.vertices.push_back({.position = at + side * 0.5f * width * (1 - t * t) * across,
                                 .normal = normal,
                                 .tangent = vec4(glm::normalize(across - normal * glm::dot(normal, across)), 1),
                                 .uv0 = {0.5f + 0.5f * side, t},
                                 .color = vec4(glm::mix(dark, light, t), 1)});
    };
    for (int i = 0; i < pieces; ++i) {
        add(float(i) / float(pieces), -1);
        add(float(i) / float(pieces), 1);
    }
    add(1, 0);
    for (uint32_t i = 0; i + 1 < uint32_t(pieces); ++i) {
        const uint32_t a = first + 2 * i;
        mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
    }
    const uint32_t last = first + 2 * uint32_t(pieces - 1);
    mesh.indices.insert(mesh.indices.end(), {last, last + 1, last + 2});
}

vec3 around(Random& random) {
    const float angle = between(random, 0, 2 * kPi);
    return {std::cos(angle), 0, std::sin(angle)};
}

/// A leaf: a rhombus folded along its middle.
void addLeaf(Mesh& mesh, vec3 root, vec3 along, vec3 normal, float size, vec3 color) {
    const vec3 side = glm::normalize(glm::cross(normal, along));
    const vec3 fold = 0.12f * size * normal;
    const std::array<vec3, 4> corners = {root, root + size * (0.45f * along + 0.3f * side) + fold, root + size * along,
                                         root + size * (0.45f * along - 0.3f * side) + fold};
    const auto first = uint32_t(mesh.vertices.size());
    const vec4 tangent(glm::normalize(along - normal * glm::dot(normal, along)), 1);
    for (const vec3 corner : corners)
        mesh.vertices.push_back({.position = corner, .normal = normal, .tangent = tangent, .color = vec4(color, 1)});
    mesh.indices.insert(mesh.indices.end(), {first, first + 2, first + 1, first, first + 3, first + 2});
}

/// Grows one tree: limbs that fork and thin out, leaves around the thin ones.
class Grower {
public:
    Grower(Random random, float height, vec3 tint, int levels)
        : random_(random), height_(height), tint_(tint), levels_(levels) {}

    Tree grow() {
        const float girth = 0.034f * height_;
        limb(vec3(0, -0.1f, 0), glm::normalize(vec3(between(random_, -0.2, 0.2), 1, between(random_, -0.2, 0.2))),
             0.3f * height_, girth, 0);
        return std::move(tree_);
    }

private:
    void limb(vec3 from, vec3 direction, float length, float radius, int level) {
        const vec3 bent = glm::normalize(direction + 0.25f * unitVector(random_));
        const vec3 middle = from + 0.5f * length * direction, to = middle + 0.5f * length * bent;
        const int segments = level < 2 ? 9 : level < 4 ? 5 : 3;
        const float end = radius * 0.68f;
        if (level < levels_ - 1) {
            const float knee = 0.84f * radius, foot = radius * (level == 0 ? 1.5f : 1.0f);
            shapes::append(tree_.wood, shapes::limb(from, middle, foot, knee, segments));
            shapes::append(tree_.wood, shapes::limb(middle, to, knee, end, segments));
        } else {
            shapes::append(tree_.wood, shapes::limb(from, to, radius, end, segments));
        }
        if (level >= levels_ - 2) leaves(middle, to);
        if (level == levels_) return;
        const int forks = level == 0 ? 4 : level < 3 ? 3 : 2;
        const float start = between(random_, 0, 2 * kPi);
        for (int i = 0; i < forks; ++i)
            fork(to, bent, start + 2 * float(kPi) * float(i) / float(forks), length, end, level);
    }

    void fork(vec3 from, vec3 axis, float turn, float length, float radius, int level) {
        const vec3 side = squareTo(axis), other = glm::cross(axis, side);
        const float open = between(random_, 0.45, 0.95);
        vec3 direction = std::cos(open) * axis + std::sin(open) * (std::cos(turn) * side + std::sin(turn) * other);
        // Boughs spread to the sides; twigs don't hang.
        direction.y = direction.y * 0.8f + (level > 1 ? 0.12f : 0.0f);
        limb(from, glm::normalize(direction), length * between(random_, 0.6, 0.8), radius * between(random_, 0.62, 0.8),
             level + 1);
    }

    void leaves(vec3 from, vec3 to) {
        // A coarser tree has fewer limbs and larger leaves.
        const int perLimb = levels_ < 5 ? 13 : 12;
        const float size = (levels_ < 5 ? 0.034f : 0.026f) * height_;
        const vec3 heart(0, 0.62f * height_, 0);
        for (int i = 0; i < perLimb; ++i) {
            const vec3 root = glm::mix(from, to, between(random_, 0, 1)) + 0.028f * height_ * unitVector(random_);
            // Leaves face outwards from the crown, so that its shape shows in the light.
            const vec3 normal = glm::normalize(glm::normalize(root - heart) + 0.5f * kUp + 0.7f * unitVector(random_));
            const vec3 along = glm::normalize(glm::cross(normal, unitVector(random_)));
            const float depth = glm::clamp(glm::distance(root, heart) / (0.42f * height_), 0.35f, 1.0f);
            const vec3 color =
                tint_ * depth *
                vec3(between(random_, 0.7, 1.15), between(random_, 0.7, 1.15), between(random_, 0.7, 1.1));
            addLeaf(tree_.leaves, root, along, normal, size * between(random_, 0.8, 1.5), glm::min(color, vec3(1)));
        }
    }

    Random random_;
    float height_;
    vec3 tint_;
    int levels_;
    Tree tree_;
};

}  // namespace

Mesh grassTuft(Random random) {
    Mesh mesh;
    for (int i = 0; i < 14; ++i) {
        const vec3 root = 0.16f * std::sqrt(between(random, 0, 1)) * around(random);
        const vec3 light = glm::mix(vec3(0.12f, 0.24f, 0.05f), vec3(0.3f, 0.34f, 0.1f), between(random, 0, 1));
        addBlade(mesh, root, around(random), between(random, 0.16, 0.42), between(random, 0.011, 0.02),
                 between(random, 0.15, 0.7), 3, 0.25f * light, light);
    }
    return mesh;
}

Mesh reeds(Random random) {
    Mesh mesh;
    for (int i = 0; i < 16; ++i) {
        const vec3 root = 0.2f * std::sqrt(between(random, 0, 1)) * around(random);
        const vec3 light(0.14f, 0.25f, 0.09f);
        addBlade(mesh, root, around(random), between(random, 0.6, 1.25), between(random, 0.016, 0.026),
                 between(random, 0.05, 0.4), 5, 0.3f * light, light);
    }
    return mesh;
}

Mesh stone(Random random) {
    std::array<vec4, 7> bumps;  // direction and phase
    for (vec4& bump : bumps) bump = vec4(unitVector(random) * between(random, 1.5, 5), between(random, 0, 2 * kPi));
    const auto surface = [&](double u, double v) {
        const double longitude = 2 * kPi * u, latitude = kPi * (v - 0.5);
        const dvec3 n(std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                      -std::cos(latitude) * std::sin(longitude));
        double radius = 1;
        for (const vec4 bump : bumps) radius += 0.055 * std::sin(glm::dot(dvec3(bump), n) + double(bump.w));
        return radius * n * dvec3(1, 0.62, 0.85);
    };
    Mesh mesh = shapes::patch(14, 8, surface, {6, 3});
    for (Vertex& vertex : mesh.vertices) {
        const float moss = glm::smoothstep(0.55f, 1.25f, vertex.normal.y + 0.35f * std::sin(7 * vertex.position.x));
        vertex.color = vec4(glm::mix(vec3(0.2f, 0.19f, 0.185f), vec3(0.12f, 0.19f, 0.06f), moss), 1);
    }
    return mesh;
}

Mesh lilyPad() {
    const auto leaf = [](double u, double v) {
        const double angle = 0.22 + (2 * kPi - 0.44) * u, radius = 0.02 + 0.98 * v;
        return dvec3(radius * std::cos(angle), 0.03 * v * v, -radius * std::sin(angle));
    };
    // d/du runs around, d/dv outwards: turn the patch over to face up.
    return shapes::patch(18, 2, [&](double u, double v) { return leaf(1 - u, v); }, {1, 1});
}

Mesh lotus() {
    Mesh mesh;
    for (int ring = 0; ring < 3; ++ring)
        for (int i = 0; i < 8; ++i) {
            const float rise = 0.35f + 0.45f * float(ring), turn = (float(i) + 0.5f * float(ring)) * float(kPi) / 4;
            const auto petal = [&](double u, double v) {
                const double half = 0.3 * std::sin(kPi * std::pow(0.05 + 0.93 * v, 0.8)) * (2 * u - 1);
                const double bend = double(rise) * (0.4 + 0.9 * v);
                return dvec3(half, v * std::sin(bend) + 0.25 * half * half, v * std::cos(bend));
            };
            const vec3 color = glm::mix(vec3(0.75f, 0.28f, 0.4f), vec3(0.85f, 0.6f, 0.62f), float(ring) / 2);
            Mesh one = shapes::patch(2, 4, [&](double u, double v) { return petal(1 - u, v); }, {1, 1});
            for (Vertex& vertex : one.vertices) vertex.color = vec4(color * (0.55f + 0.45f * vertex.uv0.y), 1);
            shapes::append(mesh, one, glm::rotate(mat4(1), turn, kUp));
        }
    return mesh;
}

Tree tree(Random random, float height, vec3 tint, int levels) { return Grower(random, height, tint, levels).grow(); }

}  // namespace luciole::garden
