#pragma once
#include <vector>

#include <luciole/scene.hpp>

#include "reference/lights.hpp"
#include "reference/surface.hpp"
#include "scene/visibility.hpp"

/// What a light's first bounce brings (docs/conventions.md, "Bounce"), diffuse from the surfaces that it lights and unhindered from there.
namespace luciole::reference {

/// A patch of surface that the light shines on, as a light.
struct Patch {
    dvec3 positionWorld, N;
    dvec3 intensity;       ///< candela along N
    double radiusSquared;  ///< of a disc of the patch's area, square metres

    /// What arrives at a point; no irradiance behind the patch.
    Arrival arrivalAt(dvec3 pointWorld) const;
};

/// The patches that `light`, a spot, sees through a square of side x side texels around its cone; those that bounce something.
std::vector<Patch> patchesOf(const Scene& scene, const Visibility& visibility, const Surfaces& surfaces, const Light& light,
                             const LightSource& source, uint32_t side);

}  // namespace luciole::reference
