#pragma once
#include <span>
#include <vector>

#include <luciole/math.hpp>

namespace luciole::render {

/// The edges of a mesh, for the sides of its shadow volumes: each with one triangle or two. Where more triangles meet there are several edges
/// in one place; any mesh will do, closed or not.
/// \param positions of the vertices; those at the same place are one
/// \param indices triangle list
/// \return of each edge the triangle that runs through it, times 4, plus the corner where it begins there; then kNone, or another triangle,
///         times 4, plus 1 if it runs through it in the same direction. Edges without length are left out.
std::vector<uvec2> edgesOf(std::span<const vec3> positions, std::span<const uint32_t> indices);

}  // namespace luciole::render
