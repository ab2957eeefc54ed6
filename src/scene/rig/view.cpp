#include <cmath>

#include <fmt/format.h>

#include "scene/rig/sections.hpp"
#include "scene/rig/values.hpp"

namespace luciole::rig {
namespace {

/// 16 numbers, column-major as in glTF: a rotation and a translation.
mat4 rigidMatrix(const JsonNode& node) {
    if (!node.isArray() || node.size() != 16) node.fail("16 numbers");
    dmat4 m;
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node[size_t(i)].number();
    const dmat3 rotation(m);
    const dmat3 error = glm::transpose(rotation) * rotation - dmat3(1);
    double largest = 0;
    for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(error[i / 3][i % 3]));
    const bool lastRow = m[0].w == 0 && m[1].w == 0 && m[2].w == 0 && m[3].w == 1;
    if (!lastRow || !(largest <= 1e-3) || !(glm::determinant(rotation) > 0)) {
        node.failWith("expected a rotation and a translation, column by column, got another matrix");
    }
    return mat4(m);
}

void setPlace(const JsonNode& entry, Camera& camera) {
    if (const auto matrix = entry.find("matrix")) {
        if (const auto eye = entry.find("eye")) eye->failWith("expected either a matrix or eye and target, got both");
        if (const auto target = entry.find("target"))
            target->failWith("expected either a matrix or eye and target, got both");
        camera.worldFromView = rigidMatrix(*matrix);
        return;
    }
    if (!entry.find("eye") && !entry.find("target")) return;
    const JsonNode target = entry.at("target");
    const vec3 eye = entry.at("eye").vector3();
    if (target.vector3() == eye) target.fail("a place other than the eye");
    camera.worldFromView = lookAt(eye, target.vector3());
}

void setLens(const JsonNode& entry, Camera& camera) {
    const auto height = entry.find("orthographic");
    if (const auto v = entry.find("fov")) {
        if (height) height->failWith("expected either fov or orthographic, got both");
        camera.yFov = float(glm::radians(between(*v, 0, 180)));
        camera.orthographic = false;
    } else if (height) {
        camera.halfHeight = float(0.5 * height->positiveNumber());
        camera.orthographic = true;
    }
    if (const auto v = entry.find("near")) camera.zNear = float(v->number(0));
    if (const auto v = entry.find("far")) camera.zFar = float(v->positiveNumber());
    if (!camera.orthographic && !(camera.zNear >= kLeastNear))
        entry.failWith(fmt::format("expected near >= {} for a perspective camera, got {}", kLeastNear, camera.zNear));
    if (camera.orthographic && !(camera.zFar > camera.zNear)) {
        entry.failWith(fmt::format("expected far > near, got {} and {}", camera.zFar, camera.zNear));
    }
}

}  // namespace

void applyAmbience(const JsonNode& ambience, Scene& scene) {
    ambience.expectKeys({"ambient", "sky", "ground", "up"});
    if (const auto v = ambience.find("ambient")) {
        for (const std::string_view other : {"sky", "ground"}) {
            if (const auto both = ambience.find(other))
                both->failWith("expected either ambient or sky and ground, got both");
        }
        scene.ambience.sky = scene.ambience.ground = color(*v);
    }
    if (const auto v = ambience.find("sky")) scene.ambience.sky = color(*v);
    if (const auto v = ambience.find("ground")) scene.ambience.ground = color(*v);
    if (const auto v = ambience.find("up")) scene.ambience.upWorld = direction(*v);
}

void applyCameras(const JsonNode& list, Scene& scene) {
    size_t added = 0;
    for (const JsonNode& entry : list.elements()) {
        entry.expectKeys({"name", "eye", "target", "matrix", "fov", "orthographic", "near", "far"});
        Camera camera{.name = entry.at("name").string()};
        const size_t index = indexOf(scene.cameras, camera.name);
        if (index < scene.cameras.size()) {
            camera = scene.cameras[index];
        } else if (!entry.find("matrix")) {
            entry.at("eye");
        }
        setPlace(entry, camera);
        setLens(entry, camera);
        if (index < scene.cameras.size()) {
            scene.cameras[index] = std::move(camera);
        } else {
            // Ahead of the file's cameras: the first one is what is seen unless another is asked for.
            scene.cameras.insert(scene.cameras.begin() + std::ptrdiff_t(added++), std::move(camera));
        }
    }
}

}  // namespace luciole::rig
