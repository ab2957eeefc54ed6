#include <luciole/error.hpp>
#include <luciole/reference.hpp>
#include <numeric>

#include "device.hpp"
#include "image_difference.hpp"
#include "scene_building.hpp"
#include "scenes.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

/// A room of 4 m a side with a red wall, a green one and a white block, under a spot that lights part of the floor, the block and the green wall.
TestScene room() {
    Scene scene;
    const auto wall = [&](vec3 color, float degrees, vec3 axis) {
        const mat4 turned = glm::rotate(mat4(1), glm::radians(degrees), axis);
        addObject(scene, quad(2), lambertMaterial(scene, color), turned * glm::translate(mat4(1), vec3(0, 0, -2)));
    };
    const vec3 white(0.75f), x(1, 0, 0), y(0, 1, 0);
    wall(white, 0, y);                     // at z = -2, facing +z
    wall(vec3(0.7f, 0.1f, 0.08f), 90, y);  // at x = -2
    wall(vec3(0.1f, 0.6f, 0.1f), -90, y);  // at x = 2
    wall(white, -90, x);                   // the floor
    wall(white, 90, x);                    // the ceiling
    for (int side = 0; side < 4; ++side)   // a block that stands on the floor
        addObject(scene, quad(0.6f), Material{.baseColor = vec4(white, 1), .metallic = 0, .roughness = 0.8f},
                  glm::translate(mat4(1), vec3(0.3f, -1.4f, -0.6f)) * glm::rotate(mat4(1), 0.4f + float(side) * float(kPi / 2), y) *
                      glm::translate(mat4(1), vec3(0, 0, 0.6f)));
    addObject(scene, quad(0.6f), lambertMaterial(scene, white),
              glm::translate(mat4(1), vec3(0.3f, -0.8f, -0.6f)) * glm::rotate(mat4(1), 0.4f, y) * glm::rotate(mat4(1), float(-kPi / 2), x));
    scene.lights = {spotLight(vec3(-0.8f, 1.9f, 0.5f), vec3(0.6f, -1, -0.35f), 0.3f, 0.6f, vec3(40), 12)};
    scene.lights[0].name = "spot";
    Camera camera;
    camera.worldFromView = lookAt(vec3(0, 0, 1.95f), vec3(0, -0.2f, -2));
    camera.yFov = 1.4f;
    return {"room", std::move(scene), {camera, {96, 72}}};
}

const std::vector<std::string> kCounts{"useful-evaluations", "light-fingerprint"};

Image less(Image a, const Image& b) {
    for (size_t i = 0; i < a.data.size(); ++i) a.data[i] -= b.data[i];
    return a;
}

/// Of a bounce alone: the sum of what it is off, and what it is off in the sum, both over the sum of the right one.
struct BounceError {
    double mean, bias;
};
BounceError errorOf(const Image& found, const Image& right) {
    double off = 0, sum = 0, all = 0;
    for (size_t i = 0; i < right.data.size(); ++i) {
        off += std::abs(double(found.data[i]) - double(right.data[i]));
        sum += found.data[i];
        all += right.data[i];
    }
    return {off / all, sum / all - 1};
}

bool takesBounce(const render::LightingTechnique& technique) { return !technique.onHost; }

}  // namespace

TEST_CASE("bounce: each technique that takes lights made on the device shows the same ones, 1,024 and more of them") {
    ValidatedRenderer renderer;
    TestScene test = studio();
    renderer->setScene(test.scene);
    const std::vector<bool> everywhere(size_t(test.view.extent.x) * test.view.extent.y, true);
    for (const uint32_t grid : {8u, 32u}) {  // a uniform block's worth of lights, and more
        const size_t lights = test.scene.lights.size() + grid * grid;
        for (const auto layout : {GBufferLayout::floatPosition, GBufferLayout::compact}) {
            RenderSettings settings{.gbuffer = layout, .bounceLight = "3", .bounceGrid = grid};
            const std::vector<std::string> counts = layout == GBufferLayout::compact ? kCounts : std::vector<std::string>{};
            Yardsticks yardsticks(renderer, test.view, settings, counts);
            for (const auto& technique : render::techniques()) {
                if (!takesBounce(technique)) continue;
                INFO("technique: " << technique.info.name << ", grid " << grid);
                const Frame& yardstick = yardsticks.of(technique);
                settings.lighting = technique.info.name;
                const Frame frame = renderer->render(test.view, settings, counts);
                CHECK(frame.stats.lights == lights);
                checkAlike(technique, frame.radiance, yardstick.radiance, everywhere, lights);
                for (const std::string& name : counts) CHECK(frame.aovs.at(name).data == yardstick.aovs.at(name).data);
            }
        }
    }
}

TEST_CASE("bounce: light-indexed shows the same small lights by each packing that the device alone fills") {
    ValidatedRenderer renderer;
    const TestScene test = studio();
    renderer->setScene(test.scene);
    RenderSettings settings{.lighting = "forward-loop", .bounceLight = "3", .bounceGrid = 16};
    const Frame yardstick = renderer->render(test.view, settings, kCounts);
    settings.lighting = "light-indexed";
    for (const auto packing : {LidrPacking::bitShift, LidrPacking::maxBlend, LidrPacking::list})
        for (const auto cover : {LidrCover::surface, LidrCover::frontFaces}) {
            settings.lidrPacking = packing;
            settings.lidrCover = cover;
            const Frame frame = renderer->render(test.view, settings, kCounts);
            CHECK(difference(frame.radiance, yardstick.radiance).max <= 2.0 * double(yardstick.stats.lights + 1) * std::exp2(-24));
            for (const std::string& name : kCounts) CHECK(frame.aovs.at(name).data == yardstick.aovs.at(name).data);
        }
}

TEST_CASE("bounce: light-indexed reads small lights out of textures as out of buffers") {
    ValidatedRenderer renderer;
    const TestScene test = studio();
    renderer->setScene(test.scene);
    RenderSettings settings{.lighting = "forward-loop", .bounceLight = "3", .bounceGrid = 3};  // few enough to fit
    const Frame yardstick = renderer->render(test.view, settings, kCounts);
    settings.lighting = "light-indexed";
    settings.overlap = 16;
    for (const auto tables : {LidrTables::buffers, LidrTables::textures}) {
        settings.lidrTables = tables;
        const Frame frame = renderer->render(test.view, settings, kCounts);
        CHECK_FALSE(frame.stats.lightIndex->fellBack);
        CHECK(difference(frame.radiance, yardstick.radiance).max <= 2.0 * double(yardstick.stats.lights + 1) * std::exp2(-24));
        for (const std::string& name : kCounts) CHECK(frame.aovs.at(name).data == yardstick.aovs.at(name).data);
    }
}

TEST_CASE("bounce: where the host looks at each light it is refused") {
    ValidatedRenderer renderer;
    const TestScene test = room();
    renderer->setScene(test.scene);
    for (const char* name : {"volume", "volume-stencil", "volume-stencil-reference", "forward-multipass"})
        CHECK_THROWS_WITH_AS(renderer->render(test.view, {.lighting = name, .bounceLight = "spot"}), doctest::Contains("bounce-light: expected none with"), Error);
    for (const auto packing : {LidrPacking::cpuSort, LidrPacking::maxBlendSorted})
        CHECK_THROWS_WITH_AS(renderer->render(test.view, {.lighting = "light-indexed", .lidrPacking = packing, .bounceLight = "spot"}),
                             doctest::Contains("bounce-light: expected none with"), Error);
    CHECK_THROWS_WITH_AS(renderer->render(test.view, {.bounceLight = "moon"}), doctest::Contains("expected none, a light's name"), Error);
}

TEST_CASE("bounce: turning it on and off leaves the rest of a picture as it was") {
    ValidatedRenderer renderer;
    const TestScene test = room();
    renderer->setScene(test.scene);
    const Frame before = renderer->render(test.view, {});
    const Frame with = renderer->render(test.view, {.bounceLight = "spot"});
    const Frame finer = renderer->render(test.view, {.bounceLight = "spot", .bounceGrid = 48});
    CHECK(with.radiance.data != before.radiance.data);
    CHECK(finer.radiance.data != with.radiance.data);
    CHECK(renderer->render(test.view, {.bounceLight = "spot"}).radiance.data == with.radiance.data);
    CHECK(renderer->render(test.view, {}).radiance.data == before.radiance.data);
}

TEST_CASE("bounce: 1,024 small lights give the bounce of the reference, and more give it better") {
    ValidatedRenderer renderer;
    const TestScene test = room();
    renderer->setScene(test.scene);
    const Image reference = less(renderReference(test.scene, test.view, {.bounceLight = "spot"}).radiance, renderReference(test.scene, test.view, {}).radiance);
    const Image direct = renderer->render(test.view, {}).radiance;
    double last = 1;
    for (const uint32_t grid : {8u, 16u, 32u, 64u}) {
        const Frame frame = renderer->render(test.view, {.bounceLight = "spot", .bounceGrid = grid}, {"useful-evaluations"});
        const BounceError error = errorOf(less(frame.radiance, direct), reference);
        const std::vector<float>& lights = frame.aovs.at("useful-evaluations").data;
        const double perPixel = std::accumulate(lights.begin(), lights.end(), 0.0) / double(lights.size());
        MESSAGE(grid << " x " << grid << " small lights, " << perPixel << " a pixel: mean error " << 100 * error.mean << " %, of the sum "
                     << 100 * error.bias << " %");
        CHECK(error.mean < last);
        last = error.mean;
        // Ranges end where at most 1/32 of the light's mean irradiance is lost (conventions.md): here 2.5 % of the bounce. Patches of a
        // twentieth of the lit surfaces' width cost the other 2 %, next to where they stand.
        if (grid == 32) CHECK(error.mean < 0.05);
    }
}
