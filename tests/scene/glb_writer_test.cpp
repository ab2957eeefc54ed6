#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>
#include <nlohmann/json.hpp>

#include "support.hpp"

using namespace luciole;
using Json = nlohmann::json;

namespace {

/// A file name of its own in the system's folder for such files; gone with this object.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::string& name)
        : path_(std::filesystem::temp_directory_path() / ("luciole-glb-writer-test-" + name)) {}
    ~TemporaryFile() { std::filesystem::remove(path_); }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

struct Glb {
    std::string bytes;
    Json json;
    std::string binary;
    std::vector<std::string> losses;
    Scene readBack;
};

uint32_t wordAt(const std::string& bytes, size_t offset) {
    uint32_t word = 0;
    REQUIRE(offset + 4 <= bytes.size());
    std::memcpy(&word, bytes.data() + offset, 4);
    return word;
}

/// Writes, takes apart by the glTF 2.0 specification, section 4.4, and reads back with our own reader.
Glb roundTrip(const Scene& scene, const std::string& name) {
    const TemporaryFile file(name + ".glb");
    Glb glb;
    glb.losses = writeGlb(scene, file.path());
    std::ifstream stream(file.path(), std::ios::binary);
    glb.bytes.assign(std::istreambuf_iterator<char>(stream), {});
    CHECK(wordAt(glb.bytes, 0) == 0x46546C67);
    CHECK(wordAt(glb.bytes, 4) == 2);
    CHECK(wordAt(glb.bytes, 8) == glb.bytes.size());
    const uint32_t jsonSize = wordAt(glb.bytes, 12);
    CHECK(jsonSize % 4 == 0);
    CHECK(wordAt(glb.bytes, 16) == 0x4E4F534A);
    glb.json = Json::parse(glb.bytes.substr(20, jsonSize));
    if (const size_t next = 20 + jsonSize; next < glb.bytes.size()) {
        CHECK(wordAt(glb.bytes, next) % 4 == 0);
        CHECK(wordAt(glb.bytes, next + 4) == 0x004E4942);
        glb.binary = glb.bytes.substr(next + 8);
        CHECK(glb.binary.size() == wordAt(glb.bytes, next));
    }
    glb.readBack = loadScene(file.path().string());
    return glb;
}

Mesh triangle(const std::string& name) {
    Mesh mesh{.name = name};
    mesh.vertices = {{.position = {-1.5f, 0.1f, 0}}, {.position = {1, 0, 0.3f}}, {.position = {0, 2, -7}}};
    mesh.indices = {0, 1, 2};
    return mesh;
}

/// Two objects that share a mesh, one of them mirrored, with two materials.
Scene smallScene() {
    Scene scene;
    scene.name = "small";
    scene.meshes = {triangle("blade")};
    scene.materials = {{.name = "red", .baseColor = {0.8f, 0.1f, 0.05f, 1}, .metallic = 0.25f, .roughness = 0.7f},
                       {.name = "lamp",
                        .alphaMode = AlphaMode::mask,
                        .alphaCutoff = 0.3f,
                        .doubleSided = true,
                        .emissive = {5.3f, 1.7f, 0.1f}}};
    scene.objects = {{.name = "left", .mesh = 0, .material = 0, .objectId = 0},
                     {.name = "right", .mesh = 0, .material = 1, .objectId = 1},
                     {.name = "far", .mesh = 0, .material = 0, .objectId = 2}};
    scene.objects[1].worldFromObject[0][0] = -1;
    scene.objects[2].worldFromObject[3] = {0.1f, -7, 3.3f, 1};
    return scene;
}

const Json& attributesOf(const Glb& glb, size_t mesh) {
    return glb.json["meshes"][mesh]["primitives"][0]["attributes"];
}

}  // namespace

TEST_CASE("glb: objects keep their names and matrices, and meshes are shared as before") {
    const Scene scene = smallScene();
    const Glb glb = roundTrip(scene, "objects");
    CHECK(glb.losses.empty());
    REQUIRE(glb.readBack.objects.size() == 3);
    for (size_t i = 0; i < 3; ++i) {
        CHECK(glb.readBack.objects[i].name == scene.objects[i].name);
        CHECK(glb.readBack.objects[i].worldFromObject == scene.objects[i].worldFromObject);
        CHECK(glb.readBack.objects[i].material == scene.objects[i].material);
    }
    // One glTF mesh per pair of mesh and material; both read the same accessors.
    REQUIRE(glb.json["meshes"].size() == 2);
    CHECK(attributesOf(glb, 0) == attributesOf(glb, 1));
    CHECK(glb.json["nodes"][0]["mesh"] == glb.json["nodes"][2]["mesh"]);
    CHECK(glb.readBack.meshes.size() == 1);
}

TEST_CASE("glb: geometry comes back bit for bit; attributes that say nothing are left out") {
    Scene scene = smallScene();
    const Glb plain = roundTrip(scene, "plain");
    CHECK(attributesOf(plain, 0).size() == 2);
    CHECK(attributesOf(plain, 0).contains("POSITION"));
    CHECK(attributesOf(plain, 0).contains("NORMAL"));

    for (Vertex& vertex : scene.meshes[0].vertices) {
        vertex.tangent = {0.6f, 0.8f, 0, -1};
        vertex.normal = {0.8f, -0.6f, 0};
        vertex.uv1 = {vertex.position.x / 3, 0.1f};
        vertex.color = {0.1f, 0.7f, 1.0f / 3, 0.9f};
    }
    const Glb full = roundTrip(scene, "full");
    CHECK(attributesOf(full, 0).size() == 6);  // TEXCOORD_0 too: sets are numbered without gaps
    REQUIRE(full.readBack.meshes.size() == 1);
    const Mesh& mesh = full.readBack.meshes[0];
    CHECK(mesh.indices == scene.meshes[0].indices);
    REQUIRE(mesh.vertices.size() == 3);
    for (size_t i = 0; i < 3; ++i) {
        const Vertex &was = scene.meshes[0].vertices[i], &is = mesh.vertices[i];
        CHECK(is.position == was.position);
        CHECK(glm::distance(is.normal, was.normal) < 1e-6f);  // a reader may normalise once more
        CHECK(glm::distance(is.tangent, was.tangent) < 1e-6f);
        CHECK(is.uv1 == was.uv1);
        CHECK(is.color == was.color);
    }
}

TEST_CASE("glb: buffer views are aligned, within the buffer, and know what they are for; bounds are exact") {
    const Glb glb = roundTrip(smallScene(), "structure");
    CHECK(glb.json["asset"]["version"] == "2.0");
    CHECK(glb.json["buffers"][0]["byteLength"] == glb.binary.size());
    std::set<int> targets;
    for (const Json& view : glb.json["bufferViews"]) {
        CHECK(view["byteOffset"].get<size_t>() % 4 == 0);
        CHECK(view["byteOffset"].get<size_t>() + view["byteLength"].get<size_t>() <= glb.binary.size());
        targets.insert(view["target"].get<int>());
    }
    CHECK(targets == std::set<int>{34962, 34963});
    const Json& position = glb.json["accessors"][attributesOf(glb, 0)["POSITION"].get<size_t>()];
    CHECK(position["count"] == 3);
    CHECK(position["min"] == Json{-1.5f, 0, -7});
    CHECK(position["max"] == Json{1, 2, 0.3f});
}

TEST_CASE("glb: meshes beyond 65535 vertices get 32-bit indices") {
    Scene scene = smallScene();
    const auto indexTypeWith = [&](size_t vertices) {
        scene.meshes[0].vertices.resize(vertices);
        scene.meshes[0].indices = {0, 1, uint32_t(vertices - 1)};
        const Glb glb = roundTrip(scene, "indices");
        CHECK(glb.readBack.meshes[0].indices == scene.meshes[0].indices);
        const size_t accessor = glb.json["meshes"][0]["primitives"][0]["indices"];
        return glb.json["accessors"][accessor]["componentType"].get<int>();
    };
    CHECK(indexTypeWith(65535) == 5123);
    CHECK(indexTypeWith(65536) == 5125);
}

TEST_CASE("glb: metallic-roughness and unlit materials come back exactly") {
    Scene scene = smallScene();
    scene.materials[0].equation = LightEquation::unlit;
    scene.materials[0].alphaMode = AlphaMode::blend;
    scene.materials[0].baseColor.a = 0.3f;
    const Glb glb = roundTrip(scene, "materials");
    CHECK(glb.losses.empty());
    REQUIRE(glb.readBack.materials.size() == 2);
    for (size_t i = 0; i < 2; ++i) {
        const Material &was = scene.materials[i], &is = glb.readBack.materials[i];
        CHECK(is.name == was.name);
        CHECK(is.equation == was.equation);
        CHECK(is.baseColor == was.baseColor);
        CHECK(is.metallic == was.metallic);
        CHECK(is.roughness == was.roughness);
        CHECK(is.emissive == was.emissive);
        CHECK(is.alphaMode == was.alphaMode);
        CHECK(is.alphaCutoff == (was.alphaMode == AlphaMode::mask ? was.alphaCutoff : 0.5f));
        CHECK(is.doubleSided == was.doubleSided);
    }
    CHECK(glb.json["extensionsUsed"] == Json{"KHR_materials_emissive_strength", "KHR_materials_unlit"});
}

TEST_CASE("glb: textures, samplers and texture transforms come back exactly") {
    Scene scene = smallScene();
    scene.texels = {{.name = "dots", .width = 2, .height = 3}};
    for (uint8_t i = 0; i < 24; ++i) scene.texels[0].rgba.push_back(uint8_t(10 * i + 3));
    Sampler sharp{Wrap::clampToEdge, Wrap::mirroredRepeat, Filter::nearest, Filter::linear, MipFilter::none};
    Sampler mixed{Wrap::repeat, Wrap::repeat, Filter::linear, Filter::nearest, MipFilter::linear};
    scene.textures = {{0, sharp}, {0, mixed}, {0, sharp}};
    Material& material = scene.materials[0];
    material.baseColorTexture.texture = 0;
    material.metallicRoughnessTexture = {1, 1, {vec3{2, 0, 0.25f}, vec3{0, -3, 0.5f}}};
    material.normalTexture.texture = 2;
    material.normalScale = 0.7f;
    material.occlusionTexture.texture = 1;
    material.occlusionStrength = 0.4f;
    const Glb glb = roundTrip(scene, "textures");
    CHECK(glb.losses.empty());
    CHECK(glb.json["samplers"].size() == 2);
    REQUIRE(glb.readBack.texels.size() == 1);
    CHECK(glb.readBack.texels[0].rgba == scene.texels[0].rgba);
    const Material& is = glb.readBack.materials[0];
    const auto samplerOf = [&](const TextureUse& use) { return glb.readBack.textures[use.texture].sampler; };
    CHECK(samplerOf(is.baseColorTexture) == sharp);
    CHECK(samplerOf(is.metallicRoughnessTexture) == mixed);
    CHECK(samplerOf(is.normalTexture) == sharp);
    CHECK(is.metallicRoughnessTexture.uvSet == 1);
    CHECK(is.metallicRoughnessTexture.uvTransform == material.metallicRoughnessTexture.uvTransform);
    CHECK(is.normalScale == 0.7f);
    CHECK(is.occlusionStrength == 0.4f);
    CHECK(is.emissiveTexture.texture == kNone);
}

TEST_CASE("glb: a turned texture transform comes back within rounding, a sheared one is reported") {
    Scene scene = smallScene();
    scene.texels = {{.name = "dot", .width = 1, .height = 1, .rgba = {1, 2, 3, 255}}};
    scene.textures = {{0, {}}};
    const float c = std::cos(0.6f), s = std::sin(0.6f);
    // Translation (0.1, 0.2) * rotation 0.6 * scale (2, -0.5), as KHR_texture_transform multiplies them.
    const std::array<vec3, 2> turned = {vec3{2 * c, -0.5f * s, 0.1f}, vec3{-2 * s, -0.5f * c, 0.2f}};
    scene.materials[0].baseColorTexture = {0, 0, turned};
    const Glb glb = roundTrip(scene, "turned");
    CHECK(glb.losses.empty());
    for (size_t row = 0; row < 2; ++row)
        CHECK(glm::distance(glb.readBack.materials[0].baseColorTexture.uvTransform[row], turned[row]) < 1e-6f);
    scene.materials[0].baseColorTexture.uvTransform[0].y = 1;
    CHECK(roundTrip(scene, "sheared").losses.size() == 1);
}

TEST_CASE("glb: lights come back exactly, directions within rounding") {
    Scene scene = smallScene();
    scene.lights = {
        {.name = "sun", .type = LightType::directional, .directionWorld = {0.6f, -0.8f, 0}, .color = {3, 2, 1}},
        {.name = "lamp", .positionWorld = {0.1f, 0.2f, 0.3f}, .color = {0.3f, 0.7f, 0.9f}, .range = 4.4f},
        {.name = "endless", .positionWorld = {1e6f, 0, 0}, .color = {1000.3f, 0, 1e-5f}},
        {.name = "down",
         .type = LightType::spot,
         .positionWorld = {0, 5.5f, 0},
         .directionWorld = {0, -1, 0},
         .range = 9,
         .innerConeAngle = 0.2f,
         .outerConeAngle = 0.9f}};
    const Glb glb = roundTrip(scene, "lights");
    CHECK(glb.losses.empty());
    REQUIRE(glb.readBack.lights.size() == 4);
    for (size_t i = 0; i < 4; ++i) {
        const Light &was = scene.lights[i], &is = glb.readBack.lights[i];
        CHECK(is.name == was.name);
        CHECK(is.type == was.type);
        CHECK(is.color == was.color);
        CHECK(is.range == was.range);
        if (was.type != LightType::directional) CHECK(is.positionWorld == was.positionWorld);
        if (was.type != LightType::point) CHECK(glm::distance(is.directionWorld, was.directionWorld) < 1e-6f);
        if (was.type == LightType::spot) {
            CHECK(is.innerConeAngle == was.innerConeAngle);
            CHECK(is.outerConeAngle == was.outerConeAngle);
        }
    }
}

TEST_CASE("glb: cameras come back exactly") {
    Scene scene = smallScene();
    scene.cameras = {{.name = "eye", .worldFromView = lookAt({1, 2, 3}, {0, 0, 0}), .yFov = 0.7f, .zNear = 0.02f},
                     {.name = "plan", .orthographic = true, .halfHeight = 3.5f, .zNear = 0, .zFar = 50}};
    const Glb glb = roundTrip(scene, "cameras");
    REQUIRE(glb.readBack.cameras.size() == 2);
    CHECK(glb.readBack.cameras[0].name == "eye");
    CHECK(glb.readBack.cameras[0].yFov == 0.7f);
    CHECK(glb.readBack.cameras[0].zNear == 0.02f);
    for (int column = 0; column < 4; ++column)
        CHECK(glm::distance(glb.readBack.cameras[0].worldFromView[column], scene.cameras[0].worldFromView[column]) <
              1e-5f);
    CHECK(glb.readBack.cameras[1].orthographic);
    CHECK(glb.readBack.cameras[1].halfHeight == 3.5f);
    CHECK(glb.readBack.cameras[1].zFar == 50);
}

TEST_CASE("glb: what glTF can't say is approximated and reported in one line each, however often it occurs") {
    Scene scene = smallScene();
    scene.functions = {{.name = "gloss", .kind = Function::Kind::blinnPhong, .parameter = 30}, {.name = "lambert"}};
    scene.linkGroups = {{"all", {true, true, true}}};
    scene.ambience.sky = vec3(0.1f);
    scene.exposureEv = 1;
    scene.materials[0].equation = LightEquation::shaped;
    scene.materials[0].shaped = {.diffuseFunction = 1, .specularFunction = 0, .kd = 0.5f, .specularBlend = 0.75f};
    scene.materials[1].surface = SurfaceShader::checker;
    scene.materials[1].baseColor = {1, 0.5f, 0, 1};
    const Light odd{.name = "odd",
                    .type = LightType::spot,
                    .range = 3,
                    .outerConeAngle = 2,
                    .attenuation = 1,
                    .falloff = 1,
                    .contribution = LightContribution::diffuseOnly,
                    .linkGroup = 0,
                    .castsShadows = false};
    scene.materials[1].castsShadows = false;
    scene.lights = {odd, odd, odd};
    const Glb glb = roundTrip(scene, "losses");
    // Cones, attenuation, falloff, contribution, link group, shadows; shaped, checker, no shadow; ambience, exposure.
    CHECK(glb.losses.size() == 11);
    const Material& shaped = glb.readBack.materials[0];
    CHECK(shaped.metallic == 0.75f);
    CHECK(shaped.roughness == doctest::Approx(std::pow(2.0 / 32, 0.25)));
    CHECK(shaped.baseColor.r == doctest::Approx(0.4));
    CHECK(glb.readBack.materials[1].baseColor == vec4(0.5f, 0.25f, 0, 1));
    CHECK(glb.readBack.lights[0].outerConeAngle == doctest::Approx(kPi / 2));
}

TEST_CASE("glb: an empty scene makes a valid file") {
    const Glb glb = roundTrip(Scene{}, "empty");
    CHECK(glb.binary.empty());
    CHECK(glb.readBack.objects.empty());
    CHECK(!glb.json.contains("meshes"));
}

TEST_CASE("glb: the built-in scenes survive writing and reading") {
    for (const char* uri :
         {"builtin:hall?lights=60&triangles=8000", "builtin:materials", "builtin:fireflies?lights=40"}) {
        const Scene scene = loadScene(uri);
        const Glb glb = roundTrip(scene, "builtin");
        CHECK(triangleCount(glb.readBack) == triangleCount(scene));
        CHECK(glb.readBack.meshes.size() == scene.meshes.size());
        CHECK(glb.readBack.objects.size() == scene.objects.size());
        REQUIRE(glb.readBack.lights.size() == scene.lights.size());
        for (size_t i = 0; i < scene.lights.size(); ++i) CHECK(glb.readBack.lights[i].color == scene.lights[i].color);
    }
}

TEST_CASE("glb: a file that can't be written is an error that names it") {
    try {
        writeGlb(smallScene(), "/nonexistent-folder/scene.glb");
        FAIL("accepted");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::io);
        CHECK(std::string(error.what()).find("/nonexistent-folder") != std::string::npos);
    }
}
