#pragma once
#include <string>
#include <vector>

#include <luciole/renderer.hpp>

namespace luciole::test {

/// A scene with the view it is tested from.
struct TestScene {
    std::string name;
    Scene scene;
    View view;
    bool textured = false;  ///< filtered textures: what a driver's filter units round counts
    bool hardLights = false;  ///< lights with hard edges: where the G-buffer puts the surface decides on which side it is
};

/// Scenes that between them use every light type, function, equation, surface shader and camera.
std::vector<TestScene> testScenes();

/// Closed meshes to bound lights with. A prism stands on a polygon in the plane z = 0, counter-clockwise and seen whole from
/// its first corner, and is 1 high.
LightVolume prism(const std::vector<vec2>& corners, const mat4& worldFromPrism);
LightVolume torus(float ring, float tube, uint32_t around, uint32_t across, const mat4& worldFromTorus);
inline const std::vector<vec2> kAngle{{0, 0}, {0, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 0}};  ///< L-shaped

/// Six spheres and a floor, shaped and metallic-roughness side by side, lit by every kind of light.
TestScene studio();

/// A scene that is built in, from its first camera.
TestScene builtin(const std::string& uri, uvec2 extent);

/// A floor of tiles that do not meet, each an object that may cast, under a light of each type that lies so many degrees above it.
TestScene tiledFloor(float degrees);

/// A room of five white squares seen from its open side, whose normals and colours all G-buffers hold as good as exactly.
Scene whiteRoom();

}  // namespace luciole::test
