#include <luciole/error.hpp>

#include "device.hpp"
#include "scene_building.hpp"
#include "scenes.hpp"

using namespace luciole;
using namespace luciole::test;

TEST_CASE("moving objects: moved anew they give the picture of a scene that had them there from the start, by every technique") {
    for (TestScene& test : testScenes()) {
        if (test.name != "glass" && test.name != "studio") continue;
        INFO("scene: " << test.name);
        ValidatedRenderer renderer, fresh;
        const View view{test.view.camera, {40, 30}};
        renderer->setScene(test.scene);
        std::vector<MovedObject> moved;
        for (uint32_t i = 0; i < test.scene.objects.size(); i += 2) {
            mat4& place = test.scene.objects[i].worldFromObject;
            place = glm::translate(mat4(1), vec3(0.1f * float(i % 3), 0.05f, -0.1f)) * place;
            moved.push_back({i, place});
        }
        for (const auto& technique : render::techniques()) {
            INFO("technique: " << technique.info.name);
            const RenderSettings settings{.lighting = std::string(technique.info.name)};
            renderer->render(view, settings);
        }
        renderer->moveObjects(moved);
        for (const auto& technique : render::techniques()) {
            INFO("technique: " << technique.info.name);
            const RenderSettings settings{.lighting = std::string(technique.info.name)};
            CHECK(renderer->render(view, settings).radiance.data == fresh.render(test.scene, view, settings).radiance.data);
        }
    }
}

TEST_CASE("moving objects: what can't be is refused, and nothing has moved then") {
    ValidatedRenderer renderer;
    Scene scene;
    addObject(scene, quad(), lambertMaterial(scene));
    addObject(scene, quad(), lambertMaterial(scene), mat4(0));
    scene.lights = {pointLight(vec3(0, 0, 1))};
    const View view{frontCamera(), {8, 8}};
    const Frame before = renderer.render(scene, view, {});
    const mat4 aside = glm::translate(mat4(1), vec3(1, 0, 0));
    const auto refusal = [&](uint32_t object, const mat4& place) {
        const MovedObject moved[] = {{0, aside}, {object, place}};
        try {
            renderer->moveObjects(moved);
        } catch (const Error& error) {
            CHECK(error.kind() == ErrorKind::scene);
            CHECK(renderer->render(view, {}).radiance.data == before.radiance.data);
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    CHECK(refusal(2, mat4(1)) == "moved objects: expected indices below 2, got 2");
    CHECK(refusal(0, mat4(NAN)) == "objects[0]: worldFromObject: expected finite numbers");
    CHECK(refusal(0, mat4(0)) == "objects[0]: worldFromObject: expected a matrix that is not singular");
    CHECK(refusal(0, glm::scale(mat4(1), vec3(-1, 1, 1))) == "objects[0]: worldFromObject: expected a determinant of the same sign as before");
    CHECK(refusal(1, mat4(1)) == "objects[1]: worldFromObject: expected an object that was drawn; it had a singular matrix when the scene was set");
    const MovedObject moved{0, aside};
    renderer->moveObjects(std::span(&moved, 1));
    CHECK(renderer->render(view, {}).radiance.data != before.radiance.data);
}
