#include <doctest/doctest.h>

#include <cmath>

#include "reference/lights.hpp"
#include "reference/volume.hpp"
#include "scene_building.hpp"
#include "volume_building.hpp"

using namespace luciole;
using namespace luciole::reference;
using namespace luciole::test;
using doctest::Approx;

namespace {

/// Irradiance of a light on a plane that faces it, red; 0 where nothing arrives.
double irradiance(const Scene& scene, const Light& light, dvec3 at) {
    const FunctionTables tables(scene);
    const std::vector<Volume> volumes = volumesOf(scene);
    const auto arrival = LightSource(scene, tables, volumes, light).arrivalAt(at);
    return arrival ? arrival->E.r : 0;
}

/// What arrives of a light that refers to nothing.
std::optional<Arrival> arrivalOf(const Light& light, dvec3 at) {
    const Scene empty;
    return LightSource(empty, FunctionTables(empty), {}, light).arrivalAt(at);
}

}  // namespace

TEST_CASE("directional light: its lux arrive everywhere, from where it shines") {
    const Light light = directionalLight({0, -3, -4}, vec3(7, 8, 9));
    const auto arrival = arrivalOf(light, {100, 200, 300});
    REQUIRE(arrival);
    CHECK(arrival->E == dvec3(7, 8, 9));
    CHECK(length(arrival->L - dvec3(0, 0.6, 0.8)) < 1e-7);  // the direction is stored as floats
}

TEST_CASE("point light: candela over distance squared, and without a range nothing else") {
    for (const double d : {0.01, 0.5, 1.0, 3.0, 1000.0})
        CHECK(irradiance({}, pointLight({0, 0, 0}, vec3(50)), {0, d, 0}) == Approx(50 / (d * d)).epsilon(1e-14));
}

TEST_CASE("point light: with a range it is windowed, and exactly nothing at the range and beyond") {
    const Light light = pointLight({1, 2, 3}, vec3(2), 4);
    for (const double d : {0.1, 1.0, 2.0, 3.0, 3.99})
        CHECK(irradiance({}, light, {1 + d, 2, 3}) == Approx(2 * (1 - d * d * d * d / 256) / (d * d)).epsilon(1e-12));
    CHECK(irradiance({}, light, {3, 2, 3}) == Approx(2 * (15.0 / 16) / 4));
    CHECK_FALSE(arrivalOf(light, {5, 2, 3}));
    CHECK_FALSE(arrivalOf(light, {1, 2, 8}));
}

TEST_CASE("point light: exactly at the surface it is finite") {
    const auto arrival = arrivalOf(pointLight({1, 2, 3}, vec3(2)), {1, 2, 3});
    REQUIRE(arrival);
    CHECK(arrival->E.r == Approx(2 / 1e-4));  // no nearer than a centimetre
    CHECK(arrival->L == dvec3(0));
}

TEST_CASE("point light: a function over distance / range replaces the inverse square") {
    Scene scene;
    addFunction(scene, Function::Kind::sampled);
    scene.functions[0].samples = {vec2(1, 0), vec2(0.5f, 0), vec2(0, 0)};  // 1 - x
    Light light = pointLight({0, 0, 0}, vec3(10), 8);
    light.attenuation = 0;
    CHECK(irradiance(scene, light, {2, 0, 0}) == Approx(7.5));
    CHECK(irradiance(scene, light, {0, 0, 6}) == Approx(2.5));
    CHECK(irradiance(scene, light, {0, 0, 0}) == Approx(10));
    CHECK(irradiance(scene, light, {8, 0, 0}) == 0);
}

TEST_CASE("spot light: full within the inner cone, the square of a ramp over cosines between, nothing outside") {
    const Light light = spotLight({0, 0, 0}, {0, 0, -1}, 0.3f, 0.6f, vec3(5));
    const auto at = [&](double angle) { return irradiance({}, light, {std::sin(angle), 0, -std::cos(angle)}); };
    const double inner = std::cos(double(0.3f)), outer = std::cos(double(0.6f));
    CHECK(at(0) == Approx(5));
    CHECK(at(0.2999) == Approx(5));
    for (const double angle : {0.35, 0.45, 0.55})
        CHECK(at(angle) == Approx(5 * std::pow((std::cos(angle) - outer) / (inner - outer), 2)).epsilon(1e-12));
    CHECK(at(0.5999) > 0);
    CHECK_FALSE(arrivalOf(light, {std::sin(0.6001), 0, -std::cos(0.6001)}));
    CHECK_FALSE(arrivalOf(light, {0, 0, 1}));
}

TEST_CASE("spot light: a function over the cosine replaces the ramp, within the outer cone") {
    Scene scene;
    Light light = spotLight({0, 0, 0}, {0, 0, -1}, 0, float(kPi / 3), vec3(8));
    light.falloff = addFunction(scene, Function::Kind::blinnPhong, 2);
    CHECK(irradiance(scene, light, {0, 0, -1}) == Approx(8));
    CHECK(irradiance(scene, light, {0.6, 0, -0.8}) == Approx(8 * 0.64).epsilon(1e-6));  // read from a table
    CHECK(irradiance(scene, light, {0.8, 0, -0.59}) > 0);
    CHECK(irradiance(scene, light, {0.9, 0, -0.4}) == 0);
}

TEST_CASE("light links: a light touches the objects of its group, and all without one") {
    Scene scene;
    scene.linkGroups.push_back({.name = "", .litObjects = {false, true}});
    Light light = pointLight({0, 0, 0});
    const FunctionTables tables(scene);
    CHECK(LightSource(scene, tables, {}, light).touches(60000));
    light.linkGroup = 0;
    CHECK_FALSE(LightSource(scene, tables, {}, light).touches(0));
    CHECK(LightSource(scene, tables, {}, light).touches(1));
    CHECK_FALSE(LightSource(scene, tables, {}, light).touches(2));
}

TEST_CASE("light volumes: a light of any type arrives inside and nowhere else, range and cone apart") {
    Scene scene;
    scene.lightVolumes.push_back(boxVolume({-1, -1, -1}, {1, 1, 1}));
    for (Light light : {directionalLight({0, 0, -1}), pointLight({0, 0, 0.5f}, vec3(1), 1),
                        spotLight({0, 0, 0.9f}, {0, 0, -1}, 0.1f, 0.8f)}) {
        const double bare = irradiance(scene, light, {0.1, 0.1, -0.3});
        CHECK(bare > 0);
        light.volume = 0;
        CHECK(irradiance(scene, light, {0.1, 0.1, -0.3}) == bare);
        CHECK(irradiance(scene, light, {0.1, 0.1, -1.1}) == 0);
        CHECK(irradiance(scene, light, {1.1, 0, 0.5}) == 0);
    }
    Light light = pointLight({0, 0, 0}, vec3(1), 0.5f);
    light.volume = 0;
    CHECK(irradiance(scene, light, {0, 0, 0.6}) == 0);  // inside, but out of range
}
