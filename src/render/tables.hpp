#pragma once
#include <vector>

#include <luciole/renderer.hpp>

#include "render/shaders/types.shared.h"

/// From the Scene's plain data to the structs that shaders read. No device needed.
namespace luciole::render {

shared::ViewConstants viewConstants(const View& view, const Ambience& ambience);

/// \param viewFromWorld of the view the light is put into; \param functionCount of the scene (see functionTable)
shared::LightConstants lightConstants(const Light& light, const dmat4& viewFromWorld, uint32_t functionCount);
uint32_t lightFeatures(const std::vector<Light>& lights);

/// The material as both phases read it. `colorBound`: the largest vertex colour channel met on it, at least 1.
struct MaterialTables {
    shared::SurfaceConstants surface;
    shared::MaterialConstants material;
};
MaterialTables materialTables(const Material& material, float colorBound);

shared::ObjectConstants objectConstants(const Object& object);

/// Rows of kFunctionSamples values (shape, cascade): first every function over [-1, 1], for dot products and cosines, then
/// every function over [0, 1], for attenuation.
std::vector<vec2> functionTable(const std::vector<Function>& functions);

/// One row of bits per link group, bit i of a row: object ID i is lit. \param words 32-bit words per row
std::vector<uint32_t> linkTable(const Scene& scene, uint32_t& words);

/// clipFromView of docs/conventions.md, "Spaces".
dmat4 clipFromView(const Camera& camera, double aspect);

}  // namespace luciole::render
