#pragma once
#include <luciole/scene.hpp>
#include <luciole/scene_io.hpp>

#include "scene/json.hpp"

/// One function per section of a rig file (docs/rig.md), in the order in which they are applied: later ones refer to
/// what earlier ones made. Each lays the section over `scene` and throws on the first fault, leaving `scene` half done.
namespace luciole::rig {

void applyFunctions(const JsonNode& list, Scene& scene);
void applyObjects(const JsonNode& list, Scene& scene);
void applyLightVolumes(const JsonNode& list, Scene& scene, const LoadLimits& limits);
void applyLinkGroups(const JsonNode& list, Scene& scene);
void applyMaterials(const JsonNode& list, Scene& scene);
void applyLights(const JsonNode& list, Scene& scene, const LoadLimits& limits);
void applyAmbience(const JsonNode& ambience, Scene& scene);
void applyCameras(const JsonNode& list, Scene& scene);

/// Index of the function that `reference` names, or describes in place. Built-in functions and those described in
/// place join the scene when first used.
uint32_t functionIndex(const JsonNode& reference, Scene& scene);

/// Index of the scene's function of this name, or else of the built-in one; nothing if there is neither.
/// \param user who asks, for the message of Error(limit)
std::optional<uint32_t> namedFunction(std::string_view name, const JsonNode& user, Scene& scene);

}  // namespace luciole::rig
