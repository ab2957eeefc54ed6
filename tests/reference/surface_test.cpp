#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <utility>

#include "reference/surface.hpp"
#include "scene_building.hpp"

using namespace luciole;
using namespace luciole::reference;
using namespace luciole::test;
using doctest::Approx;

namespace {

struct Fixture {
    Scene scene;
    View view;
    CameraRays rays{view};
    Visibility visibility{scene};

    Fixture(Scene s, View v) : scene(std::move(s)), view(v) {}

    /// The footprint's sum over a vertex attribute at a pixel, for each of: value, dx, dy.
    template <typename Attribute>
    std::array<dvec2, 3> at(uint32_t x, uint32_t y, Attribute attribute) const {
        const Ray ray = rays.through(x, y);
        const auto hit = visibility.closest(ray.origin, ray.direction);
        REQUIRE(hit);
        const auto footprint = footprintOf(rays, x, y, *hit, visibility.triangleWorld(hit->object, hit->triangle));
        const Mesh& mesh = scene.meshes[0];
        const auto sum = [&](dvec3 weights) {
            dvec2 total(0);
            for (int i = 0; i < 3; ++i)
                total += weights[i] * attribute(mesh.vertices[mesh.indices[3 * size_t(hit->triangle) + size_t(i)]]);
            return total;
        };
        return {sum(footprint.weights), sum(footprint.dx), sum(footprint.dy)};
    }
};

dvec2 uvOf(const Vertex& vertex) { return dvec2(vertex.uv0); }

}  // namespace

TEST_CASE("footprint: on an orthographic picture of a quad, texture coordinates change by one pixel's share") {
    const Fixture fixture(sceneOf(quad(), {}), {.camera = frontOrthographicCamera(), .extent = {10, 10}});
    const auto [uv, dx, dy] = fixture.at(7, 2, uvOf);
    CHECK(length(uv - dvec2(0.75, 0.25)) < 1e-12);
    CHECK(length(dx - dvec2(0.1, 0)) < 1e-12);
    CHECK(length(dy - dvec2(0, 0.1)) < 1e-12);
}

TEST_CASE("footprint: in perspective, differences are taken between the rays of the pixel's own 2 x 2 block") {
    // A floor one metre below the eye, which looks along -Z: pixel row y meets it at z = -1 / slope(y), texture
    // coordinate v = z / 40 + 0.5 (the quad is 40 m wide), u = x / 40 + 0.5.
    const mat4 floor = glm::translate(mat4(1), vec3(0, -1, 0)) * glm::rotate(mat4(1), float(-kPi / 2), vec3(1, 0, 0));
    const View view{.camera = frontCamera(0, float(kPi / 2)), .extent = {16, 16}};
    const Fixture fixture(sceneOf(quad(20), {}, floor), view);
    const auto slope = [](uint32_t row) { return (row + 0.5) / 8 - 1; };
    const auto v = [&](uint32_t row) { return -1 / slope(row) / 40 + 0.5; };
    const auto u = [&](uint32_t column, uint32_t row) { return slope(column) / slope(row) / 40 + 0.5; };
    for (const uint32_t row : {10u, 11u, 15u}) {
        for (const uint32_t column : {2u, 3u, 12u}) {
            const auto [uv, dx, dy] = fixture.at(column, row, uvOf);
            const uint32_t top = row & ~1u, left = column & ~1u;
            // The rotation and the camera are floats: 1e-7 of coordinates that reach 16 m, in units of 40 m.
            CHECK(length(uv - dvec2(u(column, row), v(row))) < 1e-6);
            CHECK(length(dx - dvec2(u(left + 1, row) - u(left, row), 0)) < 1e-6);
            CHECK(length(dy - dvec2(u(column, top + 1) - u(column, top), v(top + 1) - v(top))) < 1e-6);
        }
    }
}

TEST_CASE("footprint: a neighbour's ray that runs along the plane gives finite numbers") {
    // The eye lies in the plane, and so does every ray of row 1.
    const CameraRays rays({.camera = frontCamera(0), .extent = {3, 3}});
    const std::array<dvec3, 3> plane{dvec3(-1, 0, -2), dvec3(1, 0, -2), dvec3(0, 0, -5)};
    const Footprint footprint = footprintOf(rays, 1, 1, {.u = 0.25, .v = 0.5}, plane);
    for (const dvec3 weights : {footprint.weights, footprint.dx, footprint.dy})
        for (int i = 0; i < 3; ++i) CHECK(std::isfinite(weights[i]));
}
