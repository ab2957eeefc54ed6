#include <luciole/error.hpp>

#include "device.hpp"
#include "gpu/shaders.hpp"
#include "scene_building.hpp"
#include "scenes.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

/// The same lights in another order and elsewhere, also in the table.
std::vector<Light> moved(std::vector<Light> lights) {
    std::ranges::rotate(lights, lights.begin() + ptrdiff_t(lights.size() / 2));
    for (Light& light : lights) light.positionWorld *= vec3(-0.9f, 1.1f, -0.8f);
    return lights;
}

std::vector<Light> withMore(std::vector<Light> lights) {
    lights = moved(std::move(lights));
    lights.push_back(spotLight(vec3(0.2f, 1, 0.5f), vec3(0, -1, -0.2f), 0.2f, 0.7f, vec3(3, 2, 1), 4));
    lights.push_back(pointLight(vec3(-0.4f, 0.3f, 0.6f), vec3(1, 2, 3), 1.5f));
    return lights;
}

/// What each frame graph that knows something of the lights is built from.
std::vector<RenderSettings> allSettings() {
    std::vector<RenderSettings> all;
    for (const auto& technique : render::techniques()) all.push_back({.lighting = std::string(technique.info.name)});
    const RenderSettings indexed{.lighting = "light-indexed", .overlap = 2, .onOverflow = OnOverflow::priority};
    const auto add = [&](auto change) {
        all.push_back(indexed);
        change(all.back());
    };
    add([](RenderSettings&) {});
    add([](RenderSettings& s) { s.indices = LidrIndices::n15; });
    add([](RenderSettings& s) { s.onOverflow = OnOverflow::exact, s.lidrTypes = LidrTypes::one; });
    add([](RenderSettings& s) { s.onOverflow = OnOverflow::exact, s.overlap = 8, s.lidrTypes = LidrTypes::targets; });
    add([](RenderSettings& s) { s.onOverflow = OnOverflow::exact, s.overlap = 16, s.lidrTables = LidrTables::textures; });
    for (const auto cover : {LidrCover::surface, LidrCover::frontFaces})
        add([&](RenderSettings& s) { s.lidrPacking = LidrPacking::cpuSort, s.onOverflow = OnOverflow::exact, s.lidrCover = cover; });
    return all;
}

}  // namespace

TEST_CASE("moving lights: set anew they give the picture of a scene that had them from the start, by every technique") {
    for (TestScene& test : testScenes()) {
        if (test.name != "studio" && test.name != "bounded lights" && test.name != "glass") continue;  // the others' lights are simpler
        INFO("scene: " << test.name);
        ValidatedRenderer renderer, fresh;
        const View view{test.view.camera, {40, 30}};
        const std::vector<Light> first = test.scene.lights;
        for (const RenderSettings& settings : allSettings()) {
            INFO("technique: " << settings.lighting << " " << getSetting(settings, "lidr-packing") << " " << getSetting(settings, "lidr-types"));
            test.scene.lights = first;
            renderer->setScene(test.scene);
            renderer->render(view, settings);
            for (const auto& change : {moved, withMore}) {
                test.scene.lights = change(test.scene.lights);
                renderer->setLights(test.scene.lights);
                const Frame frame = renderer->render(view, settings);
                CHECK(frame.stats.lights == test.scene.lights.size());
                CHECK(frame.radiance.data == fresh.render(test.scene, view, settings).radiance.data);
            }
        }
    }
}

TEST_CASE("moving lights: one that bounces takes its bounce along, and one that can't any more is refused") {
    ValidatedRenderer renderer, fresh;
    TestScene test = studio();
    const View view{test.view.camera, {40, 30}};
    const RenderSettings settings{.lighting = "volume-instanced", .bounceLight = "3", .bounceGrid = 8};
    renderer->setScene(test.scene);
    const Frame before = renderer->render(view, settings);
    test.scene.lights[3].positionWorld += vec3(0.3f, 0, 0.2f);
    test.scene.lights[3].outerConeAngle *= 0.9f;
    renderer->setLights(test.scene.lights);
    const Frame after = renderer->render(view, settings);
    CHECK(after.radiance.data != before.radiance.data);
    CHECK(after.radiance.data == fresh.render(test.scene, view, settings).radiance.data);
    CHECK(renderer->render(view, {}).radiance.data == fresh->render(view, {}).radiance.data);
    renderer->render(view, settings);
    test.scene.lights[3].type = LightType::point;
    renderer->setLights(test.scene.lights);
    CHECK_THROWS_WITH_AS(renderer->render(view, settings), doctest::Contains("a point light"), Error);
    CHECK(renderer->render(view, {}).radiance.data == fresh.render(test.scene, view, {}).radiance.data);
}

TEST_CASE("moving lights: those that break a rule are refused with the scene's words, and the old ones stay") {
    ValidatedRenderer renderer;
    TestScene test = studio();
    const View view{test.view.camera, {20, 15}};
    renderer->setScene(test.scene);
    const Frame before = renderer->render(view, {});
    const auto refused = [&](const char* why, auto change) {
        test.scene.lights = studio().scene.lights;
        change(test.scene.lights[1]);
        CHECK_THROWS_WITH_AS(renderer->setLights(test.scene.lights), doctest::Contains(why), Error);
        std::string whole;
        try {
            validate(test.scene);
        } catch (const Error& error) {
            whole = error.what();
        }
        CHECK_THROWS_WITH_AS(renderer->setLights(test.scene.lights), whole.c_str(), Error);
        CHECK(renderer->render(view, {}).radiance.data == before.radiance.data);
    };
    refused("range: expected > 0, got -1", [](Light& light) { light.range = -1; });
    refused("linkGroup: expected an index below", [](Light& light) { light.linkGroup = 999; });
    refused("volume: expected an index below", [](Light& light) { light.volume = 999; });
    refused("falloff: expected an index below", [](Light& light) { light.falloff = 999; });
    refused("attenuation: expected a function that is 0 at 1", [&](Light& light) {
        light = pointLight(vec3(0), vec3(1), 2);
        const auto constant = std::ranges::find_if(test.scene.functions, [](const Function& f) { return evaluate(f, 1, 0).x != 0; });
        REQUIRE(constant != test.scene.functions.end());
        light.attenuation = uint32_t(constant - test.scene.functions.begin());
    });
}

TEST_CASE("moving lights: a frame graph stays as long as the lights come in the same numbers and use the same") {
    SilentValidation validation;
    const gpu::Context context(validation.options());
    const gpu::Pipelines pipelines(context, gpu::shaderCode);
    Scene scene;
    scene.linkGroups = {{"all", {true}, {}}};
    scene.lightVolumes = {prism(kAngle, mat4(1))};
    for (int i = 0; i < 5; ++i) scene.lights.push_back(pointLight(vec3(float(i), 0, 0), vec3(1), 2));
    render::GpuScene gpuScene(context, pipelines, scene);
    const auto changes = [&](auto change) {
        change(scene.lights);
        return gpuScene.setLights(scene.lights);
    };
    using Lights = std::vector<Light>;
    CHECK_FALSE(changes([](Lights& lights) { lights = moved(lights); }));
    CHECK_FALSE(changes([](Lights& lights) { lights[2].color = vec3(7), lights[2].range = 5; }));
    CHECK(changes([](Lights& lights) { lights.push_back(lights.front()); }));
    CHECK(changes([](Lights& lights) { lights.front().linkGroup = 0; }));
    CHECK_FALSE(changes([](Lights& lights) { lights.back().linkGroup = 0; }));
    CHECK(changes([](Lights& lights) { lights.front().range = INFINITY; }));
    CHECK(changes([](Lights& lights) { lights.front().volume = 0; }));
    CHECK(changes([](Lights& lights) { lights = moved(lights); }));  // draws count the triangles of their lights' meshes
    CHECK(changes([](Lights& lights) { lights.assign(shared::kUniformLights + 1, pointLight(vec3(0), vec3(1), 2)); }));  // other memory
    CHECK(gpuScene.lightCount() == shared::kUniformLights + 1);
}
