#include "render/lighting/techniques.hpp"

#include <luciole/error.hpp>

#include "device.hpp"
#include "image_difference.hpp"
#include "scene_building.hpp"
#include "scenes.hpp"

using namespace luciole;
using namespace luciole::test;

TEST_CASE("lighting: each technique equals brute force to one rounding per light") {
    ValidatedRenderer renderer;
    for (const TestScene& test : testScenes()) {
        INFO("scene: " << test.name);
        renderer->setScene(test.scene);
        for (const auto layout : {GBufferLayout::calver, GBufferLayout::floatPosition, GBufferLayout::compact}) {
            // Two layouts put the surface elsewhere than the depth buffer that a stencilled mesh is cut out by.
            if (test.hardLights && layout != GBufferLayout::compact) continue;
            Yardsticks yardsticks(renderer, test.view, {.gbuffer = layout});
            for (const auto& technique : render::techniques()) {
                INFO("technique: " << technique.info.name);
                const Frame& yardstick = yardsticks.of(technique);
                const Frame frame = renderer->render(test.view, {.lighting = std::string(technique.info.name), .gbuffer = layout});
                // Sums of n positive terms in any order differ by at most 2 n units of roundoff (2^-24).
                const double bound = 2.0 * double(test.scene.lights.size() + 1) * std::exp2(-24);
                const std::vector<bool> mask = yardsticks.comparable(technique, test.scene.lights.size());
                const Difference radiance = difference(frame.radiance, yardstick.radiance, &mask);
                CHECK(radiance.max <= bound);
                CHECK(radiance.share > 0.9);
            }
        }
    }
}

TEST_CASE("lighting: a 16-bit light buffer loses at most a unit in the last place per light that reaches the pixel") {
    ValidatedRenderer renderer;
    const TestScene test = studio();
    renderer->setScene(test.scene);
    const Frame yardstick = renderer->render(test.view, {.lighting = "brute-force"});
    const Frame frame = renderer->render(test.view, {.lighting = "fullscreen", .lightBuffer = LightBufferFormat::rgba16f});
    const double overlap = double(test.scene.lights.size() + 1);
    const double worst = difference(frame.radiance, yardstick.radiance).max;
    CHECK(worst <= overlap * std::exp2(-10));
    CHECK(worst > std::exp2(-24));  // it is another buffer, or nothing was tested
}

TEST_CASE("lighting: an unknown name is refused with the names there are") {
    CHECK_THROWS_WITH_AS(render::techniqueNamed("tilde"), doctest::Contains("expected one of brute-force, fullscreen, quad, volume, volume-stencil, volume-stencil-reference, volume-instanced, forward-loop, forward-multipass, got \"tilde\""), Error);
}
