#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>

#include "rig_scene.hpp"
#include "scene/rig/values.hpp"
#include "support.hpp"

using namespace luciole;
using namespace luciole::test;
using doctest::Approx;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

void checkColor(vec3 color, vec3 expected) {
    for (int i = 0; i < 3; ++i) CHECK(color[i] == Approx(expected[i]).epsilon(1e-6));  // float rounding
}

/// Six times the signed volume: positive for a closed surface that is oriented outwards.
double sixfoldVolume(const LightVolume& volume) {
    double sum = 0;
    for (size_t i = 0; i < volume.indices.size(); i += 3) {
        const auto corner = [&](size_t k) { return dvec3(volume.positionsWorld[volume.indices[i + k]]); };
        sum += dot(corner(0), cross(corner(1), corner(2)));
    }
    return sum;
}

/// Between other objects two helper meshes, tetrahedra with an edge of 1 each, the second one mirrored; objects differ by ID.
Scene sceneWithHelpers() {
    Scene scene = plainScene();
    Mesh helper{.name = "helper", .vertices = std::vector<Vertex>(4), .indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
    for (int axis = 0; axis < 3; ++axis) helper.vertices[size_t(axis) + 1].position[axis] = 1;
    scene.meshes.push_back(helper);
    const auto at = [](vec3 place, float x) {
        return mat4(x, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, place.x, place.y, place.z, 1);
    };
    scene.objects.insert(scene.objects.begin() + 1,
                         {.name = "volume a", .mesh = 1, .worldFromObject = at({10, 0, 0}, 2), .objectId = 3});
    scene.objects.push_back({.name = "volume b", .mesh = 1, .worldFromObject = at({20, 0, 0}, -1), .objectId = 4});
    return scene;
}

/// The first block of JSON in docs/rig.md.
std::string docsExample() {
    std::ifstream stream(std::filesystem::path(LUCIOLE_SOURCE_DIR) / "docs" / "rig.md");
    const std::string page(std::istreambuf_iterator<char>(stream), {});
    const size_t begin = page.find("```json\n") + 8;
    return page.substr(begin, page.find("```\n", begin) - begin);
}

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
    CHECK(scene.lightVolumes[key.volume].name == "spike");
    CHECK_FALSE(key.castsShadows);
    CHECK(key.shadowSoftness == 0.5f);
    CHECK(key.shadowResolution == 4);

    CHECK(scene.lights[2].directionWorld == vec3(0, -1, 0));
    CHECK(scene.lights[2].infiniteViewer);
    CHECK(scene.lightVolumes[scene.lights[2].volume].name == "room");
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
    CHECK(cloth.alphaMode == AlphaMode::blend);

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
    CHECK_FALSE(tiles.castsShadows);
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
    // The curtains share an ID: the right one casts, and with it the left one.
    CHECK(scene.linkGroups[0].castingObjects == std::vector<bool>{false, false, true, false, false, false, false, true});
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
        R"({"lights": [{"match": "key", "attenuation": null, "falloff": null, "range": null, "linkGroup": null, "volume": null}]})",
        scene);
    CHECK(scene.lights[1].attenuation == kNone);
    CHECK(scene.lights[1].falloff == kNone);
    CHECK(scene.lights[1].range == kInfinity);
    CHECK(scene.lights[1].linkGroup == kNone);
    CHECK(scene.lights[1].volume == kNone);
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

TEST_CASE("rig: a box and a mesh become light volumes, oriented outwards") {
    const Scene scene = rigged(kFullRig);
    REQUIRE(scene.lightVolumes.size() == 2);
    CHECK(scene.lightVolumes[0].name == "room");
    CHECK(scene.lightVolumes[0].positionsWorld.size() == 8);
    CHECK(sixfoldVolume(scene.lightVolumes[0]) == 6 * 5 * 7 * 9);
    CHECK(scene.lightVolumes[1].positionsWorld == std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    CHECK(scene.lightVolumes[1].indices == std::vector<uint32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
}

TEST_CASE("rig: objects become a light volume in world space and leave the picture; the others stay as they were") {
    const Scene before = sceneWithHelpers();
    const Scene scene = rigged(R"({"lightVolumes": [{"name": "a", "object": "volume a"}],
        "linkGroups": [{"name": "floor only", "include": "floor"}],
        "lights": [{"match": "*", "volume": "a", "linkGroup": "floor only"}]})",
                               before);
    REQUIRE(scene.objects.size() == 4);
    size_t next = 0;
    for (const Object& object : before.objects) {
        if (object.name == "volume a") continue;
        CHECK(scene.objects[next].name == object.name);
        CHECK(scene.objects[next].mesh == object.mesh);
        CHECK(scene.objects[next].material == object.material);
        CHECK(scene.objects[next++].objectId == object.objectId);
    }
    CHECK(scene.linkGroups[0].litObjects == std::vector<bool>{false, false, true, false, false});
    CHECK(scene.lights[0].volume == 0);
    CHECK(scene.lights[1].volume == 0);
    REQUIRE(scene.lightVolumes.size() == 1);
    CHECK(scene.lightVolumes[0].positionsWorld == std::vector<vec3>{{10, 0, 0}, {12, 0, 0}, {10, 1, 0}, {10, 0, 1}});
    CHECK(scene.warnings.empty());
}

TEST_CASE("rig: several objects make one light volume, a mirrored one is turned so that front faces stay outside") {
    const Scene scene = rigged(R"({"lightVolumes": [{"name": "both", "object": ["volume b", "*a"]}]})", sceneWithHelpers());
    CHECK(scene.objects.size() == 3);
    REQUIRE(scene.lightVolumes.size() == 1);
    CHECK(scene.lightVolumes[0].indices.size() == 24);
    CHECK(sixfoldVolume(scene.lightVolumes[0]) == 3);  // of 2 and 1; untreated, 2 - 1
}

TEST_CASE("rig: a light volume of a name that exists is replaced in place") {
    const Scene scene = rigged(R"({"lightVolumes": [{"name": "spike", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}]})",
                               rigged(kFullRig));
    REQUIRE(scene.lightVolumes.size() == 2);
    CHECK(scene.lightVolumes[1].positionsWorld.size() == 8);
    CHECK(scene.lights[1].volume == 1);
}

TEST_CASE("rig: all objects cast shadows, lit or not, unless the group says otherwise") {
    const auto group = [](const std::string& keys) {
        return rigged(R"({"linkGroups": [{"name": "g")" + keys + "}]}").linkGroups[0];
    };
    using Ids = std::vector<bool>;
    CHECK(group("").castingObjects == Ids{true, true, true});
    CHECK(group(R"(, "exclude": "floor")").castingObjects == Ids{true, true, true});
    CHECK(group(R"(, "exclude": "floor", "castExclude": "*left")").castingObjects == Ids{false, true, true});
    CHECK(group(R"(, "exclude": "floor", "castInclude": ["floor", "*left"])").castingObjects == Ids{true, false, true});
    CHECK(group(R"(, "include": "floor", "castInclude": "*", "castExclude": "floor")").castingObjects ==
          Ids{true, true, false});
    CHECK(group(R"(, "include": "floor", "castInclude": "*", "castExclude": "floor")").litObjects ==
          Ids{false, false, true});
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

TEST_CASE("rig: objects can be told apart by their materials") {
    const Scene scene = rigged(R"({"objects": [{"match": "*", "withMaterial": "stone", "objectId": 9}]})");
    CHECK(scene.objects[0].objectId == 0);
    CHECK(scene.objects[1].objectId == 1);
    CHECK(scene.objects[2].objectId == 9);
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

TEST_CASE("rig: the example of the docs works") {
    const Scene scene = rigged(docsExample());
    CHECK(scene.lights.size() == 16);
    CHECK(scene.linkGroups[0].litObjects[100]);
    CHECK(scene.materials[scene.objects[2].material].roughness == 0.2f);
    CHECK(scene.cameras.size() == 1);
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
    std::ofstream(folder / "good" / "docs.json") << docsExample();
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
        R"({"lightVolumes": [{"name": "v"}]})",
        R"({"lightVolumes": [{"object": "floor"}]})",
        R"({"lightVolumes": [{"name": "v", "object": "floor", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}]})",
        R"({"lightVolumes": [{"name": "v", "mesh": {"positions": [[0, 0, 0]], "indices": [[0, 0]]}}]})",
        R"({"lightVolumes": [{"name": "v", "mesh": {"positions": [[0, 0, 0]], "indices": []}}]})",
        R"({"lights": [{"match": "*", "volume": 3}]})",
        R"({"linkGroups": [{"name": "g", "castInclude": []}]})",
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
assert len(good) >= 5 and bad
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

TEST_CASE("rig: the example of light volumes applies to the hall, and each volume has a light") {
    Scene hall = loadScene("builtin:hall");
    const size_t lights = hall.lights.size();
    applyRig(hall, std::filesystem::path(LUCIOLE_SOURCE_DIR) / "examples" / "rigs" / "volumes.json");
    CHECK(hall.lights.size() > lights);
    REQUIRE(hall.lightVolumes.size() >= 2);
    const Bounds bounds = boundsOf(hall);
    for (uint32_t i = 0; i < hall.lightVolumes.size(); ++i) {
        CHECK(std::any_of(hall.lights.begin(), hall.lights.end(), [&](const Light& light) { return light.volume == i; }));
        CHECK(sixfoldVolume(hall.lightVolumes[i]) > 0);
        for (const vec3& position : hall.lightVolumes[i].positionsWorld) {
            CHECK(glm::all(glm::greaterThan(position, bounds.low - 1.0f)));
            CHECK(glm::all(glm::lessThan(position, bounds.high + 1.0f)));
        }
    }
}

TEST_CASE("rig: the examples light the scenes that they were made for") {
    LUCIOLE_ASSETS_OR_SKIP(assets);
    const std::filesystem::path rigs = std::filesystem::path(LUCIOLE_SOURCE_DIR) / "examples" / "rigs";
    Scene helmet = loadScene((assets / "DamagedHelmet" / "DamagedHelmet.glb").string());
    applyRig(helmet, rigs / "helmet.json");
    CHECK(helmet.lights.size() == 26);
    CHECK(helmet.cameras[0].name == "portrait");

    Scene sponza = loadScene((assets / "SponzaSmall" / "SponzaSmall.glb").string());
    applyRig(sponza, rigs / "sponza.json");
    CHECK(sponza.lights.size() == 155);
    const Bounds bounds = boundsOf(sponza);
    for (const Light& light : sponza.lights) {
        CHECK(glm::all(glm::greaterThan(light.positionWorld, bounds.low)));
        CHECK(glm::all(glm::lessThan(light.positionWorld, bounds.high)));
    }
    applyRig(sponza, rigs / "shaped.json");
    CHECK(sponza.lights.size() == 155);
    CHECK(std::count_if(sponza.materials.begin(), sponza.materials.end(),
                        [](const Material& material) { return material.equation == LightEquation::shaped; }) == 9);
}
