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
};

/// Scenes that between them use every light type, function, equation, surface shader and camera.
std::vector<TestScene> testScenes();

/// Six spheres and a floor, shaped and metallic-roughness side by side, lit by every kind of light.
TestScene studio();

}  // namespace luciole::test
