#pragma once
#include <span>
#include <vector>

#include <luciole/renderer.hpp>

#include "gpu/bindings.shared.h"
#include "render/shaders/types.shared.h"

/// From the Scene's plain data to the structs that shaders read. No device needed.
namespace luciole::render {

shared::ViewConstants viewConstants(const View& view, const Ambience& ambience);

/// The coefficients of slackOf (light_volume.shared.h): how far the G-buffer of this layout, the rasterizer's snapping to
/// sub-pixels and the rounding of depth may move a surface point against a light's shape.
/// \param multisampled surface points lie anywhere in their pixel
vec4 viewSlack(const View& view, GBufferLayout layout, bool multisampled = false);

/// The light in world space. \param index in Scene::lights; \param functionCount of the scene (see functionTable)
shared::LightConstants lightConstants(const Light& light, uint32_t index, uint32_t functionCount);

/// The scene's lights, in world space, sorted by the shape that a technique has to draw for them; of one shape along a Morton curve
/// through their positions, so that neighbours in the table are neighbours in space.
struct SortedLights {
    std::vector<shared::PackedLight> sources;
    std::vector<shared::LightKind> kinds;
    uint32_t unbounded = 0;  ///< so many first: directional ones and those with no range worth the name
    uint32_t shaped = 0;     ///< then so many that a ball or its sector encloses
    uint32_t meshes = 0;     ///< then those that a mesh bounds

    shared::LightConstants at(uint32_t i) const { return shared::unpackLight(sources[i], kinds[shared::kindOf(sources[i])]); }
};
/// \param functionCount of the scene (see functionTable)
SortedLights sortLights(std::span<const Light> lights, uint32_t functionCount);

/// Adds `count` lights that the device places (docs/techniques/bounce.md) to the end of the shaped ones. Until it has, they reach nothing.
/// \param linkGroup of the light whose links they have; \param firstIndex their scene index: those of the scene's own lights come before
/// \return the place of the first
uint32_t addPlacedLights(SortedLights& lights, uint32_t linkGroup, uint32_t firstIndex, uint32_t count);

struct VolumeTables {
    std::vector<shared::VolumeConstants> volumes;
    std::vector<vec3> vertices;  ///< three per triangle
};
VolumeTables volumeTables(const Scene& scene);

/// The hierarchy over the lights (light_tree.shared.h), in world space. Lights placed on the device may be anywhere: their nodes enclose
/// everything, as do those of unbounded ones.
std::vector<vec4> lightTree(const SortedLights& lights, const VolumeTables& volumes);

/// Triangles of the convex meshes of all levels of detail, one level after the other (light_volume.shared.h),
/// counter-clockwise from outside.
std::vector<uint32_t> volumeIndices();

uint32_t lightFeatures(std::span<const Light> lights);

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

/// Objects by the lights that touch them: two IDs that the same link groups hold are of one class.
struct ObjectClasses {
    std::vector<uint32_t> classOfObject;  ///< by object ID, up to the largest one there is
    std::vector<uint32_t> objectOfClass;  ///< an ID of each class
};
ObjectClasses objectClasses(const Scene& scene);

/// clipFromView of docs/conventions.md, "Spaces".
dmat4 clipFromView(const Camera& camera, double aspect);

}  // namespace luciole::render
