#include <luciole/scene_io.hpp>

#include "device.hpp"
#include "render/lighting/techniques.hpp"
#include "scenes.hpp"

using namespace luciole;
using namespace luciole::test;

TEST_CASE("ideal: evaluates the lights that reach the pixel and no others, and shows what brute force shows") {
    ValidatedRenderer renderer;
    const std::vector<std::string> counts{"evaluations", "useful-evaluations", "light-count", "light-fingerprint"};
    for (const char* uri : {"builtin:hall?lights=255&overlap=4&triangles=9000", "builtin:hall?lights=1024&overlap=16&triangles=9000"}) {
        CAPTURE(uri);
        const Scene scene = loadScene(uri);
        const View view{scene.cameras.at(0), {160, 121}};
        renderer->setScene(scene);
        const Frame brute = renderer->render(view, {.lighting = "brute-force"}, counts);
        const Frame ideal = renderer->render(view, {.lighting = "ideal"}, counts);
        CHECK(ideal.aovs.at("evaluations").data == ideal.aovs.at("useful-evaluations").data);
        CHECK(ideal.aovs.at("evaluations").data == brute.aovs.at("light-count").data);
        CHECK(ideal.aovs.at("light-fingerprint").data == brute.aovs.at("light-fingerprint").data);
        const std::vector<bool> all(ideal.radiance.data.size() / 3, true);
        checkAlike(render::idealTechnique(), ideal.radiance, brute.radiance, all, scene.lights.size());
    }
}

TEST_CASE("ideal: linked lights and surfaces that blend are lit as brute force lights them") {
    ValidatedRenderer renderer;
    TestScene test = studio();
    test.scene.materials[0].alphaMode = AlphaMode::blend;
    test.scene.materials[0].baseColor.a = 0.5f;
    renderer->setScene(test.scene);
    const Frame brute = renderer->render(test.view, {.lighting = "brute-force"});
    const Frame ideal = renderer->render(test.view, {.lighting = "ideal"});
    const std::vector<bool> all(ideal.radiance.data.size() / 3, true);
    checkAlike(render::idealTechnique(), ideal.radiance, brute.radiance, all, test.scene.lights.size());
}

TEST_CASE("ideal: is for benchmarks alone, so that no list of techniques has it") {
    for (const auto& technique : render::techniques()) CHECK(technique.info.name != "ideal");
    for (const auto& technique : lightingTechniques()) CHECK(technique.name != "ideal");
}
