#pragma once
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <luciole/scene.hpp>

/// Meshes of the built-in scenes. All are in metres, +Y up, with unit normals, tangents along +u and UVs in metres.
namespace luciole::shapes {

/// Appends `part`, placed by a similarity or affine transform with positive determinant.
void append(Mesh& mesh, const Mesh& part, const mat4& transform = mat4(1));

/// A grid of nu x nv quads over `position(u, v)`, u and v in [0, 1], which faces cross(d/du, d/dv). Quads that
/// collapse to a line leave no triangles. Normals and tangents come from central differences.
/// \param position callable (double, double) -> dvec3, smooth over the patch
/// \param uvSize UV at (1, 1); UV is (0, 0) at (0, 0)
template <class Position>
Mesh patch(int nu, int nv, const Position& position, vec2 uvSize);

/// Flat rectangle origin + u * [0, 1] + v * [0, 1], facing cross(u, v).
Mesh rectangle(vec3 origin, vec3 u, vec3 v, int nu = 1, int nv = 1);

/// Axis-aligned box, 12 triangles.
Mesh box(vec3 low, vec3 high);

/// Sphere around the origin; 2 * segments * (rings - 1) triangles.
Mesh sphere(float radius, int segments, int rings);

/// Octahedron with smooth normals around the origin, 8 triangles: a lamp seen from afar.
Mesh bead(float radius);

/// Surface of revolution about +Y. \param profile (radius, height) from bottom to top, outside to the right of the
/// way; a point given twice is a sharp edge
Mesh lathe(std::span<const vec2> profile, int segments);

/// A rounded profile through `points` (Catmull-Rom) with `steps` pieces between two; doubled points stay sharp.
std::vector<vec2> smoothProfile(std::span<const vec2> points, int steps);

/// Tapered limb from `a` to `b`, open at both ends.
Mesh limb(vec3 a, vec3 b, float radiusA, float radiusB, int segments);

/// Opening of an arch in a wall: as wide as 2 * radius, straight up to `spring`, round above.
struct Arch {
    float radius = 1;
    float spring = 2;
    float foot = 0;  ///< height where the opening begins
    int steps = 8;   ///< pieces of the half circle
};

/// Wall in the plane z = 0 that faces +Z, x in [-width / 2, width / 2], y in [bottom, top], with an arched opening.
Mesh archedWall(const Arch& arch, float width, float bottom, float top);

/// Inner side of the opening from z = 0 back to z = -depth: jambs, soffit, and a sill where foot > 0.
Mesh archLining(const Arch& arch, float depth, bool sill);

/// Round moulding along the half circle of the arch, standing out of z = 0. \param around pieces round the section
Mesh archMoulding(const Arch& arch, float offset, float radius, int around);

/// Recess behind an arched opening: half a cylinder closed by a quarter of a sphere, with a floor at `foot`.
/// `arch.steps` is even, so that the recess meets the opening point by point.
Mesh niche(const Arch& arch);

}  // namespace luciole::shapes

namespace luciole::shapes {

template <class Position>
Mesh patch(int nu, int nv, const Position& position, vec2 uvSize) {
    constexpr double kStep = 1e-4;
    const auto clampInside = [](double x) { return glm::clamp(x, 2 * kStep, 1 - 2 * kStep); };
    Mesh mesh;
    mesh.vertices.reserve(size_t(nu + 1) * size_t(nv + 1));
    for (int j = 0; j <= nv; ++j)
        for (int i = 0; i <= nu; ++i) {
            const double u = double(i) / nu, v = double(j) / nv;
            // One step inside the patch, so that a pole still has a direction.
            const double uIn = clampInside(u), vIn = clampInside(v);
            const dvec3 du = position(uIn + kStep, vIn) - position(uIn - kStep, vIn);
            const dvec3 dv = position(uIn, vIn + kStep) - position(uIn, vIn - kStep);
            const dvec3 normal = glm::normalize(glm::cross(du, dv));
            const dvec3 tangent = glm::normalize(du - normal * glm::dot(normal, du));
            mesh.vertices.push_back({.position = vec3(position(u, v)),
                                     .normal = vec3(normal),
                                     .tangent = vec4(vec3(tangent), 1),
                                     .uv0 = vec2(u, v) * uvSize});
        }
    const auto at = [&](int i, int j) { return uint32_t(j * (nu + 1) + i); };
    const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) {
        const vec3 p = mesh.vertices[a].position, q = mesh.vertices[b].position, r = mesh.vertices[c].position;
        const float collapsed = 1e-6f;
        if (glm::distance(p, q) < collapsed || glm::distance(q, r) < collapsed || glm::distance(r, p) < collapsed)
            return;
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    };
    for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i) {
            triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    return mesh;
}

}  // namespace luciole::shapes
