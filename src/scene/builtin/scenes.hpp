#pragma once
#include <cstdint>

#include <luciole/scene.hpp>

/// The generators behind makeBuiltin. Arguments have passed the checks of builtinScenes().
namespace luciole {

struct HallOptions {
    uint32_t lights = 255;
    double overlap = 4;
    uint32_t triangles = 40000;
    uint32_t seed = 1;
    bool gltf = false;  ///< metallic-roughness materials of one colour only
};
Scene makeHall(const HallOptions& options);

Scene makeMaterials();

struct FirefliesOptions {
    uint32_t lights = 1000;
    uint32_t seed = 1;
};
Scene makeFireflies(const FirefliesOptions& options);

/// Each of these adds one element and returns its index.
uint32_t addMesh(Scene& scene, Mesh mesh, std::string name);
uint32_t addMaterial(Scene& scene, Material material);
uint32_t addFunction(Scene& scene, Function function);
/// Object IDs are given in turn; the objects beyond kMaxObjectId share the last one.
void addObject(Scene& scene, std::string name, uint32_t mesh, uint32_t material, const mat4& worldFromObject = mat4(1));

/// Turned about +Y by `angle` radians and scaled, then moved.
mat4 placed(vec3 position, float angle = 0, float scale = 1);

}  // namespace luciole
