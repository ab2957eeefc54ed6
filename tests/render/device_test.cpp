#include <luciole/error.hpp>

#include <luciole/reference.hpp>

#include "device.hpp"
#include "image_difference.hpp"
#include "render/shaders/types.shared.h"
#include "scene_building.hpp"
#include "scenes.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

bool allFinite(const Image& image) {
    return std::ranges::all_of(image.data, [](float value) { return std::isfinite(value); });
}

}  // namespace

TEST_CASE("renderer: two runs give identical pictures, and so does a second renderer") {
    const TestScene test = studio();
    ValidatedRenderer first, second;
    const Frame a = first.render(test.scene, test.view, {});
    const Frame b = first->render(test.view, {});
    const Frame c = second.render(test.scene, test.view, {});
    CHECK(a.radiance.data == b.radiance.data);
    CHECK(a.display.data == c.display.data);
}

TEST_CASE("renderer: odd sizes render, each with its own pixels") {
    const TestScene test = studio();
    ValidatedRenderer renderer;
    renderer->setScene(test.scene);
    for (const uvec2 extent : {uvec2(1, 1), uvec2(1, 512), uvec2(512, 1), uvec2(97, 61)}) {
        const Frame frame = renderer->render({test.view.camera, extent}, {});
        CHECK(frame.radiance.width == extent.x);
        CHECK(frame.radiance.height == extent.y);
        CHECK(allFinite(frame.radiance));
    }
    CHECK_THROWS_AS(renderer->render({test.view.camera, {0, 5}}, {}), Error);
    CHECK_THROWS_AS(renderer->render({test.view.camera, {100000, 5}}, {}), Error);
}

TEST_CASE("renderer: an empty scene and a scene without lights are black") {
    ValidatedRenderer renderer;
    const View view{frontCamera(), {32, 24}};
    for (const std::string technique : {"brute-force", "fullscreen"}) {
        CHECK(std::ranges::all_of(renderer.render({}, view, {.lighting = technique}).radiance.data, [](float v) { return v == 0; }));
        const Scene unlit = sceneOf(quad(), Material{});
        CHECK(std::ranges::all_of(renderer.render(unlit, view, {.lighting = technique}).radiance.data, [](float v) { return v == 0; }));
    }
}

TEST_CASE("renderer: a Lambert quad under a directional light shows E / pi") {
    Scene scene;
    const Material material = lambertMaterial(scene);
    addObject(scene, quad(2), material);
    scene.lights = {directionalLight(vec3(0, 0, -1), vec3(2, 1, 0.5f))};
    ValidatedRenderer renderer;
    const Frame frame = renderer.render(scene, {frontCamera(), {33, 33}}, {.gbuffer = GBufferLayout::calver});
    CHECK(frame.radiance.at(16, 16, 0) == doctest::Approx(2 / kPi).epsilon(1e-4));  // 16-bit normal and colour
    CHECK(frame.radiance.at(16, 16, 1) == doctest::Approx(1 / kPi).epsilon(1e-4));
    CHECK(frame.radiance.at(16, 16, 2) == doctest::Approx(0.5 / kPi).epsilon(1e-4));
}

TEST_CASE("renderer: a light reaches up to its range and not beyond") {
    Scene scene;
    const Material material = lambertMaterial(scene);
    addObject(scene, quad(4), material);
    scene.lights = {pointLight(vec3(0, 0, 0.5f), vec3(1), 1)};
    ValidatedRenderer renderer;
    const View view{frontOrthographicCamera(2, 2), {101, 101}};  // 0.0396 m a pixel
    const Frame frame = renderer.render(scene, view, {}, {"light-count"});
    for (uint32_t y = 0; y < 101; ++y)
        for (uint32_t x = 0; x < 101; ++x) {
            const dvec2 p = (dvec2(x, y) + 0.5) / 101.0 * 4.0 - 2.0;
            const double distance = std::sqrt(p.x * p.x + p.y * p.y + 0.25);
            if (distance > 1 + 1e-4) CHECK(frame.radiance.at(x, y, 0) == 0);
            if (distance < 1 - 1e-2) CHECK(frame.radiance.at(x, y, 0) > 0);
            if (std::abs(distance - 1) > 1e-4) CHECK(frame.aovs.at("light-count").at(x, y, 0) == float(distance < 1));
        }
}

TEST_CASE("renderer: lights at the camera, on a surface, behind everything and with degenerate cones stay finite") {
    Scene scene = sceneOf(quad(2), Material{});
    scene.lights = {pointLight(vec3(0, 0, 2)),          pointLight(vec3(0, 0, 0)),
                    pointLight(vec3(0, 0, 50), vec3(1), 1e-3f), spotLight(vec3(0, 0, 1), vec3(0, 0, -1), 0, 1e-4f),
                    spotLight(vec3(0, 0, 1), vec3(0, 0, -1), 0, float(kPi)), pointLight(vec3(0, 0, -1), vec3(1e6f))};
    ValidatedRenderer renderer;
    for (const std::string technique : {"brute-force", "fullscreen"})
        CHECK(allFinite(renderer.render(scene, {frontCamera(), {65, 65}}, {.lighting = technique}).radiance));
}

TEST_CASE("renderer: the depth set-up pass changes no pixel") {
    ValidatedRenderer renderer;
    for (const TestScene& test : testScenes()) {
        INFO("scene: " << test.name);
        renderer->setScene(test.scene);
        const Frame without = renderer->render(test.view, {});
        const Frame with = renderer->render(test.view, {.depthPrepass = true});
        CHECK(with.radiance.data == without.radiance.data);
        CHECK(with.stats.passes.front().name == "geometry.depth");
    }
}

TEST_CASE("renderer: of surfaces that coincide the same one is seen with the depth set-up pass and without") {
    Scene scene = sceneOf(quad(2), unlitMaterial(vec4(1, 0, 0, 1)));
    addObject(scene, quad(2), unlitMaterial(vec4(0, 1, 0, 1)));
    ValidatedRenderer renderer;
    const View view{frontCamera(), {9, 9}};
    CHECK(renderer.render(scene, view, {}).radiance.data == renderer.render(scene, view, {.depthPrepass = true}).radiance.data);
}

TEST_CASE("renderer: an object with a singular matrix is not drawn") {
    const Scene scene = sceneOf(quad(2), unlitMaterial(), glm::scale(mat4(1), vec3(1, 1, 0)));
    ValidatedRenderer renderer;
    const Frame frame = renderer.render(scene, {frontCamera(), {9, 9}}, {}, {"id"});
    CHECK(frame.aovs.at("id").at(4, 4, 0) == -1);
}

TEST_CASE("renderer: after a scene that the device can't hold it goes on with an empty one") {
    ValidatedRenderer renderer;
    Scene tooWide = sceneOf(quad(), {});
    tooWide.materials[0].baseColorTexture = addTexture(tooWide, 40000, 1, std::vector<uint8_t>(160000));
    CHECK_THROWS_WITH_AS(renderer->setScene(tooWide), doctest::Contains("texels 0"), Error);
    CHECK(renderer->render({frontCamera(), {9, 9}}, {}).radiance.at(4, 4, 0) == 0);
}

TEST_CASE("renderer: a surface far beyond what 16 bits of depth tell apart stays lit and finite") {
    Scene scene;
    const Material material = lambertMaterial(scene);
    addObject(scene, quad(20000), material);
    scene.lights = {directionalLight(vec3(0, 0, -1), vec3(float(kPi)))};
    ValidatedRenderer renderer;
    for (const auto layout : {GBufferLayout::calver, GBufferLayout::floatPosition, GBufferLayout::compact}) {
        const Frame frame = renderer.render(scene, {frontCamera(70000), {9, 9}}, {.gbuffer = layout}, {"depth"});
        CHECK(frame.radiance.at(4, 4, 0) == doctest::Approx(1).epsilon(1e-3));
        CHECK(allFinite(frame.aovs.at("depth")));
    }
}

TEST_CASE("renderer: a light that shines straight at the eye adds no NaN") {
    Scene scene = sceneOf(quad(2), Material{});
    const Material material = lambertMaterial(scene);
    addObject(scene, quad(1), material, glm::translate(mat4(1), vec3(0, 0, 0.5f)));
    scene.lights = {directionalLight(vec3(0, 0, 1))};
    ValidatedRenderer renderer;
    CHECK(allFinite(renderer.render(scene, {frontOrthographicCamera(), {17, 17}}, {}).radiance));
}

TEST_CASE("renderer: no light is lost beyond the 65,535 rounds after which a driver leaves its loops") {
    Scene scene;
    const Material material = lambertMaterial(scene);
    addObject(scene, quad(2), material);
    constexpr uint32_t kCount = 70000;
    scene.lights.assign(kCount, directionalLight(vec3(0, 0, -1), vec3(float(kPi) / kCount)));
    ValidatedRenderer renderer;
    const Frame frame = renderer.render(scene, {frontCamera(), {9, 9}}, {}, {"light-count", "id", "depth"});
    CHECK(frame.radiance.at(4, 4, 0) == doctest::Approx(1).epsilon(1e-3));  // a rounding per light
    CHECK(frame.aovs.at("light-count").at(4, 4, 0) == kCount);
    CHECK(frame.aovs.at("id").at(4, 4, 0) == 0);
    CHECK(frame.aovs.at("depth").at(4, 4, 0) == doctest::Approx(2));
}

TEST_CASE("renderer: a camera out of bounds is refused, and so by the reference") {
    ValidatedRenderer renderer;
    Camera far = frontCamera(), narrow = frontCamera();
    far.worldFromView[3] = vec4(1e20f, 0, 0, 1);
    narrow.yFov = 0;
    for (const Camera& camera : {far, narrow}) {
        CHECK_THROWS_AS(renderer->render({camera, {9, 9}}, {}), Error);
        CHECK_THROWS_AS(renderReference({}, {camera, {9, 9}}, {}), Error);
    }
}

TEST_CASE("renderer: more lights than a uniform block holds are all there") {
    Scene scene;
    const Material material = lambertMaterial(scene);
    addObject(scene, quad(2), material);
    ValidatedRenderer renderer;
    const View view{frontCamera(), {9, 9}};
    scene.lights.assign(shared::kUniformLights, directionalLight(vec3(0, 0, -1), vec3(0.001f)));
    const float within = renderer.render(scene, view, {}).radiance.at(4, 4, 0);
    scene.lights.assign(shared::kUniformLights + 1, directionalLight(vec3(0, 0, -1), vec3(0.001f)));
    const float beyond = renderer.render(scene, view, {}).radiance.at(4, 4, 0);
    const double count = shared::kUniformLights;
    CHECK(within == doctest::Approx(0.001 * count / kPi).epsilon(1e-3));  // a rounding per light
    CHECK(beyond / within == doctest::Approx((count + 1) / count).epsilon(1e-5));
}

TEST_CASE("renderer: materials beyond what a uniform block holds are all there") {
    const TestScene test = studio();
    Scene many = test.scene;
    many.materials.insert(many.materials.begin(), shared::kUniformMaterials, Material{});  // those that are seen come behind them
    for (Object& object : many.objects) object.material += shared::kUniformMaterials;
    ValidatedRenderer renderer;
    for (const std::string technique : {"brute-force", "forward-loop"}) {
        const Frame few = renderer.render(test.scene, test.view, {.lighting = technique});
        CHECK(renderer.render(many, test.view, {.lighting = technique}).radiance.data == few.radiance.data);
    }
}

TEST_CASE("renderer: any channel of any vertex may have a colour, on one object of a material or on all") {
    const View view{frontCamera(), {16, 12}};
    ValidatedRenderer renderer;
    const auto middle = [&](const Scene& scene, const std::string& technique, bool depthFirst) {
        return pixel(renderer.render(scene, view, {.lighting = technique, .gbuffer = GBufferLayout::calver, .depthPrepass = depthFirst}).radiance, 8, 6);
    };
    for (const std::string technique : {"brute-force", "forward-loop"})
        for (const bool depthFirst : {false, true}) {
            CAPTURE(technique);
            CAPTURE(depthFirst);
            for (int channel = 0; channel < 3; ++channel) {
                Mesh colored = quad(2);
                for (Vertex& vertex : colored.vertices) vertex.color[channel] = 0.25f;
                vec3 expected(1);
                expected[channel] = 0.25f;
                Scene scene = sceneOf(colored, unlitMaterial());
                CHECK(glm::distance(middle(scene, technique, depthFirst), expected) < 1e-4f);  // 16 bits
                // One that is white, with the same material, hides it.
                scene.meshes.push_back(quad(2));
                scene.objects.push_back({.name = "white", .mesh = 1, .material = 0, .worldFromObject = glm::translate(mat4(1), vec3(0, 0, 0.5f)), .objectId = 1});
                CHECK(glm::distance(middle(scene, technique, depthFirst), vec3(1)) < 1e-4f);
            }
            Mesh thin = quad(2);
            thin.vertices[2].color.a = 0;  // the corner at the top right: half as much in the middle
            Material masked = unlitMaterial();
            masked.alphaMode = AlphaMode::mask;
            masked.alphaCutoff = 0.6f;
            CHECK(middle(sceneOf(thin, masked), technique, depthFirst) == vec3(0));
            masked.alphaCutoff = 0.4f;
            CHECK(glm::distance(middle(sceneOf(thin, masked), technique, depthFirst), vec3(1)) < 1e-4f);
        }
}

TEST_CASE("renderer: times are there when measured, bytes always, and the graph names every pass") {
    const TestScene test = studio();
    ValidatedRenderer renderer;
    const Frame plain = renderer.render(test.scene, test.view, {});
    const Frame measured = renderer->render(test.view, {.measure = true});
    REQUIRE(plain.stats.passes.size() == measured.stats.passes.size());
    for (size_t i = 0; i < plain.stats.passes.size(); ++i) {
        CHECK_FALSE(plain.stats.passes[i].ms.has_value());
        CHECK(measured.stats.passes[i].ms.value() > 0);
        CHECK(plain.stats.passes[i].bytes > 0);
        CHECK(measured.graph.find(plain.stats.passes[i].name) != std::string::npos);
    }
    CHECK(measured.radiance.data == plain.radiance.data);
    CHECK(plain.stats.peakBytes > 192u * 144u * (4 + 4 + 8 + 2 + 4 + 16));  // at least the G-buffer and the light buffer
}
