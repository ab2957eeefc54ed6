#pragma once
#include <optional>

#include <luciole/scene.hpp>

#include "scene/gltf/nodes.hpp"

namespace luciole::gltf {

/// The light that KHR_lights_punctual puts at `node`; none where the node's matrix leaves it no position or direction,
/// which is warned of.
/// \param reference index of the light in the document's extension
std::optional<Light> readLight(const JsonNode& root, const JsonNode& reference, const PlacedNode& node,
                               Warnings& warnings);

/// The camera at `node`. It stays rigid: scale and shear of the node do not reach it. None as above.
std::optional<Camera> readCamera(const JsonNode& root, const JsonNode& reference, const PlacedNode& node,
                                 Warnings& warnings);

}  // namespace luciole::gltf
