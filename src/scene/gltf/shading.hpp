#pragma once
#include <cstdint>

#include <luciole/scene.hpp>

/// Normals and tangents that a glTF file leaves out (glTF 2.0, section 3.7.2.1). All in object space, unit length, and
/// computed in double precision, so that no finite position overflows.
namespace luciole::gltf {

/// Gives each triangle vertices of its own, with the triangle's normal; (0, 0, 1) for one without area.
void makeFlat(Mesh& mesh);

/// Scales normals to unit length. One of zero length is replaced by the mean of its triangles' normals, by area.
void repairNormals(Mesh& mesh);

/// Scales tangents to unit length and their signs to 1 or -1. One of zero length or along the normal is replaced by
/// `anyTangent`.
void repairTangents(Mesh& mesh);

/// A tangent at right angles to the unit vector `normal`, with sign 1.
vec4 anyTangent(vec3 normal);

/// Derives tangents from UV set `uvSet`, in the manner of MikkTSpace (Mikkelsen 2008, "Simulation of Wrinkled Surfaces
/// Revisited", appendix A): per triangle the direction in which u grows, projected into the plane of the corner's
/// normal, averaged with the corner's angle as weight over all corners that share position, normal, UV and handedness.
/// A vertex where handedness changes is split. Triangles without area in UV space do not count. We do not ask that
/// the triangles around a vertex be connected by edges, so two fans that only touch in a point share a tangent.
void deriveTangents(Mesh& mesh, uint32_t uvSet);

}  // namespace luciole::gltf
