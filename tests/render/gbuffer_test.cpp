#include "render/geometry/gbuffer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <luciole/reference.hpp>

#include "device.hpp"
#include "gpu/resources.hpp"
#include "scene_building.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

/// Worst error along the view axis, relative to the distance, over a slanted plane round `distance`, and worst angle
/// between the normals of a sphere and the true ones, as the lighting phase reads them.
struct Errors {
    double depth, normalDegrees;
};

Errors measure(ValidatedRenderer& renderer, GBufferLayout layout, float distance) {
    const RenderSettings settings{.gbuffer = layout};
    Errors errors{};
    const Scene plane = sceneOf(quad(4 * distance), Material{.doubleSided = true}, glm::rotate(mat4(1), 0.4f, vec3(1, 0.3f, 0)));
    Camera camera = frontCamera(distance);
    camera.zNear = 0.1f;
    const View view{camera, {64, 64}};
    const Image found = renderer.render(plane, view, settings, {"depth"}).aovs.at("depth");
    const Image expected = renderReference(plane, view, settings, {"depth"}).aovs.at("depth");
    for (size_t i = 0; i < expected.data.size(); ++i)
        errors.depth = std::max(errors.depth, std::abs(double(found.data[i]) / double(expected.data[i]) - 1));

    Scene ball = sceneOf(sphere(0.45f * distance, 256, 128), Material{});
    const Frame round = renderer.render(ball, {camera, {128, 128}}, settings, {"normal", "depth"});
    const Frame exact = renderer.render(ball, {camera, {128, 128}}, {.gbuffer = GBufferLayout::compact}, {"depth"});
    const double tangent = std::tan(0.5 * double(camera.yFov));
    for (uint32_t y = 0; y < 128; ++y)
        for (uint32_t x = 0; x < 128; ++x) {
            const double depth = exact.aovs.at("depth").at(x, y, 0);
            if (depth == 0) continue;
            const dvec3 p((2 * (x + 0.5) / 128 - 1) * tangent * depth, (1 - 2 * (y + 0.5) / 128) * tangent * depth, distance - depth);
            const Image& normals = round.aovs.at("normal");
            const dvec3 n(normals.at(x, y, 0), normals.at(x, y, 1), normals.at(x, y, 2));
            errors.normalDegrees = std::max(errors.normalDegrees, glm::degrees(std::acos(std::min(1.0, dot(normalize(p), normalize(n))))));
        }
    return errors;
}

uint32_t bytesPerPixel(GBufferLayout layout) {
    uint32_t bytes = gpu::bytesPerTexel(vk::Format::eD32Sfloat);
    for (const auto format : render::targetFormats(layout)) bytes += gpu::bytesPerTexel(format);
    return bytes;
}

}  // namespace

TEST_CASE("G-buffer: bytes per pixel are those in docs/gbuffer.md") {
    CHECK(bytesPerPixel(GBufferLayout::calver) == 36);
    CHECK(bytesPerPixel(GBufferLayout::floatPosition) == 36);
    CHECK(bytesPerPixel(GBufferLayout::compact) == 22);
}

// Prints the table of docs/gbuffer.md (run render_tests --test-case="G-buffer: position*" --success).
TEST_CASE("G-buffer: position and normal errors stay within what the bits of each layout allow") {
    ValidatedRenderer renderer;
    for (const float distance : {1.37f, 13.7f, 137.0f}) {
        const Errors calver = measure(renderer, GBufferLayout::calver, distance);
        const Errors floats = measure(renderer, GBufferLayout::floatPosition, distance);
        const Errors compact = measure(renderer, GBufferLayout::compact, distance);
        MESSAGE(fmt::format("{:5} m: calver {:.2e} {:.4f} deg, float {:.2e} {:.4f} deg, compact {:.2e} {:.4f} deg", distance,
                            calver.depth, calver.normalDegrees, floats.depth, floats.normalDegrees, compact.depth,
                            compact.normalDegrees));
        // Half a step of 1/65535 in near / z is z / near / 131070 of the distance; the plane reaches 1.4 times as far.
        const double step = 1.4 * distance / 0.1 / 131070;
        CHECK(calver.depth <= step * (1 + step) + 1e-6);
        CHECK(floats.depth <= std::exp2(-10));  // 11 significant bits; half of it where the driver rounds to nearest
        CHECK(compact.depth <= 1e-6);  // 32-bit floats and the warp matrix in them
        // 16-bit octahedral: 0.004 degrees; interpolating over the facets of the sphere adds a little.
        for (const Errors& errors : {calver, floats, compact}) CHECK(errors.normalDegrees < 0.01);
    }
}
