#include <doctest/doctest.h>

#include <cmath>

#include "reference/camera_rays.hpp"
#include "scene_building.hpp"

using namespace luciole;
using namespace luciole::reference;
using namespace luciole::test;

namespace {

constexpr double kTolerance = 1e-6;  // the camera's numbers are floats

void checkClose(dvec3 a, dvec3 b) {
    CAPTURE(a.x);
    CAPTURE(a.y);
    CAPTURE(a.z);
    CHECK(length(a - b) < kTolerance);
}

}  // namespace

TEST_CASE("camera rays: pixel centres of a perspective picture spread by the field of view and the aspect") {
    const View view{.camera = frontCamera(5, float(kPi / 2)), .extent = {4, 2}};  // half height 1 at depth 1
    const CameraRays rays(view);
    checkClose(rays.through(0, 0).origin, {0, 0, 5});
    checkClose(rays.through(0, 0).direction, {-1.5, 0.5, -1});
    checkClose(rays.through(3, 1).direction, {1.5, -0.5, -1});
    checkClose(rays.toEye({0, 3, 1}), {0, -0.6, 0.8});
}

TEST_CASE("camera rays: an orthographic picture has parallel rays and one direction to the eye") {
    const View view{.camera = frontOrthographicCamera(5, 3), .extent = {2, 3}};
    const CameraRays rays(view);
    checkClose(rays.through(0, 0).origin, {-1, 2, 5});
    checkClose(rays.through(1, 2).origin, {1, -2, 5});
    checkClose(rays.through(1, 2).direction, {0, 0, -1});
    checkClose(rays.toEye({7, 8, -9}), {0, 0, 1});
}

TEST_CASE("camera rays: they turn with the camera") {
    Camera camera = frontCamera(0, float(kPi / 2));
    camera.worldFromView = glm::rotate(mat4(1), float(kPi / 2), vec3(0, 1, 0));  // looks down -X, right is -Z
    const CameraRays rays({.camera = camera, .extent = {2, 2}});
    checkClose(rays.through(1, 0).direction, {-1, 0.5, -0.5});
    checkClose(rays.backwards(), {1, 0, 0});
}
