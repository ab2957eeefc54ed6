#include <cmath>

#include <doctest/doctest.h>

#include "gltf_document.hpp"
#include "scene/gltf/shading.hpp"
#include "support.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

/// One red texel.
constexpr const char* kPng =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==";

/// Two triangles side by side in the plane z = 0 with a normal map; `u` of the vertices at x = 0, 1, 2.
Document strip(float u0, float u1, float u2, int uvSet = 0) {
    Document document;
    document.json["images"] = {{{"uri", kPng}}};
    document.json["textures"] = {{{"source", 0}}};
    document.json["materials"] = {{{"normalTexture", {{"index", 0}, {"texCoord", uvSet}}}}};
    const uint32_t positions = document.accessor<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0}, 3);
    const uint32_t normals = document.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    // v grows downwards: 1 at y = 0, 0 at y = 1
    const uint32_t uvs = document.accessor<float>({u0, 1, u1, 1, u1, 0, u2, 1}, 2);
    const uint32_t indices = document.accessor<uint8_t>({0, 1, 2, 1, 3, 2});
    document.primitive(
        {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"indices", indices}, {"material", 0}});
    document.attributes()[uvSet == 0 ? "TEXCOORD_0" : "TEXCOORD_1"] = uvs;
    return document;
}

}  // namespace

TEST_CASE("glTF tangents: on an upright picture the tangent points along u and the bitangent up") {
    for (const int uvSet : {0, 1}) {
        const Mesh mesh = strip(0, 0.5f, 1, uvSet).load().meshes.at(0);
        REQUIRE(mesh.vertices.size() == 4);
        for (const Vertex& v : mesh.vertices) CHECK(v.tangent == vec4(1, 0, 0, 1));
    }
}

TEST_CASE(
    "glTF tangents: a mirrored picture has the opposite tangent and sign, so that its bitangent still points up") {
    const Mesh mesh = strip(1, 0.5f, 0).load().meshes.at(0);
    for (const Vertex& v : mesh.vertices) CHECK(v.tangent == vec4(-1, 0, 0, -1));
}

TEST_CASE("glTF tangents: vertices on a mirror line are split, the others are not") {
    const Mesh mesh = strip(0, 1, 0).load().meshes.at(0);
    REQUIRE(mesh.vertices.size() == 6);
    CHECK(mesh.indices == std::vector<uint32_t>{0, 1, 2, 4, 3, 5});
    CHECK(mesh.vertices[1].tangent == vec4(1, 0, 0, 1));
    CHECK(mesh.vertices[4].tangent == vec4(-1, 0, 0, -1));
    CHECK(mesh.vertices[4].position == mesh.vertices[1].position);
    CHECK(mesh.vertices[3].tangent == vec4(-1, 0, 0, -1));
}

TEST_CASE("glTF tangents: a triangle without area in UV space does not count") {
    const Mesh mesh = strip(0, 1, 1).load().meshes.at(0);
    REQUIRE(mesh.vertices.size() == 4);
    CHECK(mesh.vertices[1].tangent == vec4(1, 0, 0, 1));
    CHECK(std::abs(mesh.vertices[3].tangent.z) == 0);  // no triangle counts: any tangent at right angles to the normal
}

TEST_CASE("glTF tangents: corners weigh by their angle") {
    // Around the origin, a corner of 90 degrees whose u grows along x, and one of 45 degrees whose u grows along y.
    Document document = strip(0, 1, 1);
    document.attributes()["POSITION"] = document.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 1, 0}, 3);
    document.attributes()["TEXCOORD_0"] = document.accessor<float>({0, 0, 1, 0, 0, -1, 0, -1}, 2);
    document.json["meshes"][0]["primitives"][0]["indices"] = document.accessor<uint8_t>({0, 1, 2, 0, 2, 3});
    // Second triangle: (0,0) at the origin, (0,-1) at both others: no UV area, so only the first one counts.
    CHECK(document.load().meshes.at(0).vertices[0].tangent == vec4(1, 0, 0, 1));

    document.attributes()["TEXCOORD_0"] = document.accessor<float>({0, 0, 1, 0, 0, -1, -2, -1}, 2);
    // Now u grows by 2 from (0,1) to (-1,1), whose du is -2: along x again, with the same hand; no change.
    const vec4 same = document.load().meshes.at(0).vertices[0].tangent;
    CHECK(same == vec4(1, 0, 0, 1));

    document.attributes()["TEXCOORD_0"] = document.accessor<float>({0, 0, 1, 0, 0, -1, -1, 0}, 2);
    // Second triangle: e1 = (0,1) with uv (0,-1), e2 = (-1,1) with uv (-1,0): u grows along (1,-1), v along (0,-1).
    const vec4 tangent = document.load().meshes.at(0).vertices[0].tangent;
    const double expected = -45 * std::sqrt(0.5) / (90 + 45 * std::sqrt(0.5));        // y / x of the weighted sum
    CHECK(double(tangent.y / tangent.x) == doctest::Approx(expected).epsilon(1e-6));  // float rounding
    CHECK(tangent.w == 1);
}

TEST_CASE("glTF tangents: vertices that are equal in all that counts share a tangent though they are stored twice") {
    Document document = strip(0, 1, 1);
    // Two triangles over one edge without shared indices; the surface's u turns from +x to (1,-1).
    document.attributes()["POSITION"] =
        document.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, -1, 1, 0}, 3);
    document.attributes()["NORMAL"] =
        document.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    document.attributes()["TEXCOORD_0"] = document.accessor<float>({0, 0, 1, 0, 0, -1, 0, 0, 0, -1, -1, 0}, 2);
    document.json["meshes"][0]["primitives"][0].erase("indices");
    const auto vertices = document.load().meshes.at(0).vertices;
    CHECK(vertices[0].tangent == vertices[3].tangent);
    CHECK(vertices[0].tangent != vertices[1].tangent);
}

TEST_CASE("glTF tangents: those of the file are kept, scaled to unit length with a sign of 1 or -1") {
    Document document = strip(0, 1, 2);
    document.attributes()["TANGENT"] = document.accessor<float>({0, 2, 0, 1, 0, 1, 0, -1, 0, 0, 0, 1, 0, 0, 5, 1}, 4);
    const auto vertices = document.load().meshes.at(0).vertices;
    CHECK(vertices[0].tangent == vec4(0, 1, 0, 1));
    CHECK(vertices[1].tangent == vec4(0, 1, 0, -1));
    CHECK(vertices[2].tangent == vec4(1, 0, 0, 1));  // no length
    CHECK(vertices[3].tangent == vec4(1, 0, 0, 1));  // along the normal
}

TEST_CASE("glTF tangents: derived ones agree with those that the mirror test model brings along") {
    LUCIOLE_ASSETS_OR_SKIP(folder);
    const Scene given = loadScene((folder / "NormalTangentMirrorTest" / "NormalTangentMirrorTest.glb").string());
    Mesh derived = given.meshes.at(0);
    gltf::deriveTangents(derived, 0);
    const auto& expected = given.meshes[0].vertices;
    size_t agreeing = 0;
    for (size_t i = 0; i < expected.size(); ++i) {
        const vec4 a = expected[i].tangent, b = derived.vertices[i].tangent;
        agreeing += a.w == b.w &&
                    glm::dot(vec3(a), vec3(b)) > 0.99f;  // 8 degrees: MikkTSpace groups corners a little differently
    }
    CHECK(agreeing == expected.size());
    CHECK(derived.vertices.size() == expected.size());
}
