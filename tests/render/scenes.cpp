#include "scenes.hpp"

#include <luciole/scene_io.hpp>

#include "scene_building.hpp"

namespace luciole::test {
namespace {

const mat4 kLying = glm::rotate(mat4(1), -1.5707964f, vec3(1, 0, 0));  // a quad that faces +Y

Material metallicRoughness(vec3 color, float metallic, float roughness) {
    return {.baseColor = vec4(color, 1), .metallic = metallic, .roughness = roughness};
}

Material shaped(Scene& scene, vec3 color, Function::Kind fa, float faParameter, Function::Kind fb, float fbParameter, float blend) {
    Material material{.equation = LightEquation::shaped, .baseColor = vec4(color, 1)};
    material.shaped.diffuseFunction = addFunction(scene, fa, faParameter);
    material.shaped.specularFunction = addFunction(scene, fb, fbParameter);
    material.shaped.specularColor = vec3(0.9f, 0.8f, 0.6f);
    material.shaped.specularBlend = blend;
    material.shaped.kAmbient = color;
    return material;
}

/// A textured and normal-mapped floor, seen at a slant so that all mip levels count, under one directional light.
TestScene texturedFloor() {
    Scene scene;
    std::vector<uint8_t> color, normal;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const auto wave = uint8_t(128 + 100 * std::sin(0.4 * x) * std::cos(0.3 * y));
            color.insert(color.end(), {wave, uint8_t(255 - wave), uint8_t(4 * x), 255});
            normal.insert(normal.end(), {uint8_t(128 + 60 * std::sin(0.2 * x)), uint8_t(128 + 60 * std::sin(0.2 * y)), 220, 255});
        }
    Material material = metallicRoughness(vec3(1), 0, 0.6f);
    material.baseColorTexture = addTexture(scene, 64, 64, color);
    material.normalTexture = addTexture(scene, 64, 64, normal);
    addObject(scene, quad(6, 6), material, kLying);
    scene.lights = {directionalLight(vec3(0.4f, -1, -0.3f), vec3(3)), pointLight(vec3(0, 1, 0), vec3(4, 2, 1), 5)};
    scene.ambience = {vec3(0.2f), vec3(0.1f)};
    Camera camera;
    camera.worldFromView = lookAt(vec3(0, 2, 5), vec3(0, 0, 0));
    return {"textured floor", std::move(scene), {camera, {192, 144}}, true};
}

/// Squares that between them use every wrap mode and filter, both UV sets, texture transforms, alpha masks, a mirrored
/// object and the back of a double-sided one.
TestScene textureCorners() {
    Scene scene;
    std::vector<uint8_t> texels;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            texels.insert(texels.end(), {uint8_t(x * 17), uint8_t(y * 17), uint8_t((x ^ y) & 4 ? 255 : 30), uint8_t(x > y ? 255 : 90)});
    const Sampler samplers[] = {
        {.wrapU = Wrap::mirroredRepeat, .wrapV = Wrap::clampToEdge},
        {.wrapU = Wrap::clampToEdge, .wrapV = Wrap::mirroredRepeat},
        {.magFilter = Filter::nearest, .minFilter = Filter::nearest, .mipFilter = MipFilter::none},
        {.minFilter = Filter::linear, .mipFilter = MipFilter::none},
        {.minFilter = Filter::linear, .mipFilter = MipFilter::nearest},
        {.magFilter = Filter::nearest, .mipFilter = MipFilter::linear},
    };
    for (int i = 0; i < 12; ++i) {
        Mesh mesh = quad(0.45f, 1.7f);
        for (Vertex& vertex : mesh.vertices) vertex.uv1 = 2.0f * vertex.uv0 + vec2(0.3f, 0.1f);
        Material material = metallicRoughness(vec3(1), 0, 0.8f);
        material.baseColorTexture = addTexture(scene, 16, 16, texels, samplers[i % 6]);
        material.normalTexture = addTexture(scene, 1, 1, {180, 150, 220, 255});
        material.baseColorTexture.uvSet = uint32_t(i / 6);
        if (i % 2) material.baseColorTexture.uvTransform = {vec3(0.8f, 0.6f, 0.2f), vec3(-0.9f, 1.2f, -0.4f)};
        if (i % 3 == 2) material.alphaMode = AlphaMode::mask;
        material.doubleSided = i >= 8;
        const float turn = i >= 10 ? 2.6f : 0.1f * float(i);
        mat4 place = glm::rotate(glm::translate(mat4(1), vec3(float(i % 4) - 1.5f, 1.0f - float(i / 4), 0)), turn, vec3(0.2f, 1, 0));
        if (i == 3 || i == 6) place = glm::scale(place, vec3(-1, 1, 1));
        addObject(scene, mesh, material, place);
    }
    scene.lights = {directionalLight(vec3(0.3f, -0.4f, -1), vec3(3))};
    scene.ambience = {vec3(0.3f), vec3(0.3f)};
    return {"texture corners", std::move(scene), {frontCamera(3.6f), {192, 144}}, true};
}

/// The studio under lights that meshes bound: a concave one of each type, and two that overlap.
TestScene boundedLights() {
    TestScene test = studio();
    test.name = "bounded lights";
    test.hardLights = true;
    Scene& scene = test.scene;
    const mat4 upright = glm::rotate(mat4(1), -1.5707964f, vec3(1, 0, 0));  // the prism's axis is +Y
    scene.lightVolumes = {prism(kAngle, glm::scale(mat4(1), vec3(2.2f, 3, 2.2f)) * upright),
                          torus(2, 0.7f, 24, 12, glm::translate(mat4(1), vec3(0, 0.8f, -1)) * upright),
                          prism({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, glm::translate(mat4(1), vec3(1, 0.3f, 1)))};
    for (uint32_t i = 0; i < scene.lights.size(); ++i) scene.lights[i].volume = i % 4 == 3 ? kNone : i % 4;
    return test;
}

/// The studio behind panes and around a bubble that let it through: lit in both equations, unlit, textured, seen from behind.
TestScene glass() {
    TestScene test = studio();
    test.name = "glass";
    Scene& scene = test.scene;
    std::vector<Material> panes = {metallicRoughness(vec3(0.3f, 0.6f, 0.9f), 0, 0.2f), metallicRoughness(vec3(0.9f, 0.7f, 0.4f), 0.5f, 0.5f),
                                   shaped(scene, vec3(0.8f, 0.3f, 0.5f), Function::Kind::lambert, 0, Function::Kind::blinnPhong, 20, 0.3f),
                                   unlitMaterial(vec4(0.2f, 0.5f, 0.3f, 1))};
    panes[1].baseColorTexture = addTexture(scene, 2, 2, {255, 255, 255, 40, 200, 255, 180, 220, 255, 90, 60, 128, 90, 90, 255, 200});
    for (size_t i = 0; i < panes.size(); ++i) {
        panes[i].alphaMode = AlphaMode::blend;
        panes[i].baseColor.w = 0.3f + 0.15f * float(i);
        panes[i].doubleSided = i == 1;
        const mat4 place = glm::translate(mat4(1), vec3(float(i) - 1.2f, 1.0f, 4.2f - 0.7f * float(i)));
        addObject(scene, quad(1.6f), panes[i], i == 1 ? glm::rotate(place, 2.8f, vec3(0, 1, 0)) : place);
    }
    addObject(scene, sphere(0.5f, 24, 12), panes[0], glm::translate(mat4(1), vec3(-2.4f, 0.8f, 2.0f)));
    return test;
}

}  // namespace

LightVolume prism(const std::vector<vec2>& corners, const mat4& worldFromPrism) {
    LightVolume volume;
    const auto n = uint32_t(corners.size());
    for (const float z : {-0.5f, 0.5f})
        for (const vec2 corner : corners) volume.positionsWorld.push_back(vec3(worldFromPrism * vec4(corner, z, 1)));
    for (uint32_t i = 1; i + 1 < n; ++i) volume.indices.insert(volume.indices.end(), {0, i + 1, i, n, n + i, n + i + 1});
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t j = (i + 1) % n;
        volume.indices.insert(volume.indices.end(), {i, j, n + j, i, n + j, n + i});
    }
    return volume;
}

LightVolume torus(float ring, float tube, uint32_t around, uint32_t across, const mat4& worldFromTorus) {
    LightVolume volume;
    for (uint32_t i = 0; i < around; ++i)
        for (uint32_t k = 0; k < across; ++k) {
            const float a = 2 * float(kPi) * float(i) / float(around), b = 2 * float(kPi) * float(k) / float(across);
            const float r = ring + tube * std::cos(b);
            volume.positionsWorld.push_back(vec3(worldFromTorus * vec4(r * std::cos(a), r * std::sin(a), tube * std::sin(b), 1)));
            const uint32_t i1 = (i + 1) % around, k1 = (k + 1) % across;
            volume.indices.insert(volume.indices.end(), {i * across + k, i1 * across + k, i1 * across + k1,  //
                                                         i * across + k, i1 * across + k1, i * across + k1});
        }
    return volume;
}

Scene whiteRoom() {
    Scene scene;
    const Material white = lambertMaterial(scene);
    const auto addWall = [&](vec3 at, float turn, vec3 axis) { addObject(scene, quad(2), white, glm::rotate(glm::translate(mat4(1), at), turn, axis)); };
    const float quarter = float(kPi) / 2;
    addWall(vec3(0, 0, -2), 0, vec3(1, 0, 0));
    addWall(vec3(0, -2, 0), -quarter, vec3(1, 0, 0));
    addWall(vec3(0, 2, 0), quarter, vec3(1, 0, 0));
    addWall(vec3(-2, 0, 0), quarter, vec3(0, 1, 0));
    addWall(vec3(2, 0, 0), -quarter, vec3(0, 1, 0));
    return scene;
}

TestScene builtin(const std::string& uri, uvec2 extent) {
    Scene scene = loadScene(uri);
    const Camera camera = scene.cameras.at(0);
    return {uri, std::move(scene), {camera, extent}};
}

TestScene tiledFloor(float degrees) {
    Scene scene;
    const Material white = lambertMaterial(scene);
    for (int y = -4; y <= 4; ++y)
        for (int x = -4; x <= 4; ++x) addObject(scene, quad(0.49f), white, glm::translate(mat4(1), vec3(x, y, 0)));
    const float angle = glm::radians(degrees);
    const vec3 away(std::cos(angle) * 0.8f, std::cos(angle) * 0.6f, std::sin(angle));
    scene.lights = {directionalLight(-away, vec3(1 / std::sin(angle))), pointLight(4.0f * away, vec3(100 / std::sin(angle)), 20),
                    spotLight(6.0f * away, -away, 0.3f, 0.8f, vec3(100 / std::sin(angle)), 20)};
    Camera camera;
    camera.worldFromView = lookAt(vec3(0, -6, 3), vec3(0, 0, 0));
    return {"tiled floor", std::move(scene), {camera, {160, 120}}};
}

TestScene studio() {
    Scene scene;
    using Kind = Function::Kind;
    const Material materials[] = {
        metallicRoughness(vec3(0.9f, 0.5f, 0.3f), 1, 0.25f),
        metallicRoughness(vec3(0.2f, 0.4f, 0.8f), 0, 0.4f),
        shaped(scene, vec3(0.7f, 0.2f, 0.2f), Kind::lambert, 0, Kind::blinnPhong, 40, 0),
        shaped(scene, vec3(0.3f, 0.7f, 0.3f), Kind::wrap, 0.5f, Kind::blinnPhong, 10, 1),
        shaped(scene, vec3(0.6f, 0.6f, 0.2f), Kind::orenNayar, 0.6f, Kind::constant, 0, 0.5f),
        unlitMaterial(vec4(0.3f, 0.2f, 0.6f, 1)),
    };
    for (int i = 0; i < 6; ++i)
        addObject(scene, sphere(0.8f, 48, 24), materials[i],
                  glm::translate(mat4(1), vec3(2.0f * float(i % 3) - 2.0f, 0.8f, i < 3 ? 0.0f : -2.0f)));
    addObject(scene, quad(8), metallicRoughness(vec3(0.5f), 0, 0.7f), kLying);

    const uint32_t ramp = addFunction(scene, Kind::sampled);
    scene.functions[ramp].samples = {vec2(1, 0), vec2(0.4f, 0), vec2(0.1f, 0), vec2(0)};
    const uint32_t iris = addFunction(scene, Kind::sampled);
    scene.functions[iris].samples = {vec2(0), vec2(0), vec2(0.5f, 0), vec2(1, 0)};
    scene.linkGroups = {{"all but two", {true, false, true, true, false, true, true}}};

    scene.lights = {directionalLight(vec3(-0.5f, -1, -0.4f), vec3(1.5f)),
                    pointLight(vec3(-2, 2.2f, 1.5f), vec3(6, 3, 1), 6),
                    pointLight(vec3(1.5f, 1.2f, 2), vec3(1, 4, 8)),
                    spotLight(vec3(0, 4, 2), vec3(0, -1, -0.5f), 0.2f, 0.6f, vec3(30, 25, 20), 9),
                    spotLight(vec3(4, 3, 0), vec3(-1, -0.6f, 0), 0.1f, 2.0f, vec3(5), 8)};
    scene.lights[1].attenuation = ramp;
    scene.lights[3].linkGroup = 0;
    scene.lights[4].falloff = iris;
    scene.lights.push_back(pointLight(vec3(0, 1, -4), vec3(8, 1, 6), 5));
    scene.lights.back().contribution = LightContribution::diffuseOnly;
    scene.lights.push_back(directionalLight(vec3(0.6f, -0.4f, -1), vec3(2)));
    scene.lights.back().contribution = LightContribution::specularOnly;
    scene.lights.back().infiniteViewer = true;
    scene.ambience = {vec3(0.08f, 0.1f, 0.16f), vec3(0.06f, 0.04f, 0.02f)};
    Camera camera;
    camera.worldFromView = lookAt(vec3(1, 3, 7), vec3(0, 0.6f, 0));
    return {"studio", std::move(scene), {camera, {192, 144}}};
}

std::vector<TestScene> testScenes() {
    std::vector<TestScene> scenes{studio(), texturedFloor(), textureCorners()};
    TestScene orthographic = studio();
    orthographic.name = "studio, orthographic";
    orthographic.view.camera.orthographic = true;
    orthographic.view.camera.halfHeight = 3;
    orthographic.view.camera.zFar = 40;
    scenes.push_back(std::move(orthographic));
    scenes.push_back(boundedLights());
    scenes.push_back(glass());
    for (const char* uri : {"builtin:hall?lights=64&triangles=8000", "builtin:materials", "builtin:fireflies?lights=100"})
        scenes.push_back(builtin(uri, {192, 144}));
    return scenes;
}

}  // namespace luciole::test
