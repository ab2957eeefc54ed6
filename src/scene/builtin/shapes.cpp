#include "scene/builtin/shapes.hpp"

#include <algorithm>
#include <array>

#include <glm/gtc/matrix_transform.hpp>

namespace luciole::shapes {

namespace {

/// Rectangle in the plane z = 0 that faces +Z, UV = position.
void appendFlat(Mesh& mesh, std::array<vec2, 4> corners) {
    const auto first = uint32_t(mesh.vertices.size());
    for (const vec2 corner : corners) mesh.vertices.push_back({.position = vec3(corner, 0), .uv0 = corner});
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

void appendFlat(Mesh& mesh, vec2 low, vec2 high) {
    if (high.x - low.x < 1e-6f || high.y - low.y < 1e-6f) return;
    appendFlat(mesh, {vec2(low.x, low.y), vec2(high.x, low.y), vec2(high.x, high.y), vec2(low.x, high.y)});
}

dvec2 onArch(const Arch& arch, double radius, double v) {
    return {radius * std::cos(kPi * v), arch.spring + radius * std::sin(kPi * v)};
}

/// A run of a profile between sharp edges, turned about +Y.
void appendTurned(Mesh& mesh, std::span<const vec2> run, int segments, float vStart) {
    const auto first = uint32_t(mesh.vertices.size());
    const auto outward = [&](size_t i) {
        const vec2 along = run[std::min(i + 1, run.size() - 1)] - run[i == 0 ? 0 : i - 1];
        return glm::normalize(vec2(along.y, -along.x));
    };
    float v = vStart;
    for (size_t j = 0; j < run.size(); ++j) {
        if (j > 0) v += glm::distance(run[j], run[j - 1]);
        const vec2 normal = outward(j);
        for (int i = 0; i <= segments; ++i) {
            const double angle = 2 * kPi * (i % segments) / segments;
            const vec2 turn(float(std::cos(angle)), float(-std::sin(angle)));
            mesh.vertices.push_back({.position = {run[j].x * turn.x, run[j].y, run[j].x * turn.y},
                                     .normal = glm::normalize(vec3(normal.x * turn.x, normal.y, normal.x * turn.y)),
                                     .tangent = vec4(turn.y, 0, -turn.x, 1),
                                     .uv0 = {float(i) / float(segments), v}});
        }
    }
    const auto at = [&](size_t i, size_t j) { return first + uint32_t(j * size_t(segments + 1) + i); };
    for (size_t j = 0; j + 1 < run.size(); ++j)
        for (size_t i = 0; i < size_t(segments); ++i) {
            if (run[j].x > 0) mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            if (run[j + 1].x > 0) mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
}

/// Calls `use` with each run of `points` between doubled points.
template <class Use>
void forEachRun(std::span<const vec2> points, const Use& use) {
    size_t start = 0;
    for (size_t i = 1; i <= points.size(); ++i)
        if (i == points.size() || points[i] == points[i - 1]) {
            if (i - start >= 2) use(points.subspan(start, i - start));
            start = i;
        }
}

}  // namespace

void append(Mesh& mesh, const Mesh& part, const mat4& transform) {
    const auto first = uint32_t(mesh.vertices.size());
    const mat3 linear(transform);
    const mat3 forNormals = glm::transpose(glm::inverse(linear));
    for (Vertex vertex : part.vertices) {
        vertex.position = vec3(transform * vec4(vertex.position, 1));
        vertex.normal = glm::normalize(forNormals * vertex.normal);
        vertex.tangent = vec4(glm::normalize(linear * vec3(vertex.tangent)), vertex.tangent.w);
        mesh.vertices.push_back(vertex);
    }
    for (const uint32_t index : part.indices) mesh.indices.push_back(first + index);
}

Mesh rectangle(vec3 origin, vec3 u, vec3 v, int nu, int nv) {
    const dvec3 o(origin), du(u), dv(v);
    return patch(nu, nv, [&](double s, double t) { return o + s * du + t * dv; }, {glm::length(u), glm::length(v)});
}

Mesh box(vec3 low, vec3 high) {
    const vec3 size = high - low;
    const vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    Mesh mesh;
    append(mesh, rectangle(low + z, x, y));
    append(mesh, rectangle(low + x, -x, y));
    append(mesh, rectangle(low + x + z, -z, y));
    append(mesh, rectangle(low, z, y));
    append(mesh, rectangle(low + y + z, x, -z));
    append(mesh, rectangle(low, x, z));
    return mesh;
}

Mesh sphere(float radius, int segments, int rings) {
    const auto onSphere = [=](double u, double v) {
        const double longitude = 2 * kPi * u, latitude = kPi * (v - 0.5);
        return double(radius) * dvec3(std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                                      -std::cos(latitude) * std::sin(longitude));
    };
    return patch(segments, rings, onSphere, radius * vec2(2 * kPi, kPi));
}

Mesh bead(float radius) {
    Mesh mesh;
    constexpr std::array<vec3, 6> kCorners = {vec3{1, 0, 0}, vec3{0, 0, -1}, vec3{-1, 0, 0},
                                              vec3{0, 0, 1}, vec3{0, 1, 0},  vec3{0, -1, 0}};
    for (const vec3 corner : kCorners)
        mesh.vertices.push_back({.position = radius * corner,
                                 .normal = corner,
                                 .tangent = vec4(corner.y == 0 ? vec3(corner.z, 0, -corner.x) : vec3(1, 0, 0), 1)});
    for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t j = (i + 1) % 4;
        mesh.indices.insert(mesh.indices.end(), {i, j, 4, j, i, 5});
    }
    return mesh;
}

Mesh lathe(std::span<const vec2> profile, int segments) {
    Mesh mesh;
    float v = 0;
    forEachRun(profile, [&](std::span<const vec2> run) {
        appendTurned(mesh, run, segments, v);
        for (size_t i = 1; i < run.size(); ++i) v += glm::distance(run[i], run[i - 1]);
    });
    return mesh;
}

std::vector<vec2> smoothProfile(std::span<const vec2> points, int steps) {
    std::vector<vec2> smooth;
    forEachRun(points, [&](std::span<const vec2> run) {
        for (size_t i = 0; i + 1 < run.size(); ++i) {
            const vec2 b = run[i], c = run[i + 1];
            const vec2 a = i > 0 ? run[i - 1] : 2.0f * b - c;
            const vec2 d = i + 2 < run.size() ? run[i + 2] : 2.0f * c - b;
            for (int k = 0; k < steps; ++k) {
                const float t = float(k) / float(steps);
                const vec2 p =
                    b +
                    0.5f * t * ((c - a) + t * ((2.0f * a - 5.0f * b + 4.0f * c - d) + t * (3.0f * (b - c) + d - a)));
                smooth.push_back({std::max(p.x, 0.0f), p.y});
            }
        }
        smooth.push_back(run.back());
    });
    return smooth;
}

Mesh limb(vec3 a, vec3 b, float radiusA, float radiusB, int segments) {
    const dvec3 axis = glm::normalize(dvec3(b - a));
    const dvec3 side = glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
    const dvec3 other = glm::cross(axis, side);
    const auto around = [&](double u, double v) {
        const double angle = 2 * kPi * u;
        return glm::mix(dvec3(a), dvec3(b), v) +
               glm::mix(double(radiusA), double(radiusB), v) * (std::cos(angle) * side + std::sin(angle) * other);
    };
    return patch(segments, 1, around, {2 * float(kPi) * radiusA, glm::distance(a, b)});
}

Mesh archedWall(const Arch& arch, float width, float bottom, float top) {
    Mesh mesh;
    const float half = width / 2, r = arch.radius;
    // Cut at the heights of foot and spring, so that neighbours share whole edges.
    const std::array<float, 4> heights = {bottom, arch.foot, arch.spring, top};
    for (size_t i = 0; i + 1 < heights.size(); ++i) {
        appendFlat(mesh, {-half, heights[i]}, {-r, heights[i + 1]});
        appendFlat(mesh, {r, heights[i]}, {half, heights[i + 1]});
    }
    appendFlat(mesh, {-r, bottom}, {r, arch.foot});
    for (int i = 0; i < arch.steps; ++i) {
        const vec2 right(onArch(arch, r, double(i) / arch.steps)), left(onArch(arch, r, double(i + 1) / arch.steps));
        appendFlat(mesh, {left, right, vec2(right.x, top), vec2(left.x, top)});
    }
    return mesh;
}

Mesh archLining(const Arch& arch, float depth, bool sill) {
    const float r = arch.radius;
    const auto soffit = [&](double u, double v) { return dvec3(onArch(arch, r, v), depth * (u - 1)); };
    Mesh mesh = patch(1, arch.steps, soffit, {depth, float(kPi) * r});
    if (const float height = arch.spring - arch.foot; height > 0) {
        append(mesh, rectangle({r, arch.foot, -depth}, {0, 0, depth}, {0, height, 0}));
        append(mesh, rectangle({-r, arch.foot, 0}, {0, 0, -depth}, {0, height, 0}));
    }
    if (sill) append(mesh, rectangle({-r, arch.foot, 0}, {2 * r, 0, 0}, {0, 0, -depth}));
    return mesh;
}

Mesh archMoulding(const Arch& arch, float offset, float radius, int around) {
    const auto section = [&](double u, double v) {
        const double angle = kPi * (1 - u);
        return dvec3(onArch(arch, arch.radius + offset + radius * std::cos(angle), v), radius * std::sin(angle));
    };
    return patch(around, arch.steps, section, float(kPi) * vec2(radius, arch.radius));
}

Mesh niche(const Arch& arch) {
    const double r = arch.radius;
    const auto turned = [](double radius, double y, double u) {
        return dvec3(-radius * std::cos(kPi * u), y, -radius * std::sin(kPi * u));
    };
    const vec2 size(float(kPi) * arch.radius, arch.spring - arch.foot);
    Mesh mesh = patch(
        arch.steps, 1,
        [&](double u, double v) { return turned(r, glm::mix(double(arch.foot), double(arch.spring), v), u); }, size);
    append(mesh, patch(
                     arch.steps, arch.steps / 2,
                     [&](double u, double v) {
                         return turned(r * std::cos(0.5 * kPi * v), arch.spring + r * std::sin(0.5 * kPi * v), u);
                     },
                     size));
    append(mesh, patch(
                     arch.steps, 1, [&](double u, double v) { return turned(r * v, arch.foot, u); }, size));
    return mesh;
}

}  // namespace luciole::shapes
