#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include <luciole/reference.hpp>

#include "scene_building.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

const RenderSettings kShadowed{.shadows = Shadows::maps};

/// A floor in the plane z = 0, seen whole from above, and 1 m over it a square of 0.5 m a side. It shows the camera its back, so that the
/// camera sees through it: what casts is not what is seen.
Scene tableScene(Material cover = {.castsShadows = true}) {
    Scene scene;
    addObject(scene, quad(1), lambertMaterial(scene));
    const mat4 above = glm::translate(mat4(1), vec3(0, 0, 1)) * glm::rotate(mat4(1), float(kPi), vec3(1, 0, 0));
    addObject(scene, quad(0.25f), std::move(cover), above);
    return scene;
}

constexpr uint32_t kSide = 64;
const View kFromAbove{.camera = frontOrthographicCamera(3, 1), .extent = uvec2(kSide)};

/// Which pixels of the floor are as dark as with no light at all; the others must be as bright as without shadows.
std::vector<bool> darkPixels(const Scene& scene, const View& view = kFromAbove) {
    const Image shadowed = renderReference(scene, view, kShadowed).radiance;
    const Image lit = renderReference(scene, view, {}).radiance;
    std::vector<bool> dark(size_t(view.extent.x) * view.extent.y);
    for (size_t i = 0; i < dark.size(); ++i) {
        dark[i] = shadowed.data[3 * i] == 0 && lit.data[3 * i] > 0;
        if (!dark[i]) CHECK(shadowed.data[3 * i] == lit.data[3 * i]);
    }
    return dark;
}

/// Checks that exactly the pixels are dark whose centres lie in a box. No centre lies on its border.
void checkBox(const Scene& scene, vec2 low, vec2 high) {
    const std::vector<bool> dark = darkPixels(scene);
    size_t wrong = 0;
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x) {
            const vec2 at(2 * (float(x) + 0.5f) / kSide - 1, 1 - 2 * (float(y) + 0.5f) / kSide);
            const bool inside = glm::all(glm::greaterThan(at, low)) && glm::all(glm::lessThan(at, high));
            wrong += dark[size_t(y) * kSide + x] != inside;
        }
    CHECK(wrong == 0);
}

size_t darkCount(const Scene& scene) {
    const std::vector<bool> dark = darkPixels(scene);
    return size_t(std::count(dark.begin(), dark.end(), true));
}

}  // namespace

TEST_CASE("shadows: the square over the floor casts the square that geometry says, in each type of light") {
    Scene scene = tableScene();
    scene.lights = {pointLight(vec3(0, 0, 2), vec3(5))};
    checkBox(scene, vec2(-0.5f), vec2(0.5f));
    scene.lights = {pointLight(vec3(0.25f, -0.125f, 3), vec3(5))};  // by (P - light / 3) * 3 / 2
    checkBox(scene, 1.5f * (vec2(-0.25f) - vec2(0.25f, -0.125f) / 3.0f), 1.5f * (vec2(0.25f) - vec2(0.25f, -0.125f) / 3.0f));
    scene.lights = {spotLight(vec3(0, 0, 2), vec3(0, 0, -1), 0.9f, 1.2f, vec3(5))};
    checkBox(scene, vec2(-0.5f), vec2(0.5f));
    scene.lights = {directionalLight(vec3(0.5f, 0, -1))};
    checkBox(scene, vec2(0.25f, -0.25f), vec2(0.75f, 0.25f));
}

TEST_CASE("shadows: light, material and link group say who casts; what blends and what is too near to the light does not") {
    Scene scene = tableScene();
    scene.lights = {pointLight(vec3(0, 0, 2), vec3(5))};
    CHECK(darkCount(scene) == kSide * kSide / 4);
    Scene other = scene;
    other.lights[0].castsShadows = false;
    CHECK(darkCount(other) == 0);
    other = scene;
    other.materials[1].castsShadows = false;
    CHECK(darkCount(other) == 0);
    other = scene;
    other.materials[1].alphaMode = AlphaMode::blend;
    CHECK(darkCount(other) == 0);
    other = scene;
    other.linkGroups = {{"floor only", {true, true}, {true}}};
    other.lights[0].linkGroup = 0;
    CHECK(darkCount(other) == 0);
    other.linkGroups = {{"both", {true}, {false, true}}};
    CHECK(darkCount(other) == kSide * kSide / 4);
    other = scene;
    other.lights[0].positionWorld.z = 1 + 0.9f * kShadowNear;
    CHECK(darkCount(other) == 0);
    other.lights[0].positionWorld.z = 1 + 2.0f * kShadowNear;
    CHECK(darkCount(other) > 0.9 * kSide * kSide);
}

TEST_CASE("shadows: a mask cuts out its shadow") {
    Scene scene = tableScene();
    Material& mask = scene.materials[1];
    mask.alphaMode = AlphaMode::mask;
    // The left half is there. The square is turned about x: its left stays left.
    const Sampler nearest{.magFilter = Filter::nearest, .minFilter = Filter::nearest, .mipFilter = MipFilter::none};
    mask.baseColorTexture = addTexture(scene, 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}, nearest);
    scene.lights = {pointLight(vec3(0, 0, 2), vec3(5))};
    checkBox(scene, vec2(-0.5f), vec2(0, 0.5f));
}

TEST_CASE("shadows: a flat floor of many triangles, some twice, is lit to the last pixel at a grazing angle") {
    Scene scene;
    const Material white = lambertMaterial(scene);
    for (int x = -2; x < 3; ++x)
        for (int copy = 0; copy < 2; ++copy) addObject(scene, quad(0.3f), white, glm::rotate(glm::translate(mat4(1), vec3(0.4f * float(x), 0, 0)), 0.3f, vec3(0, 0, 1)));
    scene.lights = {directionalLight(vec3(1, 0.3f, -0.01f), vec3(100)), pointLight(vec3(-1, 0.2f, 0.002f), vec3(1))};
    CHECK(darkCount(scene) == 0);
}

TEST_CASE("shadows: a ball shades its far side and nothing of its near one") {
    Scene scene;
    addObject(scene, sphere(0.9f, 64, 32), lambertMaterial(scene));
    scene.lights = {directionalLight(vec3(-1, 0, -0.5f))};
    const Image shadowed = renderReference(scene, kFromAbove, kShadowed).radiance;
    const Image lit = renderReference(scene, kFromAbove, {}).radiance;
    for (size_t i = 0; i < shadowed.data.size(); ++i)
        if (lit.data[i] > 0.1 / kPi) CHECK(shadowed.data[i] == lit.data[i]);  // facets turn by up to 0.1 from the normal
}
