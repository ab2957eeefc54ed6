#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "output/fingerprint.shared.h"
#include "reference/volume.hpp"
#include "volume_building.hpp"

using namespace luciole;
using namespace luciole::test;
using reference::Volume;

namespace {

/// Asks for many points, the same each time, in a cube of half size `reach` round the origin; the volume and the same one
/// turned over.
/// \param inside what is expected, from the signed distance to the surface: < 0 inside. Points nearer than `margin` are left
///        out
void checkInside(const LightVolume& volume, double reach, double margin, const std::function<double(dvec3)>& distance) {
    Scene scene;
    scene.lightVolumes = {volume};
    REQUIRE_NOTHROW(validate(scene));
    const Volume asMade(volume), inverted(turnedOver(volume));
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(-reach, reach);
    int inside = 0, wrong = 0;
    for (int i = 0; i < 2000; ++i) {
        const dvec3 p(coordinate(random), coordinate(random), coordinate(random));
        const double d = distance(p);
        if (std::abs(d) <= margin) continue;
        inside += d < 0;
        wrong += asMade.contains(p) != (d < 0);
        wrong += inverted.contains(p) != (d < 0);
    }
    CHECK(wrong == 0);
    CHECK(inside > 100);  // the test says something about either side
    CHECK(inside < 1900);
}

double boxDistance(dvec3 p, dvec3 low, dvec3 high) {
    const dvec3 d = max(low - p, p - high);
    return std::max({d.x, d.y, d.z});
}

// Points so near to a surface of vertices that are stored as floats may count as either.
constexpr double kRounding = 1e-6;

}  // namespace

TEST_CASE("volume: a box contains what lies between its sides") {
    checkInside(boxVolume({-0.5f, -1, 0.25f}, {1.5f, 0.5f, 1.75f}), 2, kRounding,
                [](dvec3 p) { return boxDistance(p, {-0.5, -1, 0.25}, {1.5, 0.5, 1.75}); });
}

TEST_CASE("volume: a concave L contains its two arms and not the corner between them") {
    const vec2 outline[] = {{-1, 1}, {1, 1}, {1, 0}, {0, 0}, {0, -1}, {-1, -1}};
    const LightVolume volume = prismVolume(outline, -0.5f, 0.5f, 3);
    checkInside(volume, 1.5, kRounding, [](dvec3 p) {
        return std::min(boxDistance(p, {-1, -0.5, 0}, {1, 0.5, 1}), boxDistance(p, {-1, -0.5, -1}, {0, 0.5, 1}));
    });
    CHECK(Volume(volume).contains({0.5, 0, 0.5}));
    CHECK(Volume(volume).contains({-0.5, 0, -0.5}));
    CHECK_FALSE(Volume(volume).contains({0.5, 0, -0.5}));
}

TEST_CASE("volume: a torus contains its tube and not its hole") {
    const LightVolume volume = torusVolume(1, 0.4f, 128, 64);
    REQUIRE(volume.indices.size() / 3 == kMaxVolumeTriangles);
    // Chords lie within the circles by 1.4 (1 - cos(pi / 128)) and 0.4 (1 - cos(pi / 64)), less than a thousandth together.
    checkInside(volume, 1.5, 1e-3, [](dvec3 p) { return std::hypot(std::hypot(p.x, p.z) - 1, p.y) - 0.4; });
    CHECK_FALSE(Volume(volume).contains({0, 0, 0}));
    CHECK(Volume(volume).contains({1, 0, 0}));
}

TEST_CASE("volume: two boxes apart contain what either does, also if only one is turned over") {
    for (const bool turned : {false, true}) {
        LightVolume volume = boxVolume({-1, -1, -1}, {-0.25f, 1, 1});
        const LightVolume other = boxVolume({0.25f, -1, -1}, {1, 1, 1});
        append(volume, turned ? turnedOver(other) : other);
        checkInside(volume, 1.25, kRounding, [](dvec3 p) {
            return std::min(boxDistance(p, {-1, -1, -1}, {-0.25, 1, 1}), boxDistance(p, {0.25, -1, -1}, {1, 1, 1}));
        });
    }
}

TEST_CASE("volume: where boxes overlap is inside, and a box turned over within another is a hole") {
    LightVolume overlapping = boxVolume({-1, -1, -1}, {0.5f, 1, 1});
    append(overlapping, boxVolume({-0.5f, -1, -1}, {1, 1, 1}));
    checkInside(overlapping, 1.25, kRounding, [](dvec3 p) { return boxDistance(p, dvec3(-1), dvec3(1)); });
    LightVolume hollow = boxVolume(vec3(-1), vec3(1));
    append(hollow, turnedOver(boxVolume(vec3(-0.5f), vec3(0.5f))));
    checkInside(hollow, 1.25, kRounding, [](dvec3 p) {
        return std::max(boxDistance(p, dvec3(-1), dvec3(1)), -boxDistance(p, dvec3(-0.5), dvec3(0.5)));
    });
}

TEST_CASE("volume: triangles without area change nothing, and a volume of them contains nothing") {
    LightVolume volume = boxVolume(vec3(-1), vec3(1));
    volume.indices.insert(volume.indices.end(), {0, 0, 5, 3, 3, 3});
    checkInside(volume, 1.25, kRounding, [](dvec3 p) { return boxDistance(p, dvec3(-1), dvec3(1)); });
    const LightVolume flat{.name = "flat", .positionsWorld = {{0, 0, 0}, {1, 0, 0}}, .indices = {0, 1, 1}};
    CHECK_FALSE(Volume(flat).contains({0.5, 0, 0}));
}

TEST_CASE("volume: size and distance from the origin do not matter") {
    for (const float size : {1e-6f, 1.0f, 1e6f, 1e30f}) {
        LightVolume volume = torusVolume(size, 0.4f * size, 32, 16);
        CHECK(Volume(volume).contains({0, 0, double(size)}));
        CHECK_FALSE(Volume(volume).contains({0, 0, 0}));
        for (vec3& position : volume.positionsWorld) position += 1000 * size;
        CHECK(Volume(volume).contains(dvec3(double(1000 * size)) + dvec3(0, 0, double(size))));
        CHECK_FALSE(Volume(volume).contains(dvec3(double(1000 * size))));
    }
}

TEST_CASE("fingerprints: each lies in [1, 4096], and neighbours differ") {
    CHECK(shared::fingerprint(0) == 1);
    CHECK(shared::fingerprint(1) == 2532);  // 2654435761 / 2^20 = 2531.47
    for (uint32_t i = 0; i < 100'000; ++i) {
        CHECK_MESSAGE(shared::fingerprint(i) - 1 < 4096, i);
        CHECK_MESSAGE(shared::fingerprint(i) != shared::fingerprint(i + 1), i);
    }
}
