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
                if (technique.forward && layout != GBufferLayout::compact) continue;  // they have no layout
                INFO("technique: " << technique.info.name);
                const Frame& yardstick = yardsticks.of(technique);
                const Frame frame = renderer->render(test.view, {.lighting = std::string(technique.info.name), .gbuffer = layout});
                const size_t lights = test.scene.lights.size();
                checkAlike(technique, frame.radiance, yardstick.radiance, yardsticks.comparable(technique, test.scene), lights);
            }
        }
    }
}

namespace {

/// The scene with colours that 8 bits of their square root hold, the same everywhere on a surface, and ambience from everywhere.
Scene withColorsOf8Bits(Scene scene) {
    const auto linear = [](float value) { return std::round(value * 255) / 255; };
    const auto squared = [&](vec3 color) {
        for (int i = 0; i < 3; ++i) color[i] = linear(std::sqrt(std::min(color[i], 1.0f))) * linear(std::sqrt(std::min(color[i], 1.0f)));
        return color;
    };
    scene.ambience.ground = scene.ambience.sky;
    for (Mesh& mesh : scene.meshes)
        for (Vertex& vertex : mesh.vertices) vertex.color = vec4(1);
    for (Material& material : scene.materials) {
        material.surface = SurfaceShader::textured;
        material.baseColorTexture = material.metallicRoughnessTexture = material.occlusionTexture = material.emissiveTexture = {};
        material.baseColor = vec4(squared(vec3(material.baseColor) * material.shaped.kd), 1);
        material.proceduralColor = vec3(0);
        material.metallic = linear(material.metallic);
        material.emissive = vec3(material.emissive.x);
        material.shaped.kd = 1;
        material.shaped.specularBlend = linear(material.shaped.specularBlend);
        material.shaped.specularColor = squared(material.shaped.specularColor * material.shaped.ks);
        material.shaped.ks = 1;
    }
    return scene;
}

}  // namespace

TEST_CASE("light-prepass: equals brute force on a G-buffer that rounds normals as it does, and colours not at all") {
    ValidatedRenderer renderer;
    for (const TestScene& test : testScenes()) {
        INFO("scene: " << test.name);
        renderer->setScene(withColorsOf8Bits(test.scene));
        const Frame yardstick = renderer->render(test.view, {.lighting = "brute-force", .gbuffer = GBufferLayout::compact});
        const Frame frame = renderer->render(test.view, {.lighting = "light-prepass"});
        // A rounding per light as for any technique, and those of a colour's square, its reflectance and its product.
        const double bound = 2.0 * double(test.scene.lights.size() + 8) * std::exp2(-24);
        const ErrorSummary radiance = difference(frame.radiance, yardstick.radiance);
        INFO("p999 " << radiance.p999 << " max " << radiance.max);
        CHECK(radiance.max <= bound);
    }
}

TEST_CASE("lighting: forward techniques light surfaces that blend, and four samples a pixel, as their yardstick does") {
    ValidatedRenderer renderer;
    for (TestScene& test : testScenes()) {
        INFO("scene: " << test.name);
        for (size_t i = 0; i < test.scene.materials.size(); i += 2) {
            test.scene.materials[i].alphaMode = AlphaMode::blend;
            test.scene.materials[i].baseColor.a = 0.5f;
        }
        renderer->setScene(test.scene);
        for (const auto msaa : {Msaa::x1, Msaa::x4}) {
            Yardsticks yardsticks(renderer, test.view, {.msaa = msaa});
            for (const auto& technique : render::techniques()) {
                if (!technique.forward || (msaa != Msaa::x1 && !technique.samples)) continue;
                INFO("technique: " << technique.info.name << ", msaa " << int(msaa));
                const Frame frame = renderer->render(test.view, {.lighting = std::string(technique.info.name), .msaa = msaa});
                // Not all pixels: surfaces that coincide are added by some.
                const ErrorSummary radiance = difference(frame.radiance, yardsticks.of(technique).radiance);
                const double roundings = 2.0 * double(test.scene.lights.size() + 1) * std::exp2(-24);
                const double bound = technique.info.name == "light-prepass" ? kSteepest * kNormalTurn : roundings;
                CHECK(radiance.p999 <= bound);
            }
        }
    }
}

TEST_CASE("lighting: light-prepass refuses several samples a pixel") {
    ValidatedRenderer renderer;
    renderer->setScene(studio().scene);
    CHECK_THROWS_WITH_AS(renderer->render(studio().view, {.lighting = "light-prepass", .msaa = Msaa::x4}),
                         doctest::Contains("msaa: expected 1 with lighting light-prepass, which stores one surface a pixel"), Error);
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
    CHECK_THROWS_WITH_AS(render::techniqueNamed("tilde"), doctest::Contains("expected one of auto, brute-force, fullscreen, quad, volume, volume-stencil, volume-stencil-reference, volume-instanced, tiled, tiled-points, clustered, clustered-forward, forward-loop, light-indexed, forward-multipass, light-prepass, got \"tilde\""), Error);
}
