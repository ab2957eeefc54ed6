#pragma once
#include <functional>
#include <string>

#include "scene/gltf/json.hpp"
#include "scene/gltf/warnings.hpp"

namespace luciole::gltf {

/// A node of the scene that is shown, and where it is.
struct PlacedNode {
    JsonNode json;
    std::string name;     ///< "node N" if the file gives none
    dmat4 worldFromNode;  ///< affine; may be singular or not finite, as files may say so
};

/// Calls `visit` for each node of the default scene, parents first and children in order. The default scene is the one
/// that `scene` names, else the first, else all nodes without parent.
/// \throws Error(scene) for indices out of range and for nodes with two parents or in a circle
void forEachNode(const JsonNode& root, Warnings& warnings, const std::function<void(const PlacedNode&)>& visit);

/// The scene of the document that is shown, if it has any.
std::optional<JsonNode> defaultScene(const JsonNode& root);

/// Whether `m` can place an object: its numbers fit into float, and so does its inverse.
bool isInvertible(const dmat4& m);

}  // namespace luciole::gltf
