#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>

#include "scene/rig_values.hpp"
#include "support.hpp"

using namespace luciole;
using doctest::Approx;
using Json = nlohmann::json;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Three objects with one mesh, two materials, two lights and a camera.
Scene plainScene() {
    Scene scene;
    scene.meshes = {{.name = "triangle", .vertices = std::vector<Vertex>(3), .indices = {0, 1, 2}}};
    scene.meshes[0].vertices[1].position = {4, 0, 0};
    scene.meshes[0].vertices[2].position = {0, 2, -6};
    scene.objects = {{.name = "curtain left", .objectId = 0},
                     {.name = "curtain right", .objectId = 1},
                     {.name = "floor", .material = 1, .objectId = 2}};
    scene.materials = {{.name = "red cloth"}, {.name = "stone"}};
    scene.texels = {{.name = "dot", .width = 1, .height = 1, .rgba = {1, 2, 3, 4}}};
    scene.textures = {{}};
    scene.materials[1].baseColorTexture.texture = 0;
    scene.lights = {{.name = "lamp 1", .color = {2, 4, 1}}, {.name = "sun", .type = LightType::directional}};
    scene.cameras = {{.name = "door"}};
    return scene;
}

Scene rigged(const std::string& rig, Scene scene = plainScene()) {
    applyRigText(scene, rig, "test.json");
    return scene;
}

/// The message with which the rig is refused; the scene must be as before.
std::string refusal(const std::string& rig, ErrorKind kind = ErrorKind::scene) {
    Scene scene = plainScene();
    try {
        applyRigText(scene, rig, "test.json", LoadLimits{.maxJsonDepth = 32, .maxElements = 1000});
    } catch (const Error& error) {
        CHECK(error.kind() == kind);
        const Scene before = plainScene();
        CHECK(scene.lights.size() == before.lights.size());
        CHECK(scene.functions.empty());
        CHECK(scene.meshes.size() == 1);
        CHECK(scene.texels.size() == 1);
        CHECK(scene.textures.size() == 1);
        CHECK(scene.materials.size() == 2);
        CHECK(scene.lights[0].color == before.lights[0].color);
        return error.what();
    }
    FAIL_CHECK("accepted: " << rig);
    return {};
}

void checkColor(vec3 color, vec3 expected) {
    for (int i = 0; i < 3; ++i) CHECK(color[i] == Approx(expected[i]).epsilon(1e-6));  // float rounding
}

/// A rig that has every section and every key.
const std::string kFullRig = R"({
  "$schema": "rig.schema.json", "description": "everything",
  "functions": [{"name": "half", "kind": "wrap", "parameter": 0.5},
                {"name": "curve", "kind": "sampled", "samples": [[0, 0], [0.25, 1], [1, 1]]}],
  "objects": [{"match": "curtain*", "objectId": 7}],
  "linkGroups": [{"name": "cloth", "include": "curtain*", "exclude": ["floor"]}],
  "materials": [
    {"match": "red*", "equation": "shaped", "diffuseFunction": "half", "specularFunction": {"kind": "toon", "parameter": 2},
     "kd": 0.5, "ks": 0.25, "specularColor": [1, 0.5, 0], "specularBlend": 0.75, "kAmbient": [0.1, 0.2, 0.3], "kEmissive": 2},
    {"name": "tiles", "copyOf": "stone", "assignTo": "floor", "surface": "checker", "proceduralColor": "#000000",
     "proceduralScale": 3, "baseColor": [1, 0.5, 0.25, 0.5], "metallic": 0.5, "roughness": 0.25, "emissive": [2, 0, 0],
     "normalScale": 2, "occlusionStrength": 0.5, "doubleSided": true, "alphaMode": "mask", "alphaCutoff": 0.25}],
  "lights": [
    {"name": "key", "type": "spot", "position": [1, 2, 3], "target": [1, 0, 3], "color": [1, 0.5, 0.25], "intensity": 8,
     "range": 5, "innerConeAngle": 30, "outerConeAngle": 60, "attenuation": "linear", "falloff": "lambert",
     "contribution": "specularOnly", "linkGroup": "cloth"},
    {"name": "moon", "type": "directional", "direction": [0, -2, 0], "infiniteViewer": true},
    {"name": "spark", "type": "point", "scatter": {"count": 4, "seed": 9, "box": "bounds", "jitter": 0.5, "hue": [30, 60],
     "saturation": 0.5, "intensity": [1, 2], "range": [3, 4]}},
    {"match": "lamp*", "intensityScale": 0.5}, {"remove": "sun"}],
  "ambience": {"sky": [0.1, 0.2, 0.3], "ground": [0, 0, 0], "up": [0, 3, 0]},
  "cameras": [{"name": "nave", "eye": [0, 1, 5], "target": [0, 1, 0], "fov": 60, "near": 0.5},
              {"name": "plan", "matrix": [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 9, 0, 1], "orthographic": 6, "near": 0, "far": 20}],
  "exposure": -1.5
})";

}  // namespace

TEST_CASE("rig patterns: a star is any text, a question mark one character, a backslash takes the next as it is") {
    using rig::matches;
    CHECK(matches("lamp", "lamp"));
    CHECK_FALSE(matches("lamp", "lamps"));
    CHECK_FALSE(matches("lamp", "Lamp"));
    CHECK(matches("*", ""));
    CHECK(matches("", ""));
    CHECK_FALSE(matches("?", ""));
    CHECK(matches("*lamp*", "the lamp there"));
    CHECK(matches("a*b*c", "a-b-b-c"));
    CHECK_FALSE(matches("a*b*c", "a-b-b-d"));
    CHECK(matches("l?mp", "l\xC3\xA4mp"));  // an umlaut is two bytes, one character
    CHECK(matches("*?p", "l\xC3\xA4mp"));
    CHECK(matches("a\\*", "a*"));
    CHECK_FALSE(matches("a\\*", "ab"));
    CHECK(matches("a\\?\\\\", "a?\\"));
    CHECK(matches("a\\", "a\\"));
    // Quadratic at worst: with exponential backtracking this would not end.
    CHECK_FALSE(matches("*a*a*a*a*a*a*a*a*a*a*b", std::string(5000, 'a')));
}

TEST_CASE("rig: an empty rig changes nothing") {
    const Scene scene = rigged("{}");
    CHECK(scene.lights.size() == 2);
    CHECK(scene.meshes.size() == 1);
    CHECK(scene.texels.size() == 1);
}

TEST_CASE("rig: every key of a spot, a directional and scattered lights arrives") {
    const Scene scene = rigged(kFullRig);
    REQUIRE(scene.lights.size() == 7);
    CHECK(scene.lights[0].name == "lamp 1");
    CHECK(scene.lights[0].color == vec3(1, 2, 0.5f));

    const Light& key = scene.lights[1];
    CHECK(key.name == "key");
    CHECK(key.type == LightType::spot);
    CHECK(key.positionWorld == vec3(1, 2, 3));
    CHECK(key.directionWorld == vec3(0, -1, 0));
    CHECK(key.color == vec3(8, 4, 2));
    CHECK(key.range == 5);
    CHECK(key.innerConeAngle == Approx(kPi / 6));
    CHECK(key.outerConeAngle == Approx(kPi / 3));
    CHECK(scene.functions[key.attenuation].name == "linear");
    CHECK(scene.functions[key.falloff].kind == Function::Kind::lambert);
    CHECK(key.contribution == LightContribution::specularOnly);
    CHECK(scene.linkGroups[key.linkGroup].name == "cloth");

    CHECK(scene.lights[2].directionWorld == vec3(0, -1, 0));
    CHECK(scene.lights[2].infiniteViewer);
    CHECK(scene.lights[2].color == vec3(1));

    for (size_t i = 3; i < 7; ++i) {
        const Light& spark = scene.lights[i];
        CHECK(spark.name == fmt::format("spark {}", i - 3));
        CHECK(spark.positionWorld.x >= -0.5f);
        CHECK(spark.positionWorld.x <= 4.5f);
        CHECK(spark.positionWorld.z >= -6.5f);
        CHECK(spark.positionWorld.z <= 0.5f);
        CHECK(spark.range >= 3);
        CHECK(spark.range <= 4);
        CHECK(spark.color.r >= 1);  // hues of 30 to 60 degrees: red is the largest channel
        CHECK(spark.color.r <= 2);
        CHECK(spark.color.b == Approx(0.5 * double(spark.color.r)).epsilon(1e-6));  // saturation
        CHECK(spark.color.g >= 0.749f * spark.color.r);
    }
}

TEST_CASE("rig: every key of a changed and a new material arrives") {
    const Scene scene = rigged(kFullRig);
    REQUIRE(scene.materials.size() == 3);
    const Material& cloth = scene.materials[0];
    CHECK(cloth.equation == LightEquation::shaped);
    CHECK(scene.functions[cloth.shaped.diffuseFunction].name == "half");
    CHECK(scene.functions[cloth.shaped.specularFunction].kind == Function::Kind::toon);
    CHECK(scene.functions[cloth.shaped.specularFunction].parameter == 2);
    CHECK(cloth.shaped.kd == 0.5f);
    CHECK(cloth.shaped.ks == 0.25f);
    CHECK(cloth.shaped.specularColor == vec3(1, 0.5f, 0));
    CHECK(cloth.shaped.specularBlend == 0.75f);
    CHECK(cloth.shaped.kAmbient == vec3(0.1f, 0.2f, 0.3f));
    CHECK(cloth.shaped.kEmissive == 2);

    const Material& tiles = scene.materials[2];
    CHECK(tiles.name == "tiles");
    CHECK(tiles.baseColorTexture.texture == 0);  // from the copied stone
    CHECK(tiles.surface == SurfaceShader::checker);
    CHECK(tiles.proceduralScale == 3);
    CHECK(tiles.baseColor == vec4(1, 0.5f, 0.25f, 0.5f));
    CHECK(tiles.metallic == 0.5f);
    CHECK(tiles.roughness == 0.25f);
    CHECK(tiles.emissive == vec3(2, 0, 0));
    CHECK(tiles.normalScale == 2);
    CHECK(tiles.occlusionStrength == 0.5f);
    CHECK(tiles.doubleSided);
    CHECK(tiles.alphaMode == AlphaMode::mask);
    CHECK(tiles.alphaCutoff == 0.25f);
    CHECK(scene.objects[0].material == 0);
    CHECK(scene.objects[2].material == 2);
}

TEST_CASE("rig: functions, object IDs, link groups, ambience, cameras and exposure arrive") {
    const Scene scene = rigged(kFullRig);
    CHECK(scene.functions[0].kind == Function::Kind::wrap);
    CHECK(scene.functions[0].parameter == 0.5f);
    CHECK(scene.functions[1].samples == std::vector<vec2>{{0, 0}, {0.25f, 1}, {1, 1}});
    CHECK(scene.objects[0].objectId == 7);
    CHECK(scene.objects[1].objectId == 7);
    CHECK(scene.objects[2].objectId == 2);
    REQUIRE(scene.linkGroups.size() == 1);
    CHECK(scene.linkGroups[0].litObjects == std::vector<bool>{false, false, false, false, false, false, false, true});
    CHECK(scene.ambience.sky == vec3(0.1f, 0.2f, 0.3f));
    CHECK(scene.ambience.ground == vec3(0));
    CHECK(scene.ambience.upWorld == vec3(0, 1, 0));
    REQUIRE(scene.cameras.size() == 3);
    CHECK(scene.cameras[0].name == "nave");
    CHECK(scene.cameras[0].worldFromView == lookAt({0, 1, 5}, {0, 1, 0}));
    CHECK(scene.cameras[0].yFov == Approx(kPi / 3));
    CHECK(scene.cameras[0].zNear == 0.5f);
    CHECK(scene.cameras[1].name == "plan");
    CHECK(scene.cameras[1].orthographic);
    CHECK(scene.cameras[1].halfHeight == 3);
    CHECK(scene.cameras[1].zNear == 0);
    CHECK(scene.cameras[1].zFar == 20);
    CHECK(scene.cameras[1].worldFromView[2] == vec4(0, 1, 0, 0));
    CHECK(scene.cameras[2].name == "door");
    CHECK(scene.exposureEv == -1.5f);
}

TEST_CASE("rig: a colour is linear numbers or sRGB digits") {
    // IEC 61966-2-1: 0x80 is 0.2158605 linear, 0x0A (below the knee) 10 / 255 / 12.92.
    const Scene scene = rigged(R"({"ambience": {"sky": "#80FF0a", "ground": [3, 0.5, 0]}})");
    checkColor(scene.ambience.sky, vec3(0.2158605f, 1, 0.00303527f));
    CHECK(scene.ambience.ground == vec3(3, 0.5f, 0));
    const Scene plain = rigged(R"({"ambience": {"ambient": [0.5, 0.25, 1]}})");
    CHECK(plain.ambience.sky == vec3(0.5f, 0.25f, 1));
    CHECK(plain.ambience.ground == vec3(0.5f, 0.25f, 1));
}

TEST_CASE("rig: changing colour keeps the intensity, changing intensity keeps the colour") {
    const auto lamp = [](const std::string& fields) {
        return rigged(R"({"lights": [{"match": "lamp ?", )" + fields + "}]}").lights[0].color;  // was (2, 4, 1)
    };
    CHECK(lamp(R"("intensity": 8)") == vec3(4, 8, 2));
    CHECK(lamp(R"("color": [1, 0.5, 0.5])") == vec3(4, 2, 2));
    CHECK(lamp(R"("color": [1, 0.5, 0.5], "intensity": 6)") == vec3(6, 3, 3));
    CHECK(lamp(R"("intensityScale": 2)") == vec3(4, 8, 2));
    CHECK(lamp(R"("intensity": 0)") == vec3(0));
}

TEST_CASE("rig: null brings back what glTF does") {
    Scene scene = rigged(kFullRig);
    scene = rigged(
        R"({"lights": [{"match": "key", "attenuation": null, "falloff": null, "range": null, "linkGroup": null}]})",
        scene);
    CHECK(scene.lights[1].attenuation == kNone);
    CHECK(scene.lights[1].falloff == kNone);
    CHECK(scene.lights[1].range == kInfinity);
    CHECK(scene.lights[1].linkGroup == kNone);
}

TEST_CASE("rig: built-in functions need no declaration and join the scene once") {
    const Scene scene = rigged(R"({"materials": [
        {"match": "*", "equation": "shaped", "diffuseFunction": "lambert", "specularFunction": {"kind": "blinnPhong", "parameter": 8}},
        {"name": "new", "equation": "shaped", "diffuseFunction": "orenNayar", "specularFunction": {"kind": "blinnPhong", "parameter": 8}}]})");
    REQUIRE(scene.functions.size() == 3);
    CHECK(scene.functions[0].kind == Function::Kind::lambert);
    CHECK(scene.functions[1].name == "blinnPhong(8)");
    CHECK(scene.functions[2].kind == Function::Kind::orenNayar);
    CHECK(scene.materials[2].shaped.specularFunction == scene.materials[0].shaped.specularFunction);
}

TEST_CASE("rig: the fades of attenuation go from 1 at the light to 0 at its range") {
    const Scene scene = rigged(R"({"lights": [
        {"type": "point", "position": [0, 0, 0], "range": 2, "attenuation": "linear"},
        {"type": "point", "position": [0, 0, 0], "range": 2, "attenuation": "smooth"}]})");
    const Function& linear = scene.functions[scene.lights[2].attenuation];
    const Function& smooth = scene.functions[scene.lights[3].attenuation];
    for (const double x : {0.0, 0.1, 0.25, 0.5, 0.77, 1.0}) {
        CHECK(evaluate(linear, x, 0).x == Approx(1 - x).epsilon(1e-12));
        CHECK(evaluate(smooth, x, 0).x == Approx(1 - x * x * (3 - 2 * x)).epsilon(3e-4));  // chords, see smoothFade
    }
}

TEST_CASE("rig: a material that becomes shaped is Lambert with a Blinn-Phong highlight of exponent 32") {
    const Scene scene = rigged(R"({"materials": [{"match": "stone", "equation": "shaped"}]})");
    const ShapedParameters& shaped = scene.materials[1].shaped;
    CHECK(scene.functions[shaped.diffuseFunction].kind == Function::Kind::lambert);
    CHECK(scene.functions[shaped.specularFunction].kind == Function::Kind::blinnPhong);
    CHECK(scene.functions[shaped.specularFunction].parameter == 32);
    CHECK(scene.materials[1].baseColorTexture.texture == 0);
    // A second rig that changes it further keeps what it has.
    const Scene again =
        rigged(R"({"materials": [{"match": "stone", "equation": "shaped", "ks": 0.5, "kAmbient": 0.25}]})",
               rigged(R"({"materials": [{"match": "stone", "equation": "shaped", "kd": 0.25}]})"));
    CHECK(again.materials[1].shaped.kd == 0.25f);
    CHECK(again.materials[1].shaped.ks == 0.5f);
    CHECK(again.materials[1].shaped.kAmbient == vec3(0.25f));
}

TEST_CASE("rig: one channel of samples cascades where the shape is above zero") {
    const Scene scene = rigged(R"({"functions": [{"name": "f", "kind": "sampled", "samples": [0, 0, 0.5, 1]}]})");
    CHECK(scene.functions[0].samples == std::vector<vec2>{{0, 0}, {0, 0}, {0.5f, 1}, {1, 1}});
}

TEST_CASE("rig: later rigs replace functions, groups, materials and cameras of the same name in place") {
    Scene scene = rigged(kFullRig);
    const uint32_t function = scene.materials[0].shaped.diffuseFunction;
    scene = rigged(R"({"functions": [{"name": "half", "kind": "constant", "parameter": 3}],
        "linkGroups": [{"name": "cloth", "include": "floor"}],
        "materials": [{"name": "tiles", "baseColor": "#ffffff"}],
        "cameras": [{"name": "door", "fov": 20}]})",
                   scene);
    CHECK(scene.materials[0].shaped.diffuseFunction == function);
    CHECK(scene.functions[function].kind == Function::Kind::constant);
    REQUIRE(scene.linkGroups.size() == 1);
    CHECK(scene.linkGroups[0].litObjects == std::vector<bool>{false, false, true, false, false, false, false, false});
    REQUIRE(scene.materials.size() == 3);
    CHECK(scene.materials[2].surface == SurfaceShader::textured);
    CHECK(scene.objects[2].material == 2);
    REQUIRE(scene.cameras.size() == 3);
    CHECK(scene.cameras[2].yFov == Approx(kPi / 9));
}

TEST_CASE("rig: a group whose objects share IDs with others says so") {
    const Scene scene = rigged(R"({"objects": [{"match": ["curtain left", "floor"], "objectId": 4}],
                                   "linkGroups": [{"name": "cloth", "exclude": "floor"}]})");
    REQUIRE(scene.warnings.size() == 1);
    CHECK(scene.warnings[0] == "link group \"cloth\": touches object \"floor\" too, which shares its ID 4");
}

TEST_CASE("rig: scattered lights are the same for the same seed and others for another") {
    const auto positions = [](int seed) {
        return rigged(fmt::format(R"({{"lights": [{{"remove": "*"}}, {{"type": "point", "scatter":
            {{"count": 50, "seed": {}, "box": {{"low": [-1, 2, 3], "high": [1, 4, 9]}}, "colors": ["#ff0000", [0, 0, 1]]}}}}]}})",
                                  seed))
            .lights;
    };
    const std::vector<Light> first = positions(1), second = positions(1), other = positions(2);
    REQUIRE(first.size() == 50);
    bool same = true, differs = false;
    size_t red = 0;
    vec3 mean(0);
    for (size_t i = 0; i < first.size(); ++i) {
        same = same && first[i].positionWorld == second[i].positionWorld && first[i].color == second[i].color;
        differs = differs || first[i].positionWorld != other[i].positionWorld;
        CHECK(glm::all(glm::greaterThanEqual(first[i].positionWorld, vec3(-1, 2, 3))));
        CHECK(glm::all(glm::lessThan(first[i].positionWorld, vec3(1, 4, 9))));
        CHECK((first[i].color == vec3(1, 0, 0) || first[i].color == vec3(0, 0, 1)));
        red += first[i].color.r > 0;
        mean += first[i].positionWorld / 50.0f;
    }
    CHECK(same);
    CHECK(differs);
    // Fixed seed, so no flake: three sigma of 50 draws.
    CHECK(std::abs(int(red) - 25) <= 11);
    CHECK(mean.x == Approx(0).epsilon(0.25));
    CHECK(mean.z == Approx(6).epsilon(0.13));
}

TEST_CASE("rig: lights on a line are evenly spaced and can all aim at one place") {
    const Scene scene = rigged(R"({"lights": [{"remove": "*"}, {"name": "row", "type": "spot", "target": [1, 0, 0],
        "scatter": {"count": 3, "line": {"from": [0, 2, 0], "to": [2, 2, 0]}}}]})");
    REQUIRE(scene.lights.size() == 3);
    CHECK(scene.lights[0].positionWorld == vec3(0, 2, 0));
    CHECK(scene.lights[1].positionWorld == vec3(1, 2, 0));
    CHECK(scene.lights[2].positionWorld == vec3(2, 2, 0));
    CHECK(scene.lights[1].directionWorld == vec3(0, -1, 0));
    CHECK(scene.lights[0].directionWorld.x == Approx(1 / std::sqrt(5.0)));
    CHECK(scene.lights[2].name == "row 2");
    const Scene one = rigged(
        R"({"lights": [{"type": "point", "scatter": {"count": 1, "line": {"from": [0, 2, 0], "to": [2, 2, 0]}}}]})");
    CHECK(one.lights[2].positionWorld == vec3(1, 2, 0));
}

TEST_CASE("rig: every fault is refused with its path, and the scene stays as it was") {
    struct Fault {
        const char* rig;
        const char* message;  ///< start
    };
    const Fault faults[] = {
        {"", "test.json: parse error at line 1, column 1"},
        {"{\n \"lights\": [}", "test.json: parse error at line 2, column 13"},
        {"[]", "test.json: /: expected an object, got an array of 0"},
        {R"({"lihgts": []})", "test.json: /lihgts: unknown key; expected one of $schema, "},
        {R"({"exposure": 1, "exposure": 2})", "test.json: key \"exposure\" is given twice in one object"},
        {R"({"exposure": "bright"})", "test.json: /exposure: expected a number that fits into 32 bits, got \"bright\""},
        {R"({"exposure": 1e39})", "test.json: /exposure: expected a number that fits into 32 bits, got 1e+39"},
        {R"({"$schema": 1})", "test.json: /$schema: expected a string, got 1"},
        {R"({"lights": {}})", "test.json: /lights: expected an array, got an object"},
        {R"({"lights": [{"name": "a"}]})", "test.json: /lights/0: expected a key \"type\", got none"},
        {R"({"lights": [{"type": "lamp"}]})",
         "test.json: /lights/0/type: expected one of directional, point, spot, got \"lamp\""},
        {R"({"lights": [{"type": "point"}]})", "test.json: /lights/0: expected a key \"position\", got none"},
        {R"({"lights": [{"type": "directional"}]})", "test.json: /lights/0: expected a key \"direction\", got none"},
        {R"({"lights": [{"type": "point", "position": [0, 1]}]})",
         "test.json: /lights/0/position: expected three numbers, got an array of 2"},
        {R"({"lights": [{"type": "point", "position": [0, 1, "x"]}]})",
         "test.json: /lights/0/position/2: expected a number that fits into 32 bits, got \"x\""},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "range": -1}]})",
         "test.json: /lights/0/range: expected a number > 0, got -1"},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "color": "red"}]})",
         "test.json: /lights/0/color: expected a colour as \"#rrggbb\" or [r, g, b], got \"red\""},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "color": "#12345g"}]})",
         "test.json: /lights/0/color: "},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "color": [1, -1, 1]}]})",
         "test.json: /lights/0/color/1: expected a number >= 0, got -1"},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "color": [9e37, 0, 0], "intensity": 9}]})",
         "test.json: /lights/0: expected color times intensity to fit into 32 bits"},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "attenuation": "linear"}]})",
         "test.json: /lights/0: expected a range"},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "range": 1, "attenuation": "curvy"}]})",
         "test.json: /lights/0/attenuation: expected a built-in function"},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "falloff": 3}]})",
         "test.json: /lights/0/falloff: expected a function's name"},
        {R"({"lights": [{"type": "point", "position": [0, 1, 2], "linkGroup": "cloth"}]})",
         "test.json: /lights/0/linkGroup: expected the name of a link group (none), got \"cloth\""},
        {R"({"lights": [{"type": "directional", "direction": [0, 0, 0]}]})",
         "test.json: /lights/0/direction: expected a direction other than zero"},
        {R"({"lights": [{"type": "directional", "direction": [0, 1, 0], "target": [0, 1, 0]}]})",
         "test.json: /lights/0/target: expected either a direction or a target, got both"},
        {R"({"lights": [{"type": "spot", "position": [0, 1, 0], "target": [0, 1, 0]}]})",
         "test.json: /lights/0/target: expected a place other than the light's position"},
        {R"({"lights": [{"type": "spot", "position": [0, 1, 0], "target": [0, 0, 0], "innerConeAngle": 50}]})",
         "test.json: /lights/0: expected innerConeAngle < outerConeAngle, got 50 and 45"},
        {R"({"lights": [{"type": "spot", "position": [0, 1, 0], "target": [0, 0, 0], "outerConeAngle": 190}]})",
         "test.json: /lights/0/outerConeAngle: expected a number in [0, 180], got 190"},
        {R"({"lights": [{"match": "lmp*", "intensity": 1}]})",
         "test.json: /lights/0/match: pattern \"lmp*\" matches no light; there are: \"lamp 1\", \"sun\""},
        {R"({"lights": [{"remove": ["sun", "moon"]}]})",
         "test.json: /lights/0/remove/1: pattern \"moon\" matches no light"},
        {R"({"lights": [{"remove": "sun", "color": [1, 1, 1]}]})", "test.json: /lights/0/color: unknown key"},
        {R"({"lights": [{"match": []}]})", "test.json: /lights/0/match: expected at least one pattern"},
        {R"({"lights": [{"match": 3}]})",
         "test.json: /lights/0/match: expected a pattern or an array of patterns, got 3"},
        {R"({"lights": [{"match": "*", "intensityScale": 1e38}, {"match": "*", "intensityScale": 1e38}]})",
         "test.json: lights[0] \"lamp 1\": color: expected finite numbers >= 0, got (inf"},
        {R"({"lights": [{"type": "point", "scatter": {"count": 0, "box": "bounds"}}]})",
         "test.json: /lights/0/scatter/count: expected a whole number in [1, "},
        {R"({"lights": [{"type": "point", "scatter": {"count": 2}}]})",
         "test.json: /lights/0/scatter: expected a key \"box\", got none"},
        {R"({"lights": [{"type": "point", "position": [0, 0, 0], "scatter": {"count": 2, "box": "bounds"}}]})",
         "test.json: /lights/0/position: a scattered light takes its position"},
        {R"({"lights": [{"type": "directional", "direction": [0, 0, 1], "scatter": {"count": 2, "box": "bounds"}}]})",
         "test.json: /lights/0/scatter: a directional light has no place to scatter"},
        {R"({"lights": [{"type": "point", "scatter": {"count": 2, "box": "bounds", "range": [3, 2]}}]})",
         "test.json: /lights/0/scatter/range: expected [low, high] with low <= high, got [3, 2]"},
        {R"({"lights": [{"type": "point", "scatter": {"count": 2, "box": "bounds", "colors": []}}]})",
         "test.json: /lights/0/scatter/colors: expected at least one colour"},
        {R"({"lights": [{"type": "point", "scatter": {"count": 2, "box": "bounds", "saturation": 1}}]})",
         "test.json: /lights/0/scatter/saturation: saturation needs a hue"},
        {R"({"functions": [{"kind": "lambert"}]})", "test.json: /functions/0: expected a key \"name\", got none"},
        {R"({"functions": [{"name": "f", "kind": "wrapped"}]})",
         "test.json: /functions/0/kind: expected one of lambert, "},
        {R"({"functions": [{"name": "f", "kind": "wrap", "parameter": 2}]})",
         "test.json: /functions/0/parameter: expected a number in [0, 1], got 2"},
        {R"({"functions": [{"name": "f", "kind": "toon", "parameter": 1.5}]})",
         "test.json: /functions/0/parameter: expected a whole number in [1, 65536], got 1.5"},
        {R"({"functions": [{"name": "f", "kind": "lambert", "parameter": 1}]})",
         "test.json: /functions/0/parameter: lambert has no parameter"},
        {R"({"functions": [{"name": "f", "kind": "lambert", "samples": [0, 1]}]})",
         "test.json: /functions/0/samples: only a sampled function has samples"},
        {R"({"functions": [{"name": "f", "kind": "sampled", "samples": [1]}]})",
         "test.json: /functions/0/samples: expected at least 2 samples"},
        {R"({"functions": [{"name": "f", "kind": "sampled", "samples": [1, [1, 1]]}]})",
         "test.json: /functions/0/samples/1: expected a number, as the first sample, got an array of 2"},
        {R"({"functions": [{"name": "f", "kind": "sampled", "samples": [[1, 1], [1]]}]})",
         "test.json: /functions/0/samples/1: expected [shape, cascade], as the first sample"},
        {R"({"functions": [{"name": "f", "kind": "sampled", "samples": [1, 1], "parameter": 1}]})",
         "test.json: /functions/0/parameter: a sampled function has no parameter"},
        {R"({"objects": [{"match": "floor", "objectId": 65536}]})",
         "test.json: /objects/0/objectId: expected a whole number in [0, 65535], got 65536"},
        {R"({"linkGroups": [{"name": "g", "include": "wall*"}]})",
         "test.json: /linkGroups/0/include: pattern \"wall*\" matches no object; there are: \"curtain left\", "},
        {R"({"materials": [{"baseColor": [1, 1, 1]}]})", "test.json: /materials/0: expected a key \"name\", got none"},
        {R"({"materials": [{"match": "stone", "assignTo": "floor"}]})",
         "test.json: /materials/0/assignTo: unknown key"},
        {R"({"materials": [{"match": "stone", "kd": 1}]})",
         "test.json: /materials/0/kd: only for the equation \"shaped\", which material \"stone\" does not have"},
        {R"({"materials": [{"match": "stone", "baseColor": [1, 1, 1, 2]}]})",
         "test.json: /materials/0/baseColor/3: expected a number in [0, 1], got 2"},
        {R"({"materials": [{"name": "a", "copyOf": "brick"}]})",
         "test.json: /materials/0/copyOf: expected the name of a material (\"red cloth\", \"stone\"), got \"brick\""},
        {R"({"materials": [{"match": "stone", "doubleSided": 1}]})",
         "test.json: /materials/0/doubleSided: expected true or false, got 1"},
        {R"({"ambience": {"ambient": [1, 1, 1], "sky": [1, 1, 1]}})",
         "test.json: /ambience/sky: expected either ambient or sky and ground, got both"},
        {R"({"ambience": {"up": [0, 0, 0]}})", "test.json: /ambience/up: expected a direction other than zero"},
        {R"({"cameras": [{"name": "c"}]})", "test.json: /cameras/0: expected a key \"eye\", got none"},
        {R"({"cameras": [{"name": "c", "eye": [0, 0, 0]}]})",
         "test.json: /cameras/0: expected a key \"target\", got none"},
        {R"({"cameras": [{"name": "c", "eye": [1, 0, 0], "target": [1, 0, 0]}]})",
         "test.json: /cameras/0/target: expected a place other than the eye"},
        {R"({"cameras": [{"name": "door", "fov": 180}]})",
         "test.json: /cameras/0/fov: expected a number above 0 and below 180, got 180"},
        {R"({"cameras": [{"name": "door", "fov": 50, "orthographic": 2}]})",
         "test.json: /cameras/0/orthographic: expected either fov or orthographic, got both"},
        {R"({"cameras": [{"name": "door", "near": 0}]})", "test.json: /cameras/0: expected near > 0"},
        {R"({"cameras": [{"name": "door", "orthographic": 2, "near": 5, "far": 4}]})",
         "test.json: /cameras/0: expected far > near, got 4 and 5"},
        {R"({"cameras": [{"name": "door", "matrix": [2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]})",
         "test.json: /cameras/0/matrix: expected a rotation and a translation"},
        // The last section fails: what the earlier ones did must not show.
        {R"({"functions": [{"name": "f", "kind": "lambert"}], "lights": [{"remove": "*"}], "exposure": null})",
         "test.json: /exposure: expected a number"},
    };
    for (const Fault& fault : faults) {
        CAPTURE(fault.message);
        const std::string message = refusal(fault.rig);
        CAPTURE(message);
        CHECK(message.starts_with(fault.message));
    }
}

TEST_CASE("rig: limits on nesting, array sizes and numbers of lights and functions are errors of their own kind") {
    refusal(R"({"exposure": )" + std::string(5000, '[') + std::string(5000, ']') + "}", ErrorKind::limit);
    std::string samples = "[0";
    for (int i = 0; i < 1000; ++i) samples += ", 0";
    refusal(R"({"functions": [{"name": "f", "kind": "sampled", "samples": )" + samples + "]}]}", ErrorKind::limit);
    CHECK(refusal(R"({"lights": [{"type": "point", "scatter": {"count": 4000000000, "box": "bounds"}}]})",
                  ErrorKind::limit) ==
          "test.json: /lights/0: expected at most 1000 lights in the scene, got 4000000002");

    Json functions = Json::array();
    for (int i = 0; i < 1025; ++i) functions.push_back({{"name", fmt::format("f{}", i)}, {"kind", "lambert"}});
    Scene scene = plainScene();
    try {
        applyRigText(scene, Json{{"functions", functions}}.dump(), "test.json");
        FAIL_CHECK("accepted");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::limit);
        CHECK(std::string(error.what()) ==
              "test.json: /functions/1024: expected at most 1024 functions in the scene, got 1025");
    }
}

TEST_CASE("rig: every prefix of a rig is refused, and so is any value of a wrong type") {
    const std::string text = kFullRig;
    for (size_t length = 0; length < text.size(); ++length) {
        Scene scene;
        CHECK_THROWS_AS(applyRigText(scene, text.substr(0, length), "test.json"), Error);
    }
    const Json whole = Json::parse(text);
    const Json flat = whole.flatten();
    size_t tried = 0;
    for (const auto& [pointer, before] : flat.items()) {
        for (const Json& wrong :
             {Json(), Json(true), Json(Json::object()), Json("?"), Json(-7.5), Json::array({Json::array()})}) {
            Json changed = whole;
            changed[Json::json_pointer(pointer)] = wrong;
            Scene scene = plainScene();
            try {
                applyRigText(scene, changed.dump(), "test.json");
            } catch (const Error& error) {
                CHECK(std::string(error.what()).starts_with("test.json: /"));
            }
            ++tried;
        }
    }
    CHECK(tried > 600);
}

TEST_CASE("rig: a file is read as its text would be, and a missing one is an input error") {
    const auto file = std::filesystem::temp_directory_path() / "luciole-rig-test.json";
    std::ofstream(file) << R"({"exposure": 2})";
    Scene scene;
    applyRig(scene, file);
    CHECK(scene.exposureEv == 2);
    std::ofstream(file) << R"({"exposure": []})";
    CHECK_THROWS_WITH_AS(applyRig(scene, file),
                         doctest::Contains("luciole-rig-test.json: /exposure: expected a number"), Error);
    std::filesystem::remove(file);
    try {
        applyRig(scene, file);
        FAIL_CHECK("accepted");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::io);
    }
}

TEST_CASE("rig: the schema accepts the examples and refuses what the reader refuses") {
    const std::filesystem::path root = LUCIOLE_SOURCE_DIR;
    if (std::system("python3 -c 'from jsonschema import Draft202012Validator' 2>/dev/null") != 0) {
        MESSAGE("skipped: needs python3 with the package jsonschema 4");
        return;
    }
    const auto folder = std::filesystem::temp_directory_path() / "luciole-rig-schema-test";
    std::filesystem::create_directories(folder / "good");
    std::filesystem::create_directories(folder / "bad");
    std::ofstream(folder / "good" / "full.json") << kFullRig;
    const char* const bad[] = {
        R"({"lihgts": []})",
        R"({"lights": [{"type": "lamp"}]})",
        R"({"lights": [{"type": "point"}]})",
        R"({"lights": [{"type": "directional"}]})",
        R"({"lights": [{"type": "point", "position": [0, 1, 2], "range": -1}]})",
        R"({"lights": [{"type": "point", "position": [0, 1, 2], "colour": "#ffffff"}]})",
        R"({"lights": [{"type": "directional", "direction": [0, 0, 0]}]})",
        R"({"lights": [{"remove": "sun", "color": [1, 1, 1]}]})",
        R"({"lights": [{"type": "point", "scatter": {"count": 2}}]})",
        R"({"lights": [{"type": "directional", "direction": [0, 0, 1], "scatter": {"count": 2, "box": "bounds"}}]})",
        R"({"functions": [{"name": "f", "kind": "wrap", "parameter": 2}]})",
        R"({"functions": [{"name": "f", "kind": "lambert", "parameter": 1}]})",
        R"({"functions": [{"name": "f", "kind": "sampled", "samples": [1, [1, 1]]}]})",
        R"({"materials": [{"match": "stone", "assignTo": "floor"}]})",
        R"({"materials": [{"match": "stone", "metallic": 1.5}]})",
        R"({"ambience": {"ambient": [1, 1, 1], "sky": [1, 1, 1]}})",
        R"({"cameras": [{"name": "c", "eye": [0, 0, 0]}]})",
        R"({"cameras": [{"name": "door", "fov": 180}]})",
    };
    int number = 0;
    for (const char* rig : bad) std::ofstream(folder / "bad" / fmt::format("{}.json", number++)) << rig;
    std::ofstream(folder / "check.py") << R"(
import glob, json, sys
from jsonschema import Draft202012Validator
root, folder = sys.argv[1:]
schema = json.load(open(root + "/docs/rig.schema.json"))
Draft202012Validator.check_schema(schema)
validator = Draft202012Validator(schema)
good = glob.glob(root + "/examples/rigs/*.json") + glob.glob(folder + "/good/*.json")
bad = glob.glob(folder + "/bad/*.json")
assert len(good) >= 4 and bad
faults = [f"{file}: {error.message}" for file in good for error in validator.iter_errors(json.load(open(file)))]
faults += [f"{file}: accepted" for file in bad if validator.is_valid(json.load(open(file)))]
print("\n".join(faults))
sys.exit(len(faults) > 0)
)";
    const std::string command =
        fmt::format("python3 '{}' '{}' '{}'", (folder / "check.py").string(), root.string(), folder.string());
    CHECK(std::system(command.c_str()) == 0);
    std::filesystem::remove_all(folder);
}
