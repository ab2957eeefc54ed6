#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "scene/visibility.hpp"
#include "scene_building.hpp"

using namespace luciole;
using namespace luciole::test;
using doctest::Approx;

TEST_CASE("visibility: a ray meets a quad at the point, distance and side that geometry says") {
    const Scene scene = sceneOf(quad(2), {});
    const auto hit = Visibility(scene).closest({0.5, -1.25, 3}, {0, 0, -2});
    REQUIRE(hit);
    CHECK(hit->object == 0);
    CHECK(hit->t == 1.5);
    CHECK(hit->frontFace);
    const auto corner = Visibility(scene).triangleWorld(0, hit->triangle);
    const dvec3 point = (1 - hit->u - hit->v) * corner[0] + hit->u * corner[1] + hit->v * corner[2];
    CHECK(length(point - dvec3(0.5, -1.25, 0)) < 1e-14);
}

TEST_CASE("visibility: nothing is hit beside the scene, behind the origin or in an empty scene") {
    const Scene scene = sceneOf(quad(), {});
    const Visibility visibility(scene);
    CHECK_FALSE(visibility.closest({1.001, 0, 1}, {0, 0, -1}));
    CHECK_FALSE(visibility.closest({0, 0, 1}, {0, 0, 1}));
    CHECK(visibility.closest({0, 0, 1}, {0, 0, -1}, 1.0));
    CHECK_FALSE(visibility.closest({0, 0, 1}, {0, 0, -1}, 1.0000001));
    const Scene empty;
    CHECK_FALSE(Visibility(empty).closest({0, 0, 1}, {0, 0, -1}));
}

TEST_CASE("visibility: back faces are there for double-sided materials only") {
    Scene scene = sceneOf(quad(), {});
    CHECK_FALSE(Visibility(scene).closest({0, 0, -1}, {0, 0, 1}));
    scene.materials[0].doubleSided = true;
    const auto hit = Visibility(scene).closest({0, 0, -1}, {0, 0, 1});
    REQUIRE(hit);
    CHECK_FALSE(hit->frontFace);
}

TEST_CASE("visibility: a ray is blocked from either side, within its length only, and by what the caller accepts") {
    const Scene scene = sceneOf(quad(), {});
    const Visibility visibility(scene);
    const auto all = [](const Hit&) { return true; };
    CHECK(visibility.isBlocked({0.1, 0.2, 1}, {0, 0, -1}, 1.0000001, all));
    CHECK(visibility.isBlocked({0.1, 0.2, -1}, {0, 0, 1}, 1.0000001, all));
    CHECK_FALSE(visibility.isBlocked({0.1, 0.2, 1}, {0, 0, -1}, 0.9999999, all));
    CHECK_FALSE(visibility.isBlocked({0.1, 0.2, -1e-9}, {0, 0, -1}, HUGE_VAL, all));
    CHECK_FALSE(visibility.isBlocked({0.1, 0.2, 1}, {0, 0, -1}, 2, [](const Hit&) { return false; }));
    CHECK_FALSE(visibility.isBlocked({1.1, 0.2, 1}, {0, 0, -1}, 2, all));
    const Scene empty;
    CHECK_FALSE(Visibility(empty).isBlocked({0, 0, 1}, {0, 0, -1}, 2, all));
}

TEST_CASE("visibility: a mirrored object is seen from the side where its normals point") {
    const Scene scene = sceneOf(quad(), {}, glm::scale(mat4(1), vec3(-1, 1, 1)));
    const Visibility visibility(scene);
    const auto hit = visibility.closest({0, 0, 1}, {0, 0, -1});
    REQUIRE(hit);
    CHECK(hit->frontFace);
    CHECK_FALSE(visibility.closest({0, 0, -1}, {0, 0, 1}));
}

TEST_CASE("visibility: a ray goes on behind the hits that the caller refuses") {
    Scene scene = sceneOf(quad(), {});
    for (float z : {-1.0f, -2.0f, -3.0f}) {
        scene.objects.push_back(scene.objects[0]);
        scene.objects.back().worldFromObject = glm::translate(mat4(1), vec3(0, 0, z));
    }
    const Visibility visibility(scene);
    const auto hit = visibility.closest({0.1, 0.2, 1}, {0, 0, -1}, 0, [](const Hit& h) { return h.object >= 2; });
    REQUIRE(hit);
    CHECK(hit->object == 2);
    CHECK(hit->t == 3);
    CHECK_FALSE(visibility.closest({0.1, 0.2, 1}, {0, 0, -1}, 0, [](const Hit&) { return false; }));
}

TEST_CASE("visibility: all hits between two distances come the farthest first, coinciding ones in drawing order") {
    Scene scene = sceneOf(quad(), {});
    for (float z : {-2.0f, -1.0f, -2.0f, -3.0f}) {
        scene.objects.push_back(scene.objects[0]);
        scene.objects.back().worldFromObject = glm::translate(mat4(1), vec3(0, 0, z));
    }
    const Visibility visibility(scene);
    const auto objects = [&](double tMin, double tMax, const Visibility::Accept& accept = {}) {
        std::vector<uint32_t> result;
        for (const Hit& hit : visibility.allBetween({0.1, 0.2, 1}, {0, 0, -1}, tMin, tMax, accept))
            result.push_back(hit.object);
        return result;
    };
    CHECK(objects(0, 9) == std::vector<uint32_t>{4, 1, 3, 2, 0});
    CHECK(objects(2, 3) == std::vector<uint32_t>{1, 3, 2});
    CHECK(objects(0, 9, [](const Hit& hit) { return hit.object % 2 == 1; }) == std::vector<uint32_t>{1, 3});
    CHECK(objects(4.5, 9).empty());
}

TEST_CASE("visibility: a ray through an edge or a vertex hits the surface there once, and a fold twice") {
    const auto hits = [](const Visibility& visibility, dvec3 origin, dvec3 direction) {
        return visibility.allBetween(origin, direction, 0, 9).size();
    };
    for (const float angle : {0.0f, 0.3f, 1.1f}) {  // turned, the diagonal is only nearly on the ray
        const Scene scene = sceneOf(quad(), {}, glm::rotate(mat4(1), angle, vec3(0, 1, 0)));
        CHECK(hits(Visibility(scene), {0, 0, 3}, {0, 0, -1}) == 1);
    }
    const Scene round = sceneOf(sphere(), {.doubleSided = true});
    const Visibility visibility(round);
    for (const Vertex& vertex : round.meshes[0].vertices) {  // in at one vertex, out at another
        // At x = 0 lie seam and poles, where the vertices differ by rounding errors and a ray may slip through.
        const dvec3 position(vertex.position);
        if (std::abs(position.x) > 1e-6) CHECK(hits(visibility, 3.0 * position, -position) == 2);
        CHECK(hits(visibility, 3.0 * position, -position) <= 2);
    }
    // A tent of two quads that share the edge x = 0: beside it a ray meets the front of one and the back of the other.
    Mesh tent = quad();
    for (const uint32_t i : {0u, 3u}) tent.vertices[i].position.x = 0;
    for (const uint32_t i : {0u, 1u, 2u, 3u}) tent.vertices.push_back(tent.vertices[i]);
    for (const uint32_t i : {5u, 6u}) tent.vertices[i].position.z = -1;
    tent.indices.insert(tent.indices.end(), {4, 6, 5, 4, 7, 6});
    const Scene folded = sceneOf(tent, {.doubleSided = true});
    CHECK(hits(Visibility(folded), {1e-6, 0.3, 3}, {0, 0, -1}) == 2);
}

TEST_CASE("visibility: an origin a thousand kilometres away costs no precision") {
    Scene scene = sceneOf(quad(), {});
    scene.objects.push_back(scene.objects[0]);
    scene.objects[1].worldFromObject = glm::translate(mat4(1), vec3(0, 0, 1e-4f));
    const Visibility visibility(scene);
    // A float at 1e6 m knows steps of 0.06 m; the two surfaces are 1e-4 m apart and the rays 1e-5 m inside the edge.
    for (const double x : {-0.99999, 0.0, 0.99999}) {
        const auto hit = visibility.closest({x, 0.3, 1e6}, {0, 0, -1});
        REQUIRE(hit);
        CHECK(hit->object == 1);
        CHECK(hit->t == Approx(1e6 - double(1e-4f)).epsilon(1e-15));
    }
    CHECK_FALSE(visibility.closest({1.00001, 0.3, 1e6}, {0, 0, -1}));
}

TEST_CASE("visibility: a closed sphere has no cracks") {
    const Scene scene = sceneOf(sphere(1, 64, 32), {}, glm::translate(mat4(1), vec3(7, -3, 5)));
    const Visibility visibility(scene);
    const dvec3 centre(7, -3, 5);
    std::mt19937 random(1);
    const auto unit = [&] { return double(random()) / 4294967296.0 * 2 - 1; };
    int missed = 0;
    for (const Vertex& vertex : scene.meshes[0].vertices) {  // straight at vertices and edges, where cracks would be
        const dvec3 target = centre + dvec3(vertex.position);
        const dvec3 origin = centre + 4.0 * normalize(dvec3(vertex.position) + 0.2 * dvec3(unit(), unit(), unit()));
        const auto hit = visibility.closest(origin, target - origin);
        // The far side of a sphere is all back faces, so a ray through a crack would hit nothing. At the silhouette it
        // may miss; these rays come from within 0.35 rad of the normal.
        missed += !hit || std::abs(hit->t - 1) > 1e-6;
    }
    CHECK(missed == 0);
}

TEST_CASE("visibility: objects with a singular matrix are not there") {
    const Scene scene = sceneOf(quad(), {}, glm::scale(mat4(1), vec3(1, 1, 0)));
    CHECK_FALSE(Visibility(scene).closest({0, 0, 1}, {0, 0, -1}));
}

TEST_CASE("visibility: the plane of a triangle is met beyond its edges and behind the origin too") {
    const std::array<dvec3, 3> triangle{dvec3(0, 0, 0), dvec3(2, 0, 0), dvec3(0, 4, 0)};
    const PlaneHit hit = intersectPlane({-1, 6, 3}, {0, 0, 1}, triangle);
    CHECK(hit.t == -3);
    CHECK(hit.u == -0.5);
    CHECK(hit.v == 1.5);
    CHECK(hit.facing > 0);
}
