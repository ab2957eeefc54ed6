#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include <luciole/reference.hpp>

#include "output/fingerprint.shared.h"
#include "scene_building.hpp"

using namespace luciole;
using namespace luciole::test;
using doctest::Approx;

namespace {

Material blended(Material material, float alpha) {
    material.alphaMode = AlphaMode::blend;
    material.baseColor.a = alpha;
    return material;
}

/// Adds a quad that faces the camera.
void addLayer(Scene& scene, float z, const Material& material) {
    addObject(scene, quad(), material, glm::translate(mat4(1), vec3(0, 0, z)));
}

/// The only pixel shows the middle of the quads, a point of their diagonal.
Frame centre(const Scene& scene, const std::vector<std::string>& layers = {}) {
    return renderReference(scene, {.camera = frontCamera(), .extent = {1, 1}}, {}, layers);
}

void checkCentre(const Scene& scene, vec3 expected) {
    const vec3 found = pixel(centre(scene).radiance, 0, 0);
    for (int c = 0; c < 3; ++c) CHECK(found[c] == Approx(expected[c]).epsilon(1e-6));  // stored as floats
}

constexpr vec4 kRed{1, 0, 0, 1}, kGreen{0, 1, 0, 1}, kBlue{0, 0, 1, 1};

}  // namespace

TEST_CASE("blend: what is behind an unlit surface shows through by 1 - alpha") {
    Scene scene;
    addLayer(scene, 0, unlitMaterial({0.8f, 0.4f, 0.2f, 1}));
    addLayer(scene, 1, blended(unlitMaterial({0, 0.5f, 1, 1}), 0.25f));
    checkCentre(scene, {0.6f, 0.425f, 0.4f});
}

TEST_CASE("blend: the nearer of two surfaces lies over the farther one, whatever their order in the scene") {
    for (const bool nearFirst : {false, true}) {
        Scene scene;
        const auto near = [&] { addLayer(scene, 1, blended(unlitMaterial(kGreen), 0.5f)); };
        if (nearFirst) near();
        addLayer(scene, 0.5f, blended(unlitMaterial(kRed), 0.25f));
        addLayer(scene, 0, unlitMaterial(kBlue));
        if (!nearFirst) near();
        checkCentre(scene, {0.5f * 0.25f, 0.5f, 0.5f * 0.75f});
    }
}

TEST_CASE("blend: behind the last surface it is black, and behind an opaque one nothing blends") {
    Scene scene;
    addLayer(scene, 0, blended(unlitMaterial(kRed), 0.25f));
    checkCentre(scene, {0.25f, 0, 0});
    addLayer(scene, 1, unlitMaterial(kBlue));
    checkCentre(scene, {0, 0, 1});
}

TEST_CASE("blend: at alpha 0 a surface doesn't show, at 1 nothing else does, and alpha ends there") {
    for (const float alpha : {-1.0f, 0.0f, 1.0f, 2.0f}) {
        Scene scene;
        addLayer(scene, 0, unlitMaterial(kBlue));
        addLayer(scene, 1, blended(unlitMaterial(kRed), alpha));
        CHECK(pixel(centre(scene).radiance, 0, 0) == vec3(alpha > 0 ? kRed : kBlue));
    }
}

TEST_CASE("blend: alpha is the product of factor, texture and vertex colour, and no cutoff applies") {
    Scene scene;
    Material material = blended(unlitMaterial(), 0.5f);
    material.baseColorTexture = addTexture(scene, 1, 1, {255, 255, 255, 51});  // 0.2
    addLayer(scene, 0, material);
    for (Vertex& vertex : scene.meshes[0].vertices) vertex.color.a = 0.75f;
    checkCentre(scene, vec3(0.075f));
}

TEST_CASE("blend: a lit surface adds alpha times what an opaque one shows, emission included") {
    Scene scene;
    addLayer(scene, 0, unlitMaterial({0.5f, 0.5f, 0.5f, 1}));
    addLayer(scene, 1, blended(lambertMaterial(scene, vec3(0.8f, 0.4f, 0.2f)), 0.25f));
    scene.lights = {directionalLight({0, -0.6f, -0.8f}, vec3(5)), directionalLight({0, 0.6f, -0.8f}, vec3(3))};
    checkCentre(scene, vec3(0.375f) + vec3(0.8f, 0.4f, 0.2f) * float(0.25 * 8 * 0.8 / kPi));
    scene.materials[1] = blended({.metallic = 0, .emissive = vec3(2, 0, 1)}, 0.25f);
    scene.lights.clear();
    checkCentre(scene, vec3(0.375f) + vec3(0.5f, 0, 0.25f));
}

TEST_CASE("blend: the back of a surface is there, and lit, if the surface is double-sided") {
    Scene scene;
    addObject(scene, quad(), blended(lambertMaterial(scene), 0.5f), glm::rotate(mat4(1), float(kPi), vec3(0, 1, 0)));
    scene.lights.push_back(directionalLight({0, 0, -1}, vec3(float(kPi))));
    checkCentre(scene, vec3(0));
    scene.materials[0].doubleSided = true;
    checkCentre(scene, vec3(0.5f));
}

TEST_CASE("blend: a mask hides by its cutoff what lies behind it, and lets it blend through its holes") {
    for (const float alpha : {0.3f, 0.6f}) {
        Scene scene;
        Material mask = unlitMaterial({0, 0, 1, alpha});
        mask.alphaMode = AlphaMode::mask;
        addLayer(scene, 1, mask);
        addLayer(scene, 0, blended(unlitMaterial(kRed), 0.5f));
        checkCentre(scene, alpha < 0.5f ? vec3(0.5f, 0, 0) : vec3(kBlue));
    }
}

TEST_CASE("blend: a surface that coincides with an opaque one lies over it") {
    for (const bool opaqueFirst : {false, true}) {
        Scene scene;
        if (opaqueFirst) addLayer(scene, 0, unlitMaterial(kBlue));
        addLayer(scene, 0, blended(unlitMaterial(kRed), 0.25f));
        if (!opaqueFirst) addLayer(scene, 0, unlitMaterial(kBlue));
        checkCentre(scene, {0.25f, 0, 0.75f});
    }
}

TEST_CASE("blend: each pixel of a tessellated surface blends it once, on its edges and vertices too") {
    // Looking along the axis of a sphere: pixel centres lie on the pole and on the edges that leave it.
    Scene scene =
        sceneOf(sphere(), blended(unlitMaterial(), 0.25f), glm::rotate(mat4(1), float(kPi / 2), vec3(1, 0, 0)));
    const View view{.camera = frontOrthographicCamera(2, 0.5f), .extent = {33, 33}};
    for (const float value : renderReference(scene, view, {}).radiance.data) CHECK(value == 0.25f);
}

TEST_CASE("blend: two hundred surfaces a tenth of a millimetre apart all count, in one mesh or in many") {
    Scene many, one;
    Mesh stack;
    for (int i = 0; i < 200; ++i) {
        const float z = 1e-4f * float(i);
        addLayer(many, z, blended(unlitMaterial(), 0.01f));
        Mesh layer = quad();
        for (uint32_t& index : layer.indices) index += uint32_t(stack.vertices.size());
        for (Vertex& vertex : layer.vertices) vertex.position.z = z;
        stack.vertices.insert(stack.vertices.end(), layer.vertices.begin(), layer.vertices.end());
        stack.indices.insert(stack.indices.end(), layer.indices.begin(), layer.indices.end());
    }
    addObject(one, stack, blended(unlitMaterial(), 0.01f));
    const auto expected = float(1 - std::pow(1 - double(0.01f), 200));
    checkCentre(many, vec3(expected));
    checkCentre(one, vec3(expected));
}

TEST_CASE("blend: surfaces before the near plane or beyond an orthographic far plane are not drawn") {
    Scene scene;
    addLayer(scene, 0, blended(unlitMaterial(kRed), 0.5f));
    Camera camera = frontOrthographicCamera(2);
    const auto red = [&](float zNear, float zFar) {
        camera.zNear = zNear;
        camera.zFar = zFar;
        return renderReference(scene, {.camera = camera, .extent = {1, 1}}, {}).radiance.at(0, 0, 0);
    };
    CHECK(red(1.99f, 2.01f) == 0.5f);
    CHECK(red(2.01f, 3) == 0);
    CHECK(red(1, 1.99f) == 0);
}

TEST_CASE("blend: evaluations and their fingerprint are those of all surfaces, other layers tell of the opaque one") {
    Scene scene;
    addLayer(scene, 0, lambertMaterial(scene, vec3(0.5f)));
    addLayer(scene, 1, blended(lambertMaterial(scene), 0.5f));
    addLayer(scene, 1.5f, blended({}, 0));
    // The first light reaches all three, the second the opaque one only, the third the nearest only.
    scene.lights = {directionalLight({0, 0, -1}), pointLight({0, 0, 0.25f}, vec3(1), 0.5f),
                    pointLight({0, 0, 1.75f}, vec3(1), 0.5f)};
    const std::vector<std::string> ofOne{"depth", "normal", "cs0", "cs1", "material", "id", "light-count"};
    std::vector<std::string> names = ofOne;
    names.insert(names.end(), {"evaluations", "useful-evaluations", "light-fingerprint"});
    const auto all = centre(scene, names).aovs;
    const auto value = [&](const char* name) { return all.at(name).at(0, 0, 0); };
    CHECK(value("evaluations") == 9);
    CHECK(value("useful-evaluations") == 5);
    CHECK(value("light-fingerprint") ==
          float(3 * shared::fingerprint(0) + shared::fingerprint(1) + shared::fingerprint(2)));
    scene.objects.resize(1);
    const auto alone = centre(scene, ofOne).aovs;
    for (const std::string& name : ofOne) CHECK(all.at(name).data == alone.at(name).data);
}
