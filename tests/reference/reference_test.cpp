#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

#include <luciole/error.hpp>
#include <luciole/reference.hpp>

#include "output/fingerprint.shared.h"
#include "parallel/parallel_rows.hpp"
#include "scene_building.hpp"
#include "volume_building.hpp"

using namespace luciole;
using namespace luciole::test;
using doctest::Approx;

namespace {

/// What the only pixel shows: a ray straight through the origin, from +Z unless another camera is given.
vec3 centrePixel(const Scene& scene, const Camera& camera = frontCamera()) {
    return pixel(renderReference(scene, {.camera = camera, .extent = {1, 1}}, {}).radiance, 0, 0);
}

void checkColor(vec3 found, vec3 expected) {
    for (int c = 0; c < 3; ++c) CHECK(found[c] == Approx(expected[c]).epsilon(1e-6));  // stored as floats
}

bool allFinite(const Image& image) {
    return std::all_of(image.data.begin(), image.data.end(), [](float value) { return std::isfinite(value); });
}

}  // namespace

TEST_CASE("reference: a Lambert quad under a directional light shows colour * lux * cos / pi everywhere") {
    Scene scene;
    addObject(scene, quad(10), lambertMaterial(scene, vec3(0.8f, 0.4f, 0.2f)));
    scene.lights.push_back(directionalLight({0, -0.6f, -0.8f}, vec3(5)));
    const Frame frame = renderReference(scene, {.camera = frontCamera(), .extent = {5, 3}}, {});
    for (uint32_t y = 0; y < 3; ++y)
        for (uint32_t x = 0; x < 5; ++x)
            checkColor(pixel(frame.radiance, x, y), vec3(0.8f, 0.4f, 0.2f) * float(5 * 0.8 / kPi));
}

TEST_CASE("reference: lights add up, and one at its range adds exactly nothing") {
    Scene scene;
    addObject(scene, quad(), lambertMaterial(scene));
    scene.lights.push_back(pointLight({0, 0, 2}, vec3(8, 0, 0)));
    checkColor(centrePixel(scene), vec3(2 / float(kPi), 0, 0));
    scene.lights.push_back(pointLight({0, 0, 1}, vec3(0, 1, 0), 3));
    checkColor(centrePixel(scene), vec3(2, 80.0f / 81, 0) / float(kPi));
    scene.lights[1].range = 1;
    CHECK(centrePixel(scene).g == 0);
}

TEST_CASE("reference: a light exactly at the surface gives finite numbers") {
    Scene scene;
    addObject(scene, quad(), Material{});
    scene.objects.push_back(scene.objects[0]);
    scene.materials.push_back(lambertMaterial(scene));
    scene.lights.push_back(pointLight({0, 0, 0}));
    scene.lights.push_back(spotLight({0, 0, 0}, {0, 0, -1}, 0.1f, 0.5f));
    for (const uint32_t material : {0u, 1u}) {
        scene.objects[0].material = scene.objects[1].material = material;
        const Frame frame = renderReference(scene, {.camera = frontCamera(), .extent = {3, 3}}, {});
        CHECK(allFinite(frame.radiance));
        CHECK(allFinite(frame.display));
    }
}

TEST_CASE("reference: an infinite viewer sees the same highlight everywhere, a near one does not") {
    Scene scene;
    Material material = lambertMaterial(scene);
    material.shaped.ks = 1;
    material.shaped.specularFunction = addFunction(scene, Function::Kind::blinnPhong, 16);
    addObject(scene, quad(10), material);
    scene.lights.push_back(directionalLight({0, 0, -1}, vec3(float(kPi))));
    const View view{.camera = frontCamera(2, 1.5f), .extent = {3, 3}};
    CHECK(renderReference(scene, view, {}).radiance.at(0, 0, 0) < 1.5f);
    scene.lights[0].infiniteViewer = true;
    const Frame frame = renderReference(scene, view, {});
    for (const float value : frame.radiance.data) CHECK(value == Approx(2).epsilon(1e-6));
}

TEST_CASE("reference: a light with a link group lights the objects in it only") {
    Scene scene;
    addObject(scene, quad(), lambertMaterial(scene), glm::translate(mat4(1), vec3(-1, 0, 0)));
    addObject(scene, quad(), lambertMaterial(scene), glm::translate(mat4(1), vec3(1, 0, 0)));
    scene.lights.push_back(directionalLight({0, 0, -1}));
    scene.lights[0].linkGroup = 0;
    scene.linkGroups.push_back({.name = "right", .litObjects = {false, true}});
    const View view{.camera = frontOrthographicCamera(), .extent = {2, 2}};
    const Frame frame = renderReference(scene, view, {}, {"light-count"});
    CHECK(frame.radiance.at(0, 0, 0) == 0);
    CHECK(frame.radiance.at(1, 0, 0) == Approx(1 / kPi));
    CHECK(frame.aovs.at("light-count").at(0, 0, 0) == 0);
    CHECK(frame.aovs.at("light-count").at(1, 0, 0) == 1);
}

TEST_CASE("reference: a light with a volume lights what is inside only, and layers say which lights reach a pixel") {
    Scene scene;
    addObject(scene, quad(), lambertMaterial(scene));
    scene.lights = {directionalLight({0, 0, -1}), directionalLight({0, 0, -1}), pointLight({0, 0, 9}, vec3(1), 1)};
    scene.lights[1].volume = 0;
    // Seen from the front an L without its upper right quarter, and behind the quad as much as before it.
    LightVolume volume = boxVolume({-2, -2, -1}, {0, 2, 1});
    append(volume, boxVolume({0, -2, -1}, {2, 0, 1}));
    scene.lightVolumes.push_back(volume);
    validate(scene);
    const View view{.camera = frontOrthographicCamera(2, 1.25f), .extent = {10, 10}};
    const Frame frame =
        renderReference(scene, view, {}, {"light-count", "evaluations", "useful-evaluations", "light-fingerprint"});
    for (uint32_t y = 0; y < 10; ++y)
        for (uint32_t x = 0; x < 10; ++x) {
            const bool there = x > 0 && x < 9 && y > 0 && y < 9;  // pixels of 0.25 m, a quad of 2 m
            const bool inside = there && (x < 5 || y >= 5);
            const auto layer = [&](const char* name) { return frame.aovs.at(name).at(x, y, 0); };
            CHECK(frame.radiance.at(x, y, 0) == Approx((there + inside) / kPi).epsilon(1e-6));
            CHECK(layer("light-count") == there + inside);
            CHECK(layer("useful-evaluations") == there + inside);
            CHECK(layer("evaluations") == (there ? 3 : 0));
            CHECK(layer("light-fingerprint") ==
                  float(there * shared::fingerprint(0) + inside * shared::fingerprint(1)));
        }
}

TEST_CASE("reference: a double-sided quad seen from behind is lit from behind") {
    Scene scene;
    Material material = lambertMaterial(scene);
    material.doubleSided = true;
    addObject(scene, quad(), material, glm::rotate(mat4(1), float(kPi), vec3(0, 1, 0)));
    scene.lights.push_back(directionalLight({0, 0, -1}, vec3(float(kPi))));
    checkColor(centrePixel(scene), vec3(1));
    scene.materials[0].doubleSided = false;
    CHECK(centrePixel(scene) == vec3(0));
}

TEST_CASE("reference: a normal map tilts the normal along tangent and bitangent, mirrored objects included") {
    const auto normalOf = [](mat4 worldFromObject, float scale) {
        Scene scene;
        Material material;
        material.normalTexture = addTexture(scene, 1, 1, {204, 153, 255, 255});  // (0.6, 0.2, 1)
        material.normalScale = scale;
        addObject(scene, quad(), material, worldFromObject);
        const Frame frame = renderReference(scene, {.camera = frontCamera(), .extent = {1, 1}}, {}, {"normal"});
        return pixel(frame.aovs.at("normal"), 0, 0);
    };
    checkColor(normalOf(mat4(1), 1), normalize(vec3(0.6f, 0.2f, 1)));
    checkColor(normalOf(mat4(1), 0.5f), normalize(vec3(0.3f, 0.1f, 1)));
    checkColor(normalOf(glm::scale(mat4(1), vec3(-1, 1, 1)), 1), normalize(vec3(-0.6f, 0.2f, 1)));
    checkColor(normalOf(glm::scale(mat4(1), vec3(3, 2, 1)), 1), normalize(vec3(0.6f, 0.2f, 1)));
}

TEST_CASE("reference: normals take the inverse transpose") {
    // A quad turned by 45 degrees round X, then squashed along Y to a half: its plane's normal is (0, -2, 1) / sqrt 5.
    const mat4 turned = glm::rotate(mat4(1), float(kPi / 4), vec3(1, 0, 0));
    const Scene scene = sceneOf(quad(), unlitMaterial(), glm::scale(mat4(1), vec3(1, 0.5f, 1)) * turned);
    const Frame frame = renderReference(scene, {.camera = frontCamera(), .extent = {1, 1}}, {}, {"normal"});
    CHECK(length(pixel(frame.aovs.at("normal"), 0, 0) - vec3(0, -2, 1) / std::sqrt(5.0f)) < 1e-6f);
}

TEST_CASE("reference: a hole in an alpha mask shows what is behind, with the texture's own edge") {
    Scene scene;
    Material masked = unlitMaterial(vec4(0, 1, 0, 0.5f));
    masked.alphaMode = AlphaMode::mask;
    masked.alphaCutoff = 0.4f;
    masked.baseColorTexture =
        addTexture(scene, 2, 1, {255, 255, 255, 100, 255, 255, 255, 255},
                   {.magFilter = Filter::nearest, .minFilter = Filter::nearest, .mipFilter = MipFilter::none});
    addObject(scene, quad(), masked);
    addObject(scene, quad(), unlitMaterial({1, 0, 0, 1}), glm::translate(mat4(1), vec3(0, 0, -1)));
    const View view{.camera = frontOrthographicCamera(), .extent = {4, 4}};
    const Frame frame = renderReference(scene, view, {}, {"depth"});
    checkColor(pixel(frame.radiance, 1, 0), {1, 0, 0});
    checkColor(pixel(frame.radiance, 2, 0), {0, 1, 0});
    CHECK(frame.aovs.at("depth").at(1, 0, 0) == Approx(3));
    CHECK(frame.aovs.at("depth").at(2, 0, 0) == Approx(2));
}

TEST_CASE("reference: one pixel to a texel shows the texels, one to four shows their mean in linear light") {
    std::vector<uint8_t> rgba;
    for (uint8_t y = 0; y < 8; ++y)
        for (uint8_t x = 0; x < 8; ++x) {
            const uint8_t value = (x + y) % 2 ? 255 : 0;
            rgba.insert(rgba.end(), {value, value, value, 255});
        }
    Scene scene;
    Material material = unlitMaterial();
    material.baseColorTexture = addTexture(scene, 8, 8, rgba);
    addObject(scene, quad(), material);
    const auto render = [&](uint32_t size, const Camera& camera) {
        return renderReference(scene, {.camera = camera, .extent = {size, size}}, {}).radiance;
    };
    const Image texels = render(8, frontOrthographicCamera());
    for (uint32_t x = 0; x < 8; ++x) CHECK(texels.at(x, 3, 0) == Approx((x + 3) % 2).epsilon(1e-6));
    // Half the light is byte 188 in level 1, which decodes to 0.50289. The quad's edge at the picture's: a perspective
    // camera at 1 / tan(yFov / 2) sees the same.
    const float grey = 0.5028865f;
    for (const float value : render(4, frontOrthographicCamera()).data) CHECK(value == Approx(grey).epsilon(1e-6));
    for (const float value : render(4, frontCamera(2, 2 * std::atan(0.5f))).data)
        CHECK(value == Approx(grey).epsilon(1e-5));
}

TEST_CASE("reference: texture coordinates pass through their transform, from the set that is asked for") {
    Scene scene;
    const Sampler nearest{.magFilter = Filter::nearest, .minFilter = Filter::nearest, .mipFilter = MipFilter::none};
    Material material = unlitMaterial();
    material.baseColorTexture = addTexture(scene, 2, 1, {255, 0, 0, 255, 0, 255, 0, 255}, nearest);
    Mesh mesh = quad();
    for (Vertex& vertex : mesh.vertices) vertex.uv1 = vec2(0.75f);
    addObject(scene, mesh, material);
    Camera camera = frontCamera();
    camera.worldFromView[3].x = -0.5f;  // u = 0.25
    checkColor(centrePixel(scene, camera), {1, 0, 0});
    scene.materials[0].baseColorTexture.uvTransform[0] = vec3(1, 0, 0.5f);
    checkColor(centrePixel(scene, camera), {0, 1, 0});
    scene.materials[0].baseColorTexture.uvTransform[0] = vec3(1, 0, 0);
    scene.materials[0].baseColorTexture.uvSet = 1;
    checkColor(centrePixel(scene, camera), {0, 1, 0});
}

TEST_CASE("reference: vertex colours are interpolated and multiply the base colour") {
    Scene scene = sceneOf(quad(), unlitMaterial({0.5f, 1, 1, 1}));
    for (Vertex& vertex : scene.meshes[0].vertices) vertex.color = vec4(vertex.position.x * 0.5f + 0.5f, 1, 0, 1);
    const Frame frame = renderReference(scene, {.camera = frontOrthographicCamera(), .extent = {4, 4}}, {});
    for (uint32_t x = 0; x < 4; ++x) checkColor(pixel(frame.radiance, x, 1), {0.5f * (float(x) + 0.5f) / 4, 1, 0});
}

TEST_CASE("reference: metallic-roughness textures scale their factors") {
    Scene scene;
    Material material{.metallic = 1, .roughness = 0.5f, .emissive = vec3(2, 4, 0), .occlusionStrength = 0.5f};
    material.metallicRoughnessTexture = addTexture(scene, 1, 1, {0, 255, 0, 255});  // metallic 0
    material.occlusionTexture = addTexture(scene, 1, 1, {51, 0, 0, 255});           // 0.2: 1 + 0.5 * -0.8 = 0.6
    material.emissiveTexture = addTexture(scene, 1, 1, {255, 0, 255, 255});
    addObject(scene, quad(), material);
    scene.ambience = {.sky = vec3(1), .ground = vec3(1)};
    const View view{.camera = frontCamera(), .extent = {1, 1}};
    const Frame frame = renderReference(scene, view, {}, {"cs0", "cs1"});
    checkColor(pixel(frame.radiance, 0, 0), {2.6f, 0.6f, 0.6f});
    checkColor(pixel(frame.aovs.at("cs0"), 0, 0), {1, 1, 1});
    checkColor(pixel(frame.aovs.at("cs1"), 0, 0), {0.5f, 0, 0});
    scene.ambience = {};
    scene.materials[0].emissive = vec3(0);
    scene.lights.push_back(directionalLight({0, 0, -1}));  // 0.96 / pi + 0.04 / (4 pi / 16), as metallic is 0
    checkColor(centrePixel(scene), vec3(float(0.96 / kPi + 0.16 / kPi)));
}

TEST_CASE("reference: a shaped material's coefficients are folded into its colours") {
    Scene scene;
    Material material = lambertMaterial(scene, vec3(1, 0.5f, 0.25f));
    material.shaped.kd = 0.5f;
    material.shaped.ks = 0.25f;
    material.shaped.specularColor = vec3(1, 2, 4);
    material.shaped.kEmissive = 2;
    addObject(scene, quad(), material);
    const View view{.camera = frontCamera(), .extent = {1, 1}};
    const Frame frame = renderReference(scene, view, {}, {"cs0", "cs1"});
    checkColor(pixel(frame.aovs.at("cs0"), 0, 0), {0.5f, 0.25f, 0.125f});
    checkColor(pixel(frame.aovs.at("cs1"), 0, 0), {0.25f, 0.5f, 1});
    checkColor(pixel(frame.radiance, 0, 0), {0.5f, 1, 2});
}

TEST_CASE("reference: a checker far away shows the mean of its colours, near by one of them") {
    Scene scene;
    Material material = unlitMaterial({1, 0, 0, 1});
    material.surface = SurfaceShader::checker;
    material.proceduralColor = vec3(0, 0, 1);
    addObject(scene, quad(10), material);
    const vec3 near = pixel(
        renderReference(scene, {.camera = frontOrthographicCamera(2, 0.01f), .extent = {4, 4}}, {}).radiance, 0, 0);
    CHECK(std::abs(near.r - near.b) == Approx(1).epsilon(1e-6));
    const Frame far = renderReference(scene, {.camera = frontOrthographicCamera(2, 8), .extent = {8, 8}}, {});
    // Pixels are exactly two cells wide.
    for (uint32_t x = 0; x < 8; ++x) checkColor(pixel(far.radiance, x, 3), {0.5f, 0, 0.5f});
}

TEST_CASE("reference: what is nearer than the near plane or beyond an orthographic far plane is not drawn") {
    const Scene scene = sceneOf(quad(), unlitMaterial());
    Camera camera = frontCamera(2);
    camera.zNear = 1.99f;
    CHECK(centrePixel(scene, camera) == vec3(1));
    camera.zNear = 2.01f;
    CHECK(centrePixel(scene, camera) == vec3(0));
    camera = frontOrthographicCamera(2);
    camera.zFar = 2.01f;
    CHECK(centrePixel(scene, camera) == vec3(1));
    camera.zFar = 1.99f;
    CHECK(centrePixel(scene, camera) == vec3(0));
}

TEST_CASE("reference: layers say what a pixel shows, and that nothing is where nothing is") {
    Scene scene;
    addObject(scene, quad(), unlitMaterial());
    addObject(scene, quad(0.4f), unlitMaterial(), glm::translate(mat4(1), vec3(0, 0, 1)));
    scene.objects[1].objectId = 77;
    scene.lights = {pointLight({0, 0, 0}, vec3(1), 1.5f), pointLight({0, 0, 9}, vec3(1), 1),
                    spotLight({0, 0, 3}, {0, 0, -1}, 0.1f, 0.2f), directionalLight({0, 0, -1})};
    const View view{.camera = frontOrthographicCamera(4, 1.5f), .extent = {3, 3}};
    const auto aovs = renderReference(scene, view, {}, {"depth", "normal", "material", "id", "light-count"}).aovs;
    CHECK(aovs.at("depth").at(1, 1, 0) == Approx(3));
    CHECK(aovs.at("material").at(1, 1, 0) == 1);
    CHECK(aovs.at("id").at(1, 1, 0) == 77);
    CHECK(aovs.at("light-count").at(1, 1, 0) == 3);
    CHECK(pixel(aovs.at("normal"), 1, 1) == vec3(0, 0, 1));
    const View wide{.camera = frontOrthographicCamera(4, 9), .extent = {3, 3}};
    const auto nothing = renderReference(scene, wide, {}, {"depth", "normal", "material", "id", "light-count"}).aovs;
    CHECK(nothing.at("depth").at(0, 0, 0) == 0);
    CHECK(nothing.at("material").at(0, 0, 0) == -1);
    CHECK(nothing.at("id").at(0, 0, 0) == -1);
    CHECK(nothing.at("light-count").at(0, 0, 0) == 0);
    CHECK(pixel(nothing.at("normal"), 0, 0) == vec3(0));
}

TEST_CASE("reference: an empty scene is black, at any size") {
    for (const uvec2 extent : {uvec2(1, 1), uvec2(7, 13), uvec2(31, 1), uvec2(1, 17)}) {
        const Frame frame = renderReference({}, {.camera = {}, .extent = extent}, {}, {"depth"});
        CHECK((frame.radiance.width == extent.x && frame.radiance.height == extent.y));
        CHECK((frame.display.width == extent.x && frame.display.height == extent.y));
        CHECK(std::all_of(frame.radiance.data.begin(), frame.radiance.data.end(), [](float v) { return v == 0; }));
    }
}

TEST_CASE("reference: exposure of scene and settings together scales the shown picture, not the radiance") {
    Scene scene = sceneOf(quad(), unlitMaterial(vec4(0.001f)));
    scene.exposureEv = 1;
    const RenderSettings settings{.exposureEv = -2, .toneMap = ToneMap::none};
    const Frame frame = renderReference(scene, {.camera = frontCamera(), .extent = {1, 1}}, settings);
    CHECK(frame.radiance.at(0, 0, 0) == 0.001f);
    CHECK(frame.display.at(0, 0, 0) == Approx(12.92 * 0.0005).epsilon(1e-5));  // on the linear piece of sRGB
}

TEST_CASE("reference: statistics say what was drawn and by what") {
    Scene scene = sceneOf(sphere(), unlitMaterial());
    scene.lights.resize(3);
    const Frame frame = renderReference(scene, {.camera = frontCamera(), .extent = {2, 2}}, {});
    CHECK(frame.stats.triangles == 2 * 32 * 15);
    CHECK(frame.stats.lights == 3);
    CHECK(frame.stats.deviceName == "CPU");
    CHECK(frame.stats.driver.starts_with("Embree "));
    REQUIRE(frame.stats.passes.size() == 1);
    CHECK(frame.stats.passes[0].name == "reference");
}

TEST_CASE("reference: two renderings of one scene are equal to the last bit") {
    Scene scene;
    addObject(scene, sphere(), Material{.metallic = 0.3f, .roughness = 0.4f});
    for (int i = 0; i < 9; ++i) scene.lights.push_back(pointLight({float(i % 3), float(i / 3), 2}, vec3(1), 4));
    const View view{.camera = frontCamera(3), .extent = {61, 47}};
    CHECK(renderReference(scene, view, {}).radiance.data == renderReference(scene, view, {}).radiance.data);
}

TEST_CASE("reference: progress rises to 1, and a caller who has seen enough gets an empty frame") {
    const Scene scene = sceneOf(quad(), unlitMaterial());
    const View view{.camera = frontCamera(), .extent = {9, 9}};
    double last = 0;
    const auto watch = [&](double done) {
        CHECK(done >= last);
        last = done;
        return true;
    };
    CHECK(renderReference(scene, view, {}, {}, watch).radiance.width == 9);
    CHECK(last == 1);
    CHECK(renderReference(scene, view, {}, {"depth"}, [](double) { return false; }).radiance.data.empty());
}

TEST_CASE("reference: unknown layers and impossible sizes are usage errors that name them") {
    const auto message = [](const View& view, const std::vector<std::string>& aovs) -> std::string {
        try {
            renderReference({}, view, {}, aovs);
        } catch (const Error& error) {
            return error.kind() == ErrorKind::usage ? error.what() : "";
        }
        return "";
    };
    CHECK(message({.camera = {}, .extent = {1, 1}}, {"detph"}).find("detph") != std::string::npos);
    CHECK(message({.camera = {}, .extent = {0, 5}}, {}).find("0x5") != std::string::npos);
    CHECK(message({.camera = {}, .extent = {1, 16385}}, {}).find("16385") != std::string::npos);
}

TEST_CASE("parallel rows: each row is done once, and what a row throws reaches the caller") {
    std::vector<std::atomic<int>> times(1000);
    CHECK(forEachRow(1000, [&](uint32_t row) { ++times[row]; }, {}));
    CHECK(std::all_of(times.begin(), times.end(), [](const auto& n) { return n == 1; }));
    const auto failing = [](uint32_t row) {
        if (row == 500) throw std::runtime_error("row 500");
    };
    CHECK_THROWS_WITH(forEachRow(1000, failing, {}), "row 500");
}
