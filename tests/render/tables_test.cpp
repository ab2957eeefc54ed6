#include "render/tables.hpp"

#include <cstring>

#include <doctest/doctest.h>

#include "scene_building.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

dvec4 project(const dmat4& m, dvec3 p) {
    const dvec4 clip = m * dvec4(p, 1);
    return clip / clip.w;
}

}  // namespace

TEST_CASE("projection: reversed depth is 1 at the near plane and falls as near / distance") {
    const Camera camera{.yFov = 1.0f, .zNear = 0.5f};
    const dmat4 clip = render::clipFromView(camera, 1.5);
    CHECK(project(clip, {0, 0, -0.5}).z == doctest::Approx(1));
    CHECK(project(clip, {0, 0, -5}).z == doctest::Approx(0.1));
    CHECK(project(clip, {0, 0, -1e9}).z == doctest::Approx(0));
}

TEST_CASE("projection: the top edge of the field of view lies at y = -1, Vulkan's top") {
    const Camera camera{.yFov = 1.0f};
    const dmat4 clip = render::clipFromView(camera, 2.0);
    CHECK(project(clip, {0, 3 * std::tan(0.5), -3}).y == doctest::Approx(-1));
    CHECK(project(clip, {2 * 3 * std::tan(0.5), 0, -3}).x == doctest::Approx(1));
}

TEST_CASE("projection: orthographic depth is 1 at the near and 0 at the far plane") {
    const Camera camera{.orthographic = true, .halfHeight = 2, .zNear = 1, .zFar = 11};
    const dmat4 clip = render::clipFromView(camera, 1.0);
    CHECK(project(clip, {0, 0, -1}).z == doctest::Approx(1));
    CHECK(project(clip, {0, 0, -11}).z == doctest::Approx(0));
    CHECK(project(clip, {0, 2, -5}).y == doctest::Approx(-1));
}

TEST_CASE("warp matrix: takes what the G-buffer stores back to the position from the eye, in world axes") {
    for (const bool orthographic : {false, true}) {
        View view{frontCamera(), {200, 100}};
        view.camera.orthographic = orthographic;
        view.camera.worldFromView = lookAt(vec3(100, 20, -30), vec3(101, 19, -30.5f));
        const auto constants = render::viewConstants(view, {});
        const dvec3 point(0.3, -0.2, -4);
        const dvec4 ndc = project(render::clipFromView(view.camera, 2.0), point);
        const dvec4 stored(ndc.x * 0.5 + 0.5, ndc.y * 0.5 + 0.5, ndc.z, 1);
        const dvec4 back = dmat4(constants.shadingFromGBuffer) * stored;
        // The matrix holds floats: 2^-24 relative in depth, and w is near / distance, 1 / 40.
            CHECK(glm::length(dvec3(back) / back.w - dmat3(view.camera.worldFromView) * point) < 4.0 * 40 * std::exp2(-24) * glm::length(point));
    }
}

TEST_CASE("function table: x = 0 is a sample, so that Lambert's kink is exact") {
    const auto table = render::functionTable({{.kind = Function::Kind::lambert}});
    REQUIRE(table.size() == 2 * shared::kFunctionSamples);
    CHECK(table[shared::kFunctionSamples / 2] == vec2(0, 0));
    CHECK(table[shared::kFunctionSamples / 2 + 1].y == 1);
    CHECK(table[shared::kFunctionSamples - 1] == vec2(1, 1));
}

TEST_CASE("function table: the second half of the rows spans [0, 1], for attenuation") {
    const auto table = render::functionTable({{.kind = Function::Kind::sampled, .samples = {vec2(1, 0), vec2(0, 0)}}});
    CHECK(table[shared::kFunctionSamples].x == 1);
    CHECK(table[shared::kFunctionSamples + shared::kFunctionSamples / 2].x == doctest::Approx(0.5));
    CHECK(table.back().x == 0);
}

TEST_CASE("light table: positions and directions are in world space, flags say what the light leaves out") {
    Light light = spotLight(vec3(1, 2, 3), vec3(0, 0, -1), 0.3f, 0.5f, vec3(1), 7);
    light.contribution = LightContribution::specularOnly;
    const auto constants = render::lightConstants(light, 0, 0);
    CHECK(constants.position == vec3(1, 2, 3));
    CHECK(constants.direction == vec3(0, 0, -1));
    CHECK(constants.flags == shared::kLightSpecular);
    CHECK((std::cos(0.5f) - constants.cosOuter) * constants.coneScale == doctest::Approx(0).epsilon(1e-5));
    CHECK((std::cos(0.3f) - constants.cosOuter) * constants.coneScale == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("light table: a packed light is the light, with the row of what it shares") {
    shared::LightConstants light = render::lightConstants(spotLight(vec3(1, 2, 3), vec3(0, 1, 0), 0.2f, 0.9f, vec3(4, 5, 6), 7), 123, 0);
    light.flags = 15;
    light.attenuation = 8, light.falloff = 9, light.linkGroup = 10, light.volume = 11;
    const shared::PackedLight packed = shared::packLight(light, (1u << 26) - 1);
    CHECK(shared::kindOf(packed) == (1u << 26) - 1);
    const shared::LightConstants back = shared::unpackLight(packed, {8, 9, 10, 11});
    CHECK(std::memcmp(&back, &light, sizeof(light)) == 0);
}

TEST_CASE("light table: lights that share what they can share a kind") {
    std::vector<Light> lights(1000, pointLight(vec3(0), vec3(1), 2));
    for (size_t i = 0; i < lights.size(); ++i) lights[i].linkGroup = i % 2 == 0 ? kNone : 3, lights[i].type = i % 3 == 0 ? LightType::spot : LightType::point;
    const render::SortedLights sorted = render::sortLights(lights, 0);
    CHECK(sorted.kinds.size() == 2);
    for (uint32_t i = 0; i < sorted.sources.size(); ++i) CHECK(sorted.at(i).linkGroup == lights[sorted.at(i).sceneIndex].linkGroup);
}

TEST_CASE("light table: first the lights without bounds, then those in balls, then those in meshes, each along a Morton curve") {
    std::vector<Light> lights{pointLight(vec3(0, 0, 0), vec3(1), 2), directionalLight(vec3(0, -1, 0)), pointLight(vec3(0), vec3(1), 2), pointLight(vec3(1))};
    lights[2].volume = 0;
    // Corners of a cube: x is the lowest bit, z the highest.
    for (uint32_t corner = 8; corner-- > 0;) lights.push_back(pointLight(vec3(corner & 1, corner >> 1 & 1, corner >> 2), vec3(1), 2));
    const render::SortedLights sorted = render::sortLights(lights, 0);
    CHECK(sorted.unbounded == 2);
    CHECK(sorted.shaped == 9);
    CHECK(sorted.meshes == 1);
    std::vector<uint32_t> order;
    for (const auto& light : sorted.sources) order.push_back(light.sceneIndex);
    // Of the two in one place the first comes first.
    CHECK(order == std::vector<uint32_t>{1, 3, 0, 11, 10, 9, 8, 7, 6, 5, 4, 2});
}

TEST_CASE("light table: 64 neighbours in it lie in a small part of space") {
    std::vector<Light> lights;
    for (uint32_t i = 0; i < 32768; ++i) lights.push_back(pointLight(vec3(i * 7919 % 32, i * 104729 / 32 % 32, i * 1299709 / 1024 % 32), vec3(1), 1));
    const render::SortedLights sorted = render::sortLights(lights, 0);
    double volume = 0;
    for (size_t first = 0; first < lights.size(); first += 64) {
        vec3 low(1e9f), high(-1e9f);
        for (size_t i = first; i < first + 64; ++i) low = min(low, sorted.sources[i].position), high = max(high, sorted.sources[i].position);
        volume += double((high.x - low.x + 1) * (high.y - low.y + 1) * (high.z - low.z + 1));
    }
    CHECK(volume / (double(lights.size()) / 64) < 2 * 64);  // cubes of 4 x 4 x 4, were there one light in each place
}

TEST_CASE("light table: placed lights come last of those in balls, and reach nothing yet") {
    std::vector<Light> lights(3, pointLight(vec3(0), vec3(1), 2));
    lights[0].volume = 0;
    render::SortedLights sorted = render::sortLights(lights, 0);
    CHECK(render::addPlacedLights(sorted, 5, 3, 4) == 2);
    CHECK(sorted.shaped == 6);
    CHECK(sorted.at(2).linkGroup == 5);
    CHECK(sorted.at(2).range == 0);
    CHECK(sorted.at(5).sceneIndex == 6);
    CHECK(sorted.at(6).volume == 0);
}

TEST_CASE("material table: colours above 1 are scaled into the target's range and back") {
    Scene scene;
    Material material = lambertMaterial(scene, vec3(0.5f, 2, 1));
    material.shaped.kd = 3;
    const auto tables = render::materialTables(material, 1);
    CHECK(tables.material.cs0Scale == 6);
    CHECK(tables.surface.cs0Factor.x * tables.material.cs0Scale == doctest::Approx(3));
}

TEST_CASE("material table: emission above 1 is split into a colour and Kemm") {
    const auto tables = render::materialTables({.emissive = vec3(2, 8, 4)}, 1);
    CHECK(tables.material.kEmissive == 8);
    CHECK(tables.surface.cs1 == vec3(0.25f, 1, 0.5f));
}

TEST_CASE("link table: bit i of a row is object ID i") {
    Scene scene = sceneOf(quad(), {});
    scene.objects[0].objectId = 40;
    scene.linkGroups = {{"a", std::vector<bool>(41, false)}, {"b", {}}};
    scene.linkGroups[0].litObjects[40] = true;
    uint32_t words = 0;
    const auto table = render::linkTable(scene, words);
    CHECK(words == 2);
    CHECK(table == std::vector<uint32_t>{0, 1u << 8, 0, 0});
}
