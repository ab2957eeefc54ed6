#include <algorithm>
#include <cmath>

#include <luciole/scene.hpp>

namespace luciole {
namespace {

dmat4 lookAlong(dvec3 eye, dvec3 forward) {
    const dvec3 upHint = std::hypot(forward.x, forward.z) > 1e-6 ? dvec3(0, 1, 0) : dvec3(0, 0, 1);
    const dvec3 right = glm::normalize(glm::cross(forward, upHint));
    const dvec3 up = glm::cross(right, forward);
    return dmat4(dvec4(right, 0), dvec4(up, 0), dvec4(-forward, 0), dvec4(eye, 1));
}

}  // namespace

Bounds boundsOf(const Scene& scene) {
    vec3 low(std::numeric_limits<float>::infinity());
    vec3 high(-std::numeric_limits<float>::infinity());
    bool empty = true;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.meshes[object.mesh];
        for (const uint32_t index : mesh.indices) {
            const vec3 positionWorld(object.worldFromObject * vec4(mesh.vertices[index].position, 1));
            low = glm::min(low, positionWorld);
            high = glm::max(high, positionWorld);
            empty = false;
        }
    }
    return empty ? Bounds{} : Bounds{low, high};
}

bool isDrawn(const Object& object) {
    const double volume = determinant(dmat3(object.worldFromObject));
    return volume != 0 && std::isfinite(volume);
}

uint64_t triangleCount(const Scene& scene) {
    uint64_t count = 0;
    for (const Object& object : scene.objects) count += scene.meshes[object.mesh].indices.size() / 3;
    return count;
}

Camera autoCamera(const Scene& scene) {
    const Bounds bounds = boundsOf(scene);
    const dvec3 center = 0.5 * (dvec3(bounds.low) + dvec3(bounds.high));
    const double diagonal = glm::length(dvec3(bounds.high) - dvec3(bounds.low));
    // A point has no size of its own, and far from the origin a float can't place an eye closer than its own step.
    const double radius = std::max(diagonal > 0 ? 0.5 * diagonal : 1.0, 1e-4 * glm::length(center));

    Camera camera{.name = "auto", .yFov = 0.8f};
    // The sphere touches the frame's edge at radius / sin(yFov / 2); a tenth more leaves a margin.
    const double distance = 1.1 * radius / std::sin(0.5 * double(camera.yFov));
    const dvec3 towardsEye = glm::normalize(dvec3(0.45, 0.35, 1));  // glTF assets face +Z
    camera.worldFromView = mat4(lookAlong(center + distance * towardsEye, -towardsEye));
    camera.zNear = float(0.01 * distance);
    return camera;
}

mat4 lookAt(vec3 eye, vec3 target) {
    const dvec3 towards = dvec3(target) - dvec3(eye);
    const double distance = glm::length(towards);
    return mat4(lookAlong(dvec3(eye), distance > 0 ? towards / distance : dvec3(0, 0, -1)));
}

}  // namespace luciole
