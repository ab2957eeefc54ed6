#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include <luciole/scene.hpp>

#include "scene/random.hpp"
#include "scene_building.hpp"
#include "scenes.hpp"

/// Rooms, lights and cameras by chance, for tests that hold on all of them. The same seed makes the same.
namespace luciole::test {

class Dice {
public:
    explicit Dice(uint64_t seed) : random_(seed, 1) {}
    float between(float low, float high) { return float(random_.between(low, high)); }
    float scale(float low, float high) { return low * float(std::pow(high / low, random_.unit())); }  ///< evenly over magnitudes
    uint32_t below(uint32_t n) { return random_.below(n); }
    vec3 place(float reach) { return {between(-reach, reach), between(-reach, reach), between(-reach, reach)}; }
    vec3 direction() {
        while (true) {
            const vec3 v = place(1);
            if (const float l = glm::length(v); l > 0.1f && l < 1) return v / l;
        }
    }

private:
    Random random_;
};

/// Squares and spheres in the dark, open to the sky in places.
inline Scene randomRoom(Dice& dice) {
    Scene scene;
    const Material grey{.doubleSided = true, .baseColor = vec4(0.5f, 0.5f, 0.5f, 1), .metallic = 0, .roughness = 0.6f};
    for (int i = 0; i < 5; ++i)
        addObject(scene, quad(dice.scale(0.5f, 12)), grey,
                  glm::rotate(glm::translate(mat4(1), dice.place(5)), dice.between(0, 6), dice.direction()));
    for (int i = 0; i < 4; ++i)
        addObject(scene, sphere(dice.scale(0.1f, 3), 12, 8), grey, glm::translate(mat4(1), dice.place(5)));
    return scene;
}

/// Three closed meshes, one concave, one with a hole, whose inside may be turned out.
inline void addRandomVolumes(Scene& scene, Dice& dice) {
    const auto place = [&] {
        return glm::scale(glm::rotate(glm::translate(mat4(1), dice.place(4)), dice.between(0, 6), dice.direction()), vec3(dice.scale(0.5f, 5)));
    };
    scene.lightVolumes = {prism({{-1, -1}, {1, -1}, {0.3f, 1}}, place()), prism(kAngle, place()), torus(1, 0.4f, 9, 5, place())};
    if (dice.below(2) == 0) std::ranges::reverse(scene.lightVolumes[1].indices);  // its inside turned out
}

/// Of any kind and size, around the eye or behind it or anywhere in the room.
inline Light randomLight(Dice& dice, vec3 eye, vec3 forward) {
    Light light;
    light.color = vec3(dice.scale(0.1f, 10));
    const uint32_t kind = dice.below(20);
    light.type = kind == 0 ? LightType::directional : kind < 10 ? LightType::point : LightType::spot;
    light.range = kind == 1 ? std::numeric_limits<float>::infinity() : dice.scale(0.01f, 20);
    if (kind == 2) light.range = dice.scale(20, 1e5f);
    switch (dice.below(6)) {
        case 0: light.positionWorld = eye + dice.place(0.5f * std::min(light.range, 10.0f)); break;  // around the eye
        case 1: light.positionWorld = eye - forward * dice.between(0, 1.2f * std::min(light.range, 10.0f)); break;  // behind it
        case 2: light.positionWorld = eye; break;
        default: light.positionWorld = dice.place(7);
    }
    light.directionWorld = dice.direction();
    light.outerConeAngle = dice.below(3) == 0 ? dice.between(1.5f, 3.14f) : dice.scale(0.002f, 1.6f);
    light.innerConeAngle = dice.between(0, 0.9f) * light.outerConeAngle;
    return light;
}

/// Anywhere in the room, seldom at a usual angle.
inline Camera randomCamera(Dice& dice) {
    Camera camera;
    const vec3 eye = dice.place(6);
    camera.worldFromView = lookAt(eye, eye + dice.direction());
    camera.orthographic = dice.below(4) == 0;
    camera.yFov = dice.between(0.05f, 2.6f);
    camera.halfHeight = dice.scale(0.1f, 10);
    camera.zNear = dice.scale(0.001f, 0.5f);
    camera.zFar = dice.between(3, 40);
    return camera;
}

inline const View kRoomView{frontCamera(6), {48, 36}};  ///< into whiteRoom()

/// For there. Half of them spots; no nearer to the walls than a tenth of a metre. \param scale of their ranges: 1 for up to a metre
inline void addManyLights(Scene& scene, Dice& dice, uint32_t count, float scale) {
    for (uint32_t i = 0; i < count; ++i) {
        const vec3 at = dice.place(1.9f);
        const float range = scale * dice.between(0.2f, 1);
        scene.lights.push_back(i % 2 == 0 ? pointLight(at, vec3(1), range) : spotLight(at, dice.direction(), 0.2f, dice.between(0.3f, 1.5f), vec3(2), range));
    }
}

}  // namespace luciole::test
