#include <fmt/format.h>
#include <luciole/error.hpp>
#include <luciole/reference.hpp>

#include "device.hpp"
#include "scene_building.hpp"
#include "scenes.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

RenderSettings volumes(std::string lighting = "brute-force") { return {.lighting = std::move(lighting), .shadows = Shadows::volumes}; }

/// Checks shadow volumes against the reference: how much light they leave differs by 5 % of it at no more than a thousandth of the pixels
/// inside of surfaces, edges of shadows included.
void checkVolumes(ValidatedRenderer& renderer, const TestScene& test) {
    INFO("scene: " << test.name);
    const Frame reference = renderReference(test.scene, test.view, volumes(), {"id", "material", "depth"});
    const std::vector<double> expected = litShares(reference.radiance, renderReference(test.scene, test.view, {}).radiance);
    renderer->setScene(test.scene);
    const Frame frame = renderer->render(test.view, volumes());
    CHECK(frame.stats.shadows->lost.empty());
    CHECK(frame.stats.shadows->lights > 0);
    const std::vector<double> found = litShares(frame.radiance, renderer->render(test.view, {}).radiance);
    const auto mask = interior(reference);
    size_t compared = 0, shadowed = 0, wrong = 0;
    std::string where;
    for (size_t i = 0; i < mask.size(); ++i) {
        if (!mask[i]) continue;
        ++compared;
        shadowed += expected[i] < 0.95;
        if (std::abs(found[i] - expected[i]) <= 0.05) continue;
        if (++wrong <= 8) where += fmt::format(" ({}, {}): {:.2f}, not {:.2f}", i % test.view.extent.x, i / test.view.extent.x, found[i], expected[i]);
    }
    INFO("compared " << compared << ", shadowed " << shadowed << ", wrong " << wrong << where);
    CHECK(shadowed > compared / 20);
    CHECK(double(wrong) <= 1e-3 * double(compared));
}

}  // namespace

TEST_CASE("shadow volumes: the reference's shadows to the pixel, on scenes with every type of light, from within volumes, in both projections") {
    ValidatedRenderer renderer;
    for (const char* uri : {"builtin:hall?lights=16&triangles=12000", "builtin:materials"}) checkVolumes(renderer, builtin(uri, {320, 240}));
    // A square over a floor, its light behind it: the eye is in its shadow, and near enough that the near plane cuts the volume.
    Scene scene;
    addObject(scene, quad(3), lambertMaterial(scene));
    addObject(scene, quad(0.5f), lambertMaterial(scene), glm::translate(mat4(1), vec3(0, 0, 1)));
    addObject(scene, sphere(0.3f, 16, 8), lambertMaterial(scene), glm::scale(glm::translate(mat4(1), vec3(1, 0.5f, 0.4f)), vec3(-1, 1, 1)));
    scene.lights = {pointLight(vec3(0.2f, -0.1f, 2), vec3(5)), directionalLight(vec3(0.3f, 0.2f, -1), vec3(0.5f)),
                    spotLight(vec3(-2, 0, 1.5f), vec3(2, 0, -1), 0.3f, 0.7f, vec3(9))};
    Camera inside;
    inside.worldFromView = lookAt(vec3(0, 0, 0.9f), vec3(1, 0.4f, 0));
    checkVolumes(renderer, {"in the shadow", scene, {inside, {160, 120}}});
    Camera slanted = frontOrthographicCamera(3, 2);
    slanted.worldFromView = lookAt(vec3(2, -3, 3), vec3(0, 0, 0));
    slanted.zFar = 12;
    checkVolumes(renderer, {"orthographic", scene, {slanted, {160, 120}}});
}

TEST_CASE("shadow volumes: open, flat and non-manifold meshes cast as any other") {
    ValidatedRenderer renderer;
    Scene scene;
    addObject(scene, quad(3), lambertMaterial(scene));
    // Three leaves that meet in one edge, one of them turned over; and two triangles that share an edge in the same direction.
    Mesh leaves{.name = "leaves"};
    const std::vector<vec3> corners{{-0.5f, 0, 1}, {0.5f, 0, 1}, {0, 0.6f, 1.1f}, {0, -0.5f, 0.9f}, {0, 0.1f, 1.6f}, {1, -1, 0.5f}, {1, 0, 0.5f}, {1.5f, -0.4f, 0.6f}, {0.6f, -0.5f, 0.8f}};
    for (const auto& [a, b, c] : {std::array{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {5, 6, 7}, {5, 6, 8}}) {
        const vec3 normal = glm::normalize(glm::cross(corners[b] - corners[a], corners[c] - corners[a]));
        for (const int corner : {a, b, c}) {
            leaves.indices.push_back(uint32_t(leaves.vertices.size()));
            leaves.vertices.push_back({.position = corners[corner], .normal = normal});
        }
    }
    addObject(scene, leaves, {.doubleSided = true, .metallic = 0});
    scene.lights = {pointLight(vec3(0.2f, 0.3f, 2.5f), vec3(5)), directionalLight(vec3(-0.3f, 0.4f, -1), vec3(0.5f))};
    Camera camera;
    camera.worldFromView = lookAt(vec3(2, -3, 3), vec3(0, 0, 0));
    checkVolumes(renderer, {"leaves", scene, {camera, {240, 180}}});
}

TEST_CASE("shadow volumes: planes at grazing angles are lit to the last pixel") {
    ValidatedRenderer renderer;
    for (const float degrees : {0.5f, 5.0f, 45.0f}) {
        const TestScene test = tiledFloor(degrees);
        renderer->setScene(test.scene);
        CHECK(renderer->render(test.view, volumes()).radiance.data == renderer->render(test.view, {}).radiance.data);
    }
}

TEST_CASE("shadow volumes: each technique gives the shadows of its yardstick") {
    ValidatedRenderer renderer;
    const TestScene test = studio();
    renderer->setScene(test.scene);
    const View view{test.view.camera, {96, 72}};
    Yardsticks yardsticks(renderer, view, volumes());
    for (const auto& technique : render::techniques()) {
        INFO("technique: " << technique.info.name);
        const Frame& yardstick = yardsticks.of(technique);
        const Frame frame = renderer->render(view, volumes(std::string(technique.info.name)));
        checkAlike(technique, frame.radiance, yardstick.radiance, yardsticks.comparable(technique, test.scene), test.scene.lights.size());
    }
}

TEST_CASE("shadow volumes: what they can't do is refused, and what finds no room is named") {
    ValidatedRenderer renderer;
    TestScene test = studio();
    renderer->setScene(test.scene);
    RenderSettings settings = volumes("forward-loop");
    settings.msaa = Msaa::x4;
    CHECK_THROWS_WITH_AS(renderer->render(test.view, settings), doctest::Contains("shadows: volumes expect msaa 1"), Error);
    settings.msaa = Msaa::x1;
    test.scene.materials[0].alphaMode = AlphaMode::blend;
    renderer->setScene(test.scene);
    CHECK_THROWS_WITH_AS(renderer->render(test.view, settings), doctest::Contains("shadows: volumes expect a scene without surfaces that blend"), Error);

    TestScene hall = builtin("builtin:hall?lights=100&triangles=3000", {512, 256});
    renderer->setScene(hall.scene);
    settings = volumes("clustered");
    settings.shadowMemory = 1;  // two words a pixel
    const Frame frame = renderer->render(hall.view, settings);
    CHECK(frame.stats.shadows->lights == 64);
    REQUIRE(!frame.stats.shadows->lost.empty());
    CHECK(frame.stats.shadows->lost[0].reason == "the masks of more than 64 lights do not fit into 1 MiB (shadow-memory)");
    std::vector<float> sizes;  // the smallest in the picture go first
    for (const auto& without : frame.stats.shadows->lost) {
        const Light& light = hall.scene.lights[without.light];
        sizes.push_back(light.range / std::max(light.range, glm::distance(light.positionWorld, vec3(hall.view.camera.worldFromView[3]))));
    }
    CHECK(sizes.size() > 5);
    CHECK(std::ranges::is_sorted(sizes));
    for (const auto& without : frame.stats.shadows->lost) hall.scene.lights[without.light].castsShadows = false;
    settings.onOverflow = OnOverflow::fail;
    CHECK_THROWS_WITH_AS(renderer->render(hall.view, settings), doctest::Contains("shadows: "), Error);
    renderer->setScene(hall.scene);
    CHECK(renderer->render(hall.view, settings).radiance.data == frame.radiance.data);
    // From volumes to maps and back.
    const Frame again = renderer->render(hall.view, settings);
    renderer->render(hall.view, {.shadows = Shadows::maps});
    CHECK(renderer->render(hall.view, settings).radiance.data == again.radiance.data);
}
