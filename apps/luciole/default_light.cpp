#include "default_light.hpp"

#include <algorithm>

namespace luciole::cli {

bool needsDefaultLight(const Scene& scene) {
    const bool dark = scene.lights.empty() && scene.ambience.sky == vec3(0) && scene.ambience.ground == vec3(0);
    return dark && std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
               return scene.materials[object.material].equation != LightEquation::unlit;
           });
}

void addDefaultLight(Scene& scene, const Camera& camera) {
    // A white wall that faces the light shows 0.25 + 2.2 / pi = 0.95, just under white.
    scene.ambience.sky = vec3(0.3f);
    scene.ambience.ground = vec3(0.2f);
    const vec3 directionView = glm::normalize(vec3(0.6f, -0.8f, -1));
    scene.lights.push_back({.name = "default",
                            .type = LightType::directional,
                            .directionWorld = glm::normalize(mat3(camera.worldFromView) * directionView),
                            .color = vec3(2.2f)});
}

}  // namespace luciole::cli
