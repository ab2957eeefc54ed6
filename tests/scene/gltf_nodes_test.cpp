#include <cmath>

#include <doctest/doctest.h>

#include "gltf_document.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

/// A document with `nodes`, the first of which is the scene's root.
Document withNodeArray(const Json& nodes) {
    Document document;
    document.triangle();
    document.json["nodes"] = nodes;
    return document;
}
Document withNodes(Json::initializer_list_t nodes) { return withNodeArray(Json::array(nodes)); }

Document withLight(const Json& light, const Json& node = Json::object()) {
    Document document = withNodes({node});
    document.json["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
    document.json["extensions"] = {{"KHR_lights_punctual", {{"lights", Json::array({light})}}}};
    return document;
}

Document withCamera(const Json& camera, const Json& node = Json::object()) {
    Document document = withNodes({node});
    document.json["nodes"][0]["camera"] = 0;
    document.json["cameras"] = Json::array({camera});
    return document;
}

const double kHalf = std::sqrt(0.5);  // cosine and sine of 45 degrees
const Json kPerspective{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.01}, {"zfar", 100}}}};

void checkNear(const vec3& a, const vec3& b) { CHECK(glm::length(a - b) < 1e-6f); }  // float rounding near 1

}  // namespace

TEST_CASE("glTF nodes: translation, rotation and scale multiply in this order, parents on the left") {
    // A quarter turn about Z and a move along x in the parent; a scale and a move along x in the child.
    Document document = withNodes({{{"rotation", {0, 0, kHalf, kHalf}}, {"translation", {10, 0, 0}}, {"children", {1}}},
                                   {{"name", "child"}, {"mesh", 0}, {"scale", {2, 3, 4}}, {"translation", {5, 0, 0}}}});
    const Scene scene = document.load();
    REQUIRE(scene.objects.size() == 1);
    CHECK(scene.objects[0].name == "child");
    const mat4 m = scene.objects[0].worldFromObject;
    checkNear(vec3(m[0]), vec3(0, 2, 0));
    checkNear(vec3(m[1]), vec3(-3, 0, 0));
    checkNear(vec3(m[2]), vec3(0, 0, 4));
    checkNear(vec3(m[3]), vec3(10, 5, 0));
}

TEST_CASE("glTF nodes: a matrix is read column by column") {
    const Json matrix{2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1};
    const Scene scene = withNodes({{{"mesh", 0}, {"matrix", matrix}}}).load();
    const mat4 m = scene.objects.at(0).worldFromObject;
    CHECK(m[0] == vec4(2, 0, 0, 0));
    CHECK(m[1] == vec4(0, 3, 0, 0));
    CHECK(m[3] == vec4(5, 6, 7, 1));
    Json projective = matrix;
    projective[3] = 0.5;
    CHECK(withNodes({{{"mesh", 0}, {"matrix", projective}}}).refusal().message ==
          "test.gltf: /nodes/0/matrix: expected a last row of 0, 0, 0, 1");
}

TEST_CASE("glTF nodes: a negative scale stays in the matrix and turns its determinant negative") {
    const Scene scene = withNodes({{{"mesh", 0}, {"scale", {-1, 2, 2}}}}).load();
    CHECK(glm::determinant(glm::mat3(scene.objects.at(0).worldFromObject)) == -4);
    CHECK(scene.meshes.at(0).indices == std::vector<uint32_t>{0, 1, 2});
}

TEST_CASE("glTF nodes: a quaternion is scaled to unit length; one of zeros is no rotation, with a warning") {
    Scene scene = withNodes({{{"mesh", 0}, {"rotation", {0, 0, 3, 3}}}}).load();
    checkNear(vec3(scene.objects.at(0).worldFromObject[0]), vec3(0, 1, 0));
    scene = withNodes({{{"mesh", 0}, {"rotation", {0, 0, 0, 0}}}}).load();
    CHECK(scene.objects.at(0).worldFromObject == mat4(1));
    CHECK(scene.warnings ==
          std::vector<std::string>{"/nodes/0/rotation: a quaternion of zeros is taken as no rotation"});
}

TEST_CASE("glTF nodes: what has no inverse or leaves float's range is not drawn, with a warning") {
    CHECK(withNodes({{{"mesh", 0}, {"scale", {1, 0, 1}}}}).load().warnings ==
          std::vector<std::string>{"/nodes/0 \"node 0\": its matrix can't be inverted; not drawn"});
    Document huge = withNodes({{{"scale", {3e38, 1, 1}}, {"children", {1}}}, {{"scale", {1e38, 1, 1}}, {"mesh", 0}}});
    const Scene scene = huge.load();
    CHECK(scene.objects.empty());
    CHECK(scene.warnings.size() == 1);
}

TEST_CASE("glTF nodes: the default scene is the named one, else the first, else all nodes without parent") {
    Document document =
        withNodes({{{"name", "a"}, {"mesh", 0}}, {{"name", "b"}, {"mesh", 0}, {"children", {2}}}, {{"mesh", 0}}});
    document.json["scenes"] = {{{"nodes", {0}}}, {{"name", "second"}, {"nodes", {1}}}};
    Scene scene = document.load();
    REQUIRE(scene.objects.size() == 1);
    CHECK(scene.objects[0].name == "a");
    CHECK(scene.name == "test");

    document.json["scene"] = 1;
    scene = document.load();
    REQUIRE(scene.objects.size() == 2);
    CHECK(scene.name == "second");
    CHECK(scene.objects[0].name == "b");
    CHECK(scene.objects[1].name == "node 2");
    CHECK(scene.objects[0].objectId == 0);
    CHECK(scene.objects[1].objectId == 1);

    document.json.erase("scene");
    document.json.erase("scenes");
    CHECK(document.load().objects.size() == 3);
    document.json["scene"] = 0;
    CHECK(document.refusal().message == "test.gltf: /scene: expected no reference to scenes, as there are none, got 0");
}

TEST_CASE("glTF nodes: circles, second parents and roots with a parent are refused") {
    CHECK(withNodes({{{"children", {1}}}, {{"children", {0}}}}).refusal().message ==
          "test.gltf: /scenes/0/nodes/0: expected a root node, got node 0, a child of node 1");
    CHECK(withNodes({{{"children", {0}}}}).refusal().message ==
          "test.gltf: /scenes/0/nodes/0: expected a root node, got node 0, a child of node 0");
    CHECK(withNodes({{{"children", {1, 2}}}, {{"children", {2}}}, Json::object()}).refusal().message ==
          "test.gltf: /nodes/1/children/0: expected a node without a parent, got node 2, a child of node 0");
    CHECK(withNodes({{{"children", {7}}}}).refusal().message ==
          "test.gltf: /nodes/0/children/0: expected a whole number in [0, 0], got 7");
    Document twice = withNodes({Json::object()});
    twice.json["scenes"][0]["nodes"] = {0, 0};
    CHECK(twice.refusal().message == "test.gltf: /scenes/0/nodes/1: expected each node once, got node 0 twice");
}

TEST_CASE("glTF nodes: a chain of 100,000 nodes needs no deep stack") {
    constexpr int kCount = 100'000;
    Json nodes = Json::array();
    for (int i = 0; i + 1 < kCount; ++i) nodes.push_back({{"translation", {1, 0, 0}}, {"children", {i + 1}}});
    nodes.push_back({{"mesh", 0}});
    const Scene scene = withNodeArray(nodes).load();
    CHECK(scene.objects.at(0).worldFromObject[3] == vec4(kCount - 1, 0, 0, 1));
}

TEST_CASE("glTF nodes: more nodes with a mesh than object IDs are refused") {
    Json nodes = Json::array();
    for (uint32_t i = 0; i <= kMaxObjectId; ++i) nodes.push_back({{"mesh", 0}});
    Document document = withNodeArray(nodes);
    document.json.erase("scenes");
    CHECK(document.load().objects.back().objectId == kMaxObjectId);
    document.json["nodes"].push_back({{"mesh", 0}});
    CHECK(document.refusal().kind == ErrorKind::limit);
    CHECK(document.refusal().message == "test.gltf: /nodes/65536: expected at most 65536 nodes with a mesh, got more");
}

TEST_CASE("glTF nodes: skins, animations and morph targets are shown at rest, with one warning for each kind") {
    Document document = withNodes({{{"mesh", 0}, {"skin", 0}, {"children", {1}}}, {{"mesh", 0}, {"skin", 0}}});
    document.json["skins"] = {{{"joints", {0, 1}}}};
    document.json["animations"] = Json::array({Json::object(), Json::object()});
    document.json["meshes"][0]["primitives"][0]["targets"] = Json::array({{{"POSITION", 0}}});
    const Scene scene = document.load();
    CHECK(scene.objects.size() == 2);
    CHECK(scene.warnings.size() == 3);
    document.json["skins"][0]["joints"] = {0, 2};
    CHECK(document.refusal().message == "test.gltf: /skins/0/joints/1: expected a whole number in [0, 1], got 2");
}

TEST_CASE("glTF lights: a light stands at its node and shines along the node's -Z, whatever the scale") {
    const Json spot{{"type", "spot"},
                    {"color", {1, 0.5, 0}},
                    {"intensity", 4},
                    {"range", 7},
                    {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}};
    // A quarter turn about Y takes -Z to -X.
    const Json node{
        {"name", "lamp"}, {"rotation", {0, kHalf, 0, kHalf}}, {"scale", {2, 2, -2}}, {"translation", {1, 2, 3}}};
    const Light light = withLight(spot, node).load().lights.at(0);
    CHECK(light.name == "lamp");
    CHECK(light.type == LightType::spot);
    CHECK(light.positionWorld == vec3(1, 2, 3));
    checkNear(light.directionWorld, vec3(1, 0, 0));  // mirrored by the negative scale
    CHECK(light.color == vec3(4, 2, 0));
    CHECK(light.range == 7);
    CHECK(light.innerConeAngle == 0.25f);
    CHECK(light.outerConeAngle == 0.5f);
}

TEST_CASE("glTF lights: what is left out is white, of intensity 1, without range, with a cone of 45 degrees") {
    Light light = withLight({{"type", "point"}}).load().lights.at(0);
    CHECK(light.type == LightType::point);
    CHECK(light.color == vec3(1));
    CHECK(std::isinf(light.range));
    light = withLight({{"type", "spot"}, {"spot", Json::object()}}).load().lights.at(0);
    CHECK(light.innerConeAngle == 0);
    CHECK(light.outerConeAngle == float(kPi / 4));
    light = withLight({{"type", "directional"}, {"intensity", 3}}).load().lights.at(0);
    CHECK(light.directionWorld == vec3(0, 0, -1));
    CHECK(light.color == vec3(3));
}

TEST_CASE("glTF lights: values against the extension's rules are refused with their path") {
    const std::string lights = "test.gltf: /extensions/KHR_lights_punctual/lights/0/";
    CHECK(withLight({{"type", "point"}, {"range", -1}}).refusal().message ==
          lights + "range: expected a number > 0, got -1");
    CHECK(withLight({{"type", "point"}, {"range", 0}}).refusal().kind == ErrorKind::scene);
    CHECK(withLight({{"type", "point"}, {"intensity", -2}}).refusal().message ==
          lights + "intensity: expected a number >= 0, got -2");
    CHECK(withLight({{"type", "area"}}).refusal().message ==
          lights + "type: expected one of directional, point, spot, got \"area\"");
    CHECK(withLight({{"type", "spot"}, {"spot", {{"outerConeAngle", 1.6}}}}).refusal().message ==
          lights + "spot/outerConeAngle: expected an angle of at most pi / 2, got 1.6");
    CHECK(
        withLight({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.4}}}}).refusal().message ==
        lights + "spot/innerConeAngle: expected at most the outerConeAngle of 0.4, got 0.5");
    Document missing = withLight({{"type", "point"}});
    missing.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 1;
    CHECK(missing.refusal().message ==
          "test.gltf: /nodes/0/extensions/KHR_lights_punctual/light: expected a whole number in [0, 0], got 1");
}

TEST_CASE("glTF lights: a hard-edged spot with equal angles gets the next smaller inner angle") {
    const Json spot{{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}}}};
    CHECK(withLight(spot).load().lights.at(0).innerConeAngle == std::nextafter(0.5f, 0.0f));
}

TEST_CASE("glTF lights: one whose direction is lost is left out with a warning") {
    const Scene scene = withLight({{"type", "directional"}}, {{"scale", {1, 1, 0}}}).load();
    CHECK(scene.lights.empty());
    CHECK(scene.warnings.size() == 1);
    CHECK(withLight({{"type", "point"}}, {{"scale", {0, 0, 0}}}).load().lights.size() == 1);
}

TEST_CASE("glTF cameras: a perspective camera has its node's name and place, and stays rigid under scale") {
    const Json node{{"name", "view"}, {"scale", {2, 3, -4}}, {"translation", {1, 2, 3}}};
    const Camera camera = withCamera(kPerspective, node).load().cameras.at(0);
    CHECK(camera.name == "view");
    CHECK(!camera.orthographic);
    CHECK(camera.yFov == 0.7f);
    CHECK(camera.zNear == 0.01f);
    CHECK(vec3(camera.worldFromView[1]) == vec3(0, 1, 0));
    CHECK(vec3(camera.worldFromView[2]) == vec3(0, 0, -1));  // mirrored by the negative scale: it looks along +Z
    CHECK(vec3(camera.worldFromView[0]) == vec3(-1, 0, 0));
    CHECK(vec3(camera.worldFromView[3]) == vec3(1, 2, 3));
}

TEST_CASE("glTF cameras: half the height of an orthographic camera is its ymag") {
    const Json lens{{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 50}};
    const Camera camera = withCamera({{"type", "orthographic"}, {"orthographic", lens}}).load().cameras.at(0);
    CHECK(camera.orthographic);
    CHECK(camera.halfHeight == 2);
    CHECK(camera.zNear == 0);
    CHECK(camera.zFar == 50);
    Json inverted = lens;
    inverted["znear"] = 60;
    CHECK(withCamera({{"type", "orthographic"}, {"orthographic", inverted}}).refusal().message ==
          "test.gltf: /cameras/0/orthographic/zfar: expected more than the znear of 60, got 50");
}
