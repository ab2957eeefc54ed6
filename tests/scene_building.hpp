#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <luciole/renderer.hpp>
#include <luciole/scene.hpp>

/// Small scenes made by hand. Everything faces or surrounds the origin, so that closed forms stay short.
namespace luciole::test {

/// Square from (-halfSize, -halfSize, 0) to (halfSize, halfSize, 0), facing +Z. Texture coordinates run from (0, 0) at
/// the top left, as glTF's do, to (repeats, repeats); tangent +X, bitangent +Y (towards lesser v: the green of
/// a glTF normal map points up).
inline Mesh quad(float halfSize = 1, float repeats = 1) {
    Mesh mesh{.name = "quad", .vertices = {}, .indices = {0, 1, 2, 0, 2, 3}};
    for (const vec2 corner : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)}) {
        const vec2 uv = repeats * vec2(0.5f + 0.5f * corner.x, 0.5f - 0.5f * corner.y);
        mesh.vertices.push_back({.position = vec3(halfSize * corner, 0),
                                 .normal = vec3(0, 0, 1),
                                 .tangent = vec4(1, 0, 0, 1),
                                 .uv0 = uv,
                                 .uv1 = uv});
    }
    return mesh;
}

/// Sphere round the origin with smooth normals; poles on the Y axis, u runs once round it.
inline Mesh sphere(float radius = 1, uint32_t sectors = 32, uint32_t rings = 16) {
    Mesh mesh{.name = "sphere", .vertices = {}, .indices = {}};
    for (uint32_t ring = 0; ring <= rings; ++ring) {
        for (uint32_t sector = 0; sector <= sectors; ++sector) {
            const vec2 uv(float(sector) / float(sectors), float(ring) / float(rings));
            const double azimuth = 2 * kPi * double(uv.x), polar = kPi * double(uv.y);
            const dvec3 normal(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                               std::sin(polar) * std::cos(azimuth));
            const dvec3 tangent(std::cos(azimuth), 0, -std::sin(azimuth));
            mesh.vertices.push_back({.position = radius * vec3(normal),
                                     .normal = vec3(normal),
                                     .tangent = vec4(vec3(tangent), 1),
                                     .uv0 = uv,
                                     .uv1 = uv});
        }
    }
    for (uint32_t ring = 0; ring < rings; ++ring) {
        for (uint32_t sector = 0; sector < sectors; ++sector) {
            const uint32_t a = ring * (sectors + 1) + sector, b = a + sectors + 1;
            if (ring > 0) mesh.indices.insert(mesh.indices.end(), {a, b, a + 1});
            if (ring + 1 < rings) mesh.indices.insert(mesh.indices.end(), {a + 1, b, b + 1});
        }
    }
    return mesh;
}

/// Adds a mesh with its own material as one object; its ID is its index. Returns the index.
inline uint32_t addObject(Scene& scene, Mesh mesh, Material material, mat4 worldFromObject = mat4(1)) {
    const auto index = uint32_t(scene.objects.size());
    scene.meshes.push_back(std::move(mesh));
    scene.materials.push_back(std::move(material));
    scene.objects.push_back({.name = "object " + std::to_string(index),
                             .mesh = uint32_t(scene.meshes.size() - 1),
                             .material = uint32_t(scene.materials.size() - 1),
                             .worldFromObject = worldFromObject,
                             .objectId = index});
    return index;
}

inline Scene sceneOf(Mesh mesh, Material material, mat4 worldFromObject = mat4(1)) {
    Scene scene;
    addObject(scene, std::move(mesh), std::move(material), worldFromObject);
    return scene;
}

inline uint32_t addFunction(Scene& scene, Function::Kind kind, float parameter = 0) {
    scene.functions.push_back({.name = "", .kind = kind, .parameter = parameter, .samples = {}});
    return uint32_t(scene.functions.size() - 1);
}

/// \param rgba width * height * 4 bytes, row 0 at the top
inline TextureUse addTexture(Scene& scene, uint32_t width, uint32_t height, std::vector<uint8_t> rgba,
                             Sampler sampler = {}) {
    scene.texels.push_back({.name = "", .width = width, .height = height, .rgba = std::move(rgba)});
    scene.textures.push_back({.texels = uint32_t(scene.texels.size() - 1), .sampler = sampler});
    return {.texture = uint32_t(scene.textures.size() - 1)};
}

/// Shaped material that is Lambert's and nothing else: radiance = color * E / pi * max(N.L, 0). Adds its functions.
inline Material lambertMaterial(Scene& scene, vec3 color = vec3(1)) {
    Material material{.equation = LightEquation::shaped, .baseColor = vec4(color, 1)};
    material.shaped.diffuseFunction = addFunction(scene, Function::Kind::lambert);
    material.shaped.specularFunction = addFunction(scene, Function::Kind::constant, 0);
    material.shaped.ks = 0;
    return material;
}

inline Material unlitMaterial(vec4 color = vec4(1)) { return {.equation = LightEquation::unlit, .baseColor = color}; }

/// \param shinesTo where the light goes to, any length; \param lux per channel
inline Light directionalLight(vec3 shinesTo, vec3 lux = vec3(1)) {
    return {.type = LightType::directional, .directionWorld = glm::normalize(shinesTo), .color = lux};
}

inline Light pointLight(vec3 positionWorld, vec3 candela = vec3(1),
                        float range = std::numeric_limits<float>::infinity()) {
    return {.type = LightType::point, .positionWorld = positionWorld, .color = candela, .range = range};
}

/// Cone angles in radians.
inline Light spotLight(vec3 positionWorld, vec3 shinesTo, float inner, float outer, vec3 candela = vec3(1),
                       float range = std::numeric_limits<float>::infinity()) {
    return {.type = LightType::spot,
            .positionWorld = positionWorld,
            .directionWorld = glm::normalize(shinesTo),
            .color = candela,
            .range = range,
            .innerConeAngle = inner,
            .outerConeAngle = outer};
}

/// Perspective camera on the +Z axis that looks at the origin; right is +X, up is +Y.
inline Camera frontCamera(float distance = 2, float yFov = 0.9f) {
    return {.worldFromView = glm::translate(mat4(1), vec3(0, 0, distance)), .yFov = yFov};
}

inline Camera frontOrthographicCamera(float distance = 2, float halfHeight = 1) {
    Camera camera = frontCamera(distance);
    camera.orthographic = true;
    camera.halfHeight = halfHeight;
    return camera;
}

inline vec3 pixel(const Image& image, uint32_t x, uint32_t y) {
    return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

}  // namespace luciole::test
