#pragma once
#include <luciole/scene.hpp>

namespace luciole::cli {

/// True if the scene has surfaces that react to light, and nothing that lights them.
bool needsDefaultLight(const Scene& scene);

/// A soft hemisphere and one directional light from over the camera's left shoulder.
void addDefaultLight(Scene& scene, const Camera& camera);

}  // namespace luciole::cli
