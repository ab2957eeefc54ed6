#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include <luciole/error.hpp>
#include <luciole/reference.hpp>

#include "scene_building.hpp"

using namespace luciole;
using namespace luciole::test;
using doctest::Approx;

namespace {

constexpr double kHeight = 0.8, kOuter = 0.6, kCandela = 30, kFloor = 0.5, kReceiver = 0.9;

/// A Lambert floor at y = 0 under a spot that shines straight down, and a Lambert quad that sees it.
Scene floorAndReceiver(const mat4& worldFromReceiver) {
    Scene scene;
    addObject(scene, quad(2), lambertMaterial(scene, vec3(kFloor, 0.25f, 0)), glm::rotate(mat4(1), float(-kPi / 2), vec3(1, 0, 0)));
    addObject(scene, quad(0.1f), lambertMaterial(scene, vec3(float(kReceiver))), worldFromReceiver);
    scene.lights = {pointLight({9, 9, 9}, vec3(0)), spotLight({0, float(kHeight), 0}, {0, -1, 0}, 0, float(kOuter), vec3(kCandela))};
    scene.lights[1].name = "spot";
    return scene;
}

/// Red radiance of the receiver at `x` with normal `n`: the double integral over the floor of L cos cos / d^2, L = rho / pi E.
double expected(dvec3 x, dvec3 n) {
    constexpr int kSteps = 1000;
    double irradiance = 0;
    const double farthest = kHeight * std::tan(kOuter);
    for (int i = 0; i < kSteps; ++i)
        for (int k = 0; k < kSteps; ++k) {
            const double q = (i + 0.5) / kSteps * farthest, azimuth = (k + 0.5) / kSteps * 2 * kPi;
            const double r = std::hypot(q, kHeight), cosine = kHeight / r;
            const double falloff = std::pow((cosine - std::cos(kOuter)) / (1 - std::cos(kOuter)), 2);
            const double L = kFloor / kPi * kCandela * falloff * cosine / (r * r);
            const dvec3 d = dvec3(q * std::cos(azimuth), 0, q * std::sin(azimuth)) - x;
            const double d2 = dot(d, d);
            irradiance += L * std::max(dot(n, d), 0.0) * std::max(-d.y, 0.0) / (d2 * d2) * q;
        }
    return kReceiver / kPi * irradiance * (farthest / kSteps) * (2 * kPi / kSteps);
}

Camera cameraAt(vec3 eye, vec3 target) { return {.worldFromView = lookAt(eye, target), .zNear = 0.01f}; }

vec3 centre(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
    return pixel(renderReference(scene, {.camera = camera, .extent = {1, 1}}, settings).radiance, 0, 0);
}

}  // namespace

TEST_CASE("bounce: what a floor under a spot sends to a surface above it and to one beside it is the integral over the floor") {
    struct Case {
        vec3 position, normal;
        mat4 turn;
    };
    for (const Case& c : {Case{{0, 1, 0}, {0, -1, 0}, glm::rotate(mat4(1), float(kPi / 2), vec3(1, 0, 0))},
                          Case{{1, 0.4f, 0}, {-1, 0, 0}, glm::rotate(mat4(1), float(-kPi / 2), vec3(0, 1, 0))}}) {
        const Scene scene = floorAndReceiver(glm::translate(mat4(1), c.position) * c.turn);
        const Camera camera = cameraAt(c.position + 0.3f * c.normal, c.position);
        CHECK(centre(scene, camera, {}) == vec3(0));
        const vec3 found = centre(scene, camera, {.bounceLight = "spot"});
        // A patch of the floor is 1 / 128 of 1.1 m wide: its disc, s^2 = 2e-5 m^2, takes as much of d^2 >= 0.3 m^2 away; the rest is the sum's.
        CHECK(found.r == Approx(expected(dvec3(c.position), dvec3(c.normal))).epsilon(5e-4));
        CHECK(found.g == Approx(0.5 * double(found.r)).epsilon(1e-6));
        CHECK(found.b == 0);
        CHECK(centre(scene, camera, {.bounceLight = "1"}) == found);
    }
}

TEST_CASE("bounce: metals and unlit surfaces throw nothing back, and neither does what the light is not linked to") {
    const vec3 above(0, 1, 0);
    Scene scene = floorAndReceiver(glm::translate(mat4(1), above) * glm::rotate(mat4(1), float(kPi / 2), vec3(1, 0, 0)));
    const Camera camera = cameraAt({0, 0.7f, 0}, above);
    const RenderSettings settings{.bounceLight = "spot"};
    const float lambert = centre(scene, camera, settings).r;
    Material& floor = scene.materials[0];
    const Material before = floor;
    floor = {.baseColor = vec4(kFloor, 0, 0, 1), .metallic = 0.25f};
    CHECK(centre(scene, camera, settings).r == Approx(0.75 * double(lambert)).epsilon(1e-6));
    floor = unlitMaterial();
    CHECK(centre(scene, camera, settings).r == 0);
    floor = before;
    scene.linkGroups = {{.name = "floor", .litObjects = {true, false}}, {.name = "receiver", .litObjects = {false, true}}};
    for (const uint32_t group : {0u, 1u}) {
        scene.lights[1].linkGroup = group;
        CHECK(centre(scene, camera, settings).r == 0);
    }
}

TEST_CASE("bounce: a light that is not there or that can't bounce is refused, with what was expected") {
    Scene scene = floorAndReceiver(mat4(1));
    const auto messageFor = [&](const std::string& name) -> std::string {
        try {
            centre(scene, frontCamera(), {.bounceLight = name});
        } catch (const Error& error) {
            CHECK(error.kind() == ErrorKind::usage);
            return error.what();
        }
        return "";
    };
    CHECK(messageFor("lamp") == "bounce-light: expected none, a light's name or its index below 2, got \"lamp\"");
    CHECK(messageFor("2") == "bounce-light: expected none, a light's name or its index below 2, got \"2\"");
    CHECK(messageFor("0").ends_with("got \"0\", a point light"));
    scene.lights[1].outerConeAngle = 1.5f;
    CHECK(messageFor("spot").ends_with("got \"spot\", which has 1.5 rad"));
    scene.lights[1].outerConeAngle = 0.5f;
    scene.lights[1].contribution = LightContribution::specularOnly;
    CHECK(messageFor("spot").ends_with("got \"spot\", which lights highlights only"));
    scene.lights[1].contribution = LightContribution::diffuseOnly;
    CHECK(messageFor("spot").empty());
}
