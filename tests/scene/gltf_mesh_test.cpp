#include <array>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "gltf_document.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

using Indices = std::vector<uint32_t>;

/// A fan of five points around the first, all in the plane z = 0.
const std::vector<float> kFivePoints{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0};
const std::vector<float> kFiveNormals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};

Document withMode(int mode) {
    Document document;
    const uint32_t positions = document.accessor(kFivePoints, 3);
    const uint32_t normals = document.accessor(kFiveNormals, 3);
    document.primitive({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"mode", mode}});
    return document;
}

std::string onlyWarning(const Scene& scene) {
    REQUIRE(scene.warnings.size() == 1);
    return scene.warnings[0];
}

}  // namespace

TEST_CASE("glTF mesh: a list without indices takes the vertices in order; two left over are ignored with a warning") {
    const Scene scene = withMode(4).load();
    CHECK(scene.meshes.at(0).indices == Indices{0, 1, 2});
    CHECK(onlyWarning(scene).find("the last 2 are ignored") != std::string::npos);
}

TEST_CASE("glTF mesh: every second triangle of a strip is turned round, as glTF 3.7.2.1 says") {
    CHECK(withMode(5).load().meshes.at(0).indices == Indices{0, 1, 2, 1, 3, 2, 2, 3, 4});
}

TEST_CASE("glTF mesh: the triangles of a fan end in its first vertex") {
    CHECK(withMode(6).load().meshes.at(0).indices == Indices{1, 2, 0, 2, 3, 0, 3, 4, 0});
}

TEST_CASE("glTF mesh: points and lines are left out with a warning") {
    for (int mode = 0; mode < 4; ++mode) {
        const Scene scene = withMode(mode).load();
        CHECK(scene.objects.empty());
        CHECK(onlyWarning(scene).find("not drawn") != std::string::npos);
    }
    CHECK(withMode(7).refusal().message ==
          "test.gltf: /meshes/0/primitives/0/mode: expected a whole number in [0, 6], got 7");
}

TEST_CASE("glTF mesh: indices of one, two and four bytes are read") {
    for (int size = 1; size <= 4; size *= 2) {
        Document document = withMode(4);
        uint32_t indices = 0;
        if (size == 1) indices = document.accessor<uint8_t>({4, 2, 0});
        if (size == 2) indices = document.accessor<uint16_t>({4, 2, 0});
        if (size == 4) indices = document.accessor<uint32_t>({4, 2, 0});
        document.json["meshes"][0]["primitives"][0]["indices"] = indices;
        CHECK(document.load().meshes.at(0).indices == Indices{4, 2, 0});
    }
}

TEST_CASE("glTF mesh: an index beyond the vertices is refused") {
    Document document = withMode(4);
    document.json["meshes"][0]["primitives"][0]["indices"] = document.accessor<uint16_t>({0, 1, 5});
    const Refusal refusal = document.refusal();
    CHECK(refusal.kind == ErrorKind::scene);
    CHECK(refusal.message ==
          "test.gltf: /meshes/0/primitives/0/indices: expected indices below 5, the number of vertices, got 5 at 2");
}

TEST_CASE("glTF mesh: normalised integers stand for [0, 1] and [-1, 1], the lowest for -1 as well") {
    Document document;
    document.triangle();
    document.attributes()["NORMAL"] = document.accessor<int8_t>({127, 0, 0, 0, -128, 0, 0, 0, 127}, 3, true);
    document.attributes()["TEXCOORD_0"] = document.accessor<uint8_t>({0, 255, 51, 102, 153, 204}, 2, true);
    document.attributes()["TEXCOORD_1"] = document.accessor<uint16_t>({0, 65535, 13107, 0, 0, 0}, 2, true);
    document.attributes()["COLOR_0"] = document.accessor<uint16_t>({65535, 0, 13107, 0, 0, 0, 0, 0, 0}, 3, true);
    const auto vertices = document.load().meshes.at(0).vertices;
    CHECK(vertices[0].normal == vec3(1, 0, 0));
    CHECK(vertices[1].normal == vec3(0, -1, 0));
    CHECK(vertices[0].uv0 == vec2(0, 1));
    CHECK(vertices[1].uv0 == vec2(0.2f, 0.4f));
    CHECK(vertices[0].uv1 == vec2(0, 1));
    CHECK(vertices[1].uv1 == vec2(0.2f, 0));
    CHECK(vertices[0].color == vec4(1, 0, 0.2f, 1));
}

TEST_CASE("glTF mesh: quantised positions and UVs that are not normalised keep their whole numbers") {
    Document document;
    document.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    document.triangle();
    document.attributes()["POSITION"] = document.accessor<int16_t>({0, 0, 0, 300, 0, 0, 0, -32768, 0}, 3);
    document.attributes()["TEXCOORD_0"] = document.accessor<uint16_t>({0, 7, 0, 0, 0, 0}, 2);
    const Scene scene = document.load();
    CHECK(scene.meshes.at(0).vertices[1].position == vec3(300, 0, 0));
    CHECK(scene.meshes.at(0).vertices[2].position == vec3(0, -32768, 0));
    CHECK(scene.meshes.at(0).vertices[0].uv0 == vec2(0, 7));
    CHECK(scene.warnings.empty());
}

TEST_CASE("glTF mesh: vertex colours of four bytes or four floats keep their alpha; without any they are white") {
    Document document;
    document.triangle();
    CHECK(document.load().meshes.at(0).vertices[0].color == vec4(1));
    document.attributes()["COLOR_0"] = document.accessor<uint8_t>({255, 0, 51, 102, 0, 0, 0, 0, 0, 0, 0, 0}, 4, true);
    CHECK(document.load().meshes.at(0).vertices[0].color == vec4(1, 0, 0.2f, 0.4f));
    document.attributes()["COLOR_0"] = document.accessor<float>({2, 0, 0.5f, 0.25f, 0, 0, 0, 0, 0, 0, 0, 0}, 4);
    CHECK(document.load().meshes.at(0).vertices[0].color == vec4(2, 0, 0.5f, 0.25f));
}

TEST_CASE("glTF mesh: interleaved vertices are read with the view's stride") {
    Document document;
    document.data.clear();
    // position and normal of each vertex side by side, 24 bytes apart
    document.add<float>({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1});
    document.json["bufferViews"][0]["byteStride"] = 24;
    for (const int offset : {0, 12}) {
        document.json["accessors"].push_back(
            {{"bufferView", 0}, {"byteOffset", offset}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    }
    document.primitive({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}});
    const auto vertices = document.load().meshes.at(0).vertices;
    CHECK(vertices[2].position == vec3(0, 1, 0));
    CHECK(vertices[2].normal == vec3(0, 0, 1));
    document.json["bufferViews"][0]["byteStride"] = 8;
    CHECK(document.refusal().message == "test.gltf: /accessors/0: expected a byteStride of at least 12, got 8");
}

TEST_CASE("glTF mesh: a sparse accessor replaces elements, of its buffer view or of zeros") {
    Document document;
    document.triangle();
    const Json sparse{
        {"count", 2},
        {"indices", {{"bufferView", 0}, {"byteOffset", document.add<uint8_t>({0, 2})}, {"componentType", 5121}}},
        {"values", {{"bufferView", 0}, {"byteOffset", document.add<float>({9, 8, 7, 6, 5, 4})}}}};
    document.json["accessors"][0]["sparse"] = sparse;
    auto vertices = document.load().meshes.at(0).vertices;
    CHECK(vertices[0].position == vec3(9, 8, 7));
    CHECK(vertices[1].position == vec3(1, 0, 0));
    CHECK(vertices[2].position == vec3(6, 5, 4));

    document.json["accessors"][0].erase("bufferView");
    document.json["accessors"][0].erase("byteOffset");
    vertices = document.load().meshes.at(0).vertices;
    CHECK(vertices[0].position == vec3(9, 8, 7));
    CHECK(vertices[1].position == vec3(0, 0, 0));

    document.json["accessors"][0]["sparse"]["indices"]["byteOffset"] = document.add<uint8_t>({0, 3});
    CHECK(document.refusal().message == "test.gltf: /accessors/0/sparse/indices: expected indices below 3, got 3 at 1");
    document.json["accessors"][0]["sparse"]["count"] = 4;
    CHECK(document.refusal().message ==
          "test.gltf: /accessors/0/sparse/count: expected a whole number in [1, 3], got 4");
}

TEST_CASE("glTF mesh: without normals the triangles are flat and share no vertices") {
    Document document;
    const uint32_t positions = document.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, 3);
    const uint32_t indices = document.accessor<uint8_t>({0, 1, 2, 0, 2, 3, 0, 0, 1});
    document.primitive({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    const Mesh mesh = document.load().meshes.at(0);
    CHECK(mesh.indices == Indices{0, 1, 2, 3, 4, 5, 6, 7, 8});
    CHECK(mesh.vertices[0].normal == vec3(0, 0, 1));
    CHECK(mesh.vertices[4].normal == vec3(1, 0, 0));
    CHECK(mesh.vertices[4].position == vec3(0, 1, 0));
    CHECK(mesh.vertices[8].normal == vec3(0, 0, 1));  // of a triangle without area
}

TEST_CASE("glTF mesh: a normal of no length, or one that is no number, becomes that of the triangle") {
    Document document;
    document.triangle();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    document.attributes()["NORMAL"] = document.accessor<float>({0, 0, 0, nan, 0, 0, 0, 3, 4}, 3);
    const Scene scene = document.load();
    CHECK(scene.meshes.at(0).vertices[0].normal == vec3(0, 0, 1));
    CHECK(scene.meshes.at(0).vertices[1].normal == vec3(0, 0, 1));
    CHECK(scene.meshes.at(0).vertices[2].normal == vec3(0, 0.6f, 0.8f));
    CHECK(onlyWarning(scene) ==
          "/meshes/0/primitives/0/attributes/NORMAL: values that are not finite are replaced by 0");
}

TEST_CASE("glTF mesh: a position that is no number is refused") {
    Document document;
    document.triangle();
    const float infinity = std::numeric_limits<float>::infinity();
    document.attributes()["POSITION"] = document.accessor<float>({0, 0, 0, 1, infinity, 0, 0, 1, 0}, 3);
    CHECK(
        document.refusal().message ==
        "test.gltf: /meshes/0/primitives/0/attributes/POSITION: expected finite numbers, got (1, inf, 0) at vertex 1");
}

TEST_CASE("glTF mesh: normals and tangents stay finite at both ends of float's range") {
    for (const float size : {3e38f, 1e-38f}) {
        Document document;
        document.triangle();
        document.attributes()["POSITION"] = document.accessor<float>({-size, 0, 0, size, 0, 0, 0, size, 0}, 3);
        document.attributes().erase("NORMAL");
        CHECK(document.load().meshes.at(0).vertices[0].normal == vec3(0, 0, 1));
    }
}

TEST_CASE("glTF mesh: attributes of unlike counts or types are refused") {
    Document document;
    document.triangle();
    document.attributes()["NORMAL"] = document.accessor<float>({0, 0, 1}, 3);
    CHECK(document.refusal().message ==
          "test.gltf: /meshes/0/primitives/0/attributes/NORMAL: expected 3 elements as in POSITION, got 1");
    document.attributes()["NORMAL"] = document.accessor<float>({0, 0, 1, 0, 0, 1}, 2);
    CHECK(document.refusal().message == "test.gltf: /accessors/3/type: expected 3 components, got \"VEC2\"");
}

TEST_CASE("glTF mesh: primitives of the same accessors share one mesh, whatever their material") {
    Document document;
    document.triangle();
    document.json["materials"] = {{{"name", "red"}}, {{"name", "blue"}}};
    Json first = document.json["meshes"][0]["primitives"][0], second = first;
    first["material"] = 0;
    second["material"] = 1;
    document.json["meshes"][0]["primitives"] = {first, second};
    const Scene scene = document.load();
    CHECK(scene.meshes.size() == 1);
    REQUIRE(scene.objects.size() == 2);
    CHECK(scene.objects[0].material == 0);
    CHECK(scene.objects[1].material == 1);
    CHECK(scene.objects[0].name == scene.objects[1].name);
    CHECK(scene.objects[0].objectId == scene.objects[1].objectId);
}

TEST_CASE("glTF mesh: more vertices or indices than the limit are refused before they are made") {
    Document document;
    document.triangle();
    LoadOptions options;
    options.limits.maxVertices = 2;
    CHECK(document.refusal(options).kind == ErrorKind::limit);
    CHECK(document.refusal(options).message == "test.gltf: /accessors/0/count: expected at most 2 elements, got 3");

    Document strip = withMode(5);
    options.limits.maxVertices = 8;
    CHECK(strip.refusal(options).message ==
          "test.gltf: /meshes/0/primitives/0: expected at most 8 indices in all, got 9");
    options.limits.maxVertices = 9;
    CHECK(strip.refusal(options).message == "loaded");
}
