#pragma once
#include <memory>
#include <vector>

#include <luciole/scene.hpp>

#include "reference/camera_rays.hpp"
#include "reference/light_model.hpp"
#include "reference/texture.hpp"
#include "scene/visibility.hpp"

namespace luciole::reference {

/// Where a pixel lies on a triangle: barycentric weights of the three vertices, and their differences between the rays
/// of its 2 x 2 block, as a GPU forms derivatives.
struct Footprint {
    dvec3 weights, dx, dy;
};

/// \param x, y the pixel that `hit` belongs to; its neighbours' rays meet the plane of the same triangle
Footprint footprintOf(const CameraRays& rays, uint32_t x, uint32_t y, const Hit& hit,
                      const std::array<dvec3, 3>& triangleWorld);

/// The geometry phase: materials, textures and patterns of a scene, evaluated one point at a time.
class Surfaces {
public:
    /// \param scene, tables must outlive this object
    Surfaces(const Scene& scene, const FunctionTables& tables);

    /// Whether the alpha mask, if there is one, leaves the surface standing; one that blends is always there.
    bool isThere(const Hit& hit, const Footprint& footprint) const;

    SurfacePoint pointAt(const Hit& hit, const Footprint& footprint) const;

private:
    struct MappedTexture {
        TextureUse use;
        std::shared_ptr<const SampledTexture> texture;  ///< empty: counts as 1
    };
    struct PreparedMaterial {
        MappedTexture baseColor, metallicRoughness, normal, occlusion, emissive;
        const FunctionTable *Fa, *Fb;  ///< null unless shaped
    };
    struct PreparedObject {
        dmat4 worldFromObject;
        dmat3 normalWorldFromObject;
        double handedness;  ///< -1 for a negative determinant
    };
    struct Place;

    Place placeOf(const Hit& hit, const Footprint& footprint) const;
    static dvec4 read(const MappedTexture& mapped, const Place& place);
    static dvec4 baseColorAt(const Place& place);
    static dvec3 patternedColorAt(const Place& place, dvec3 baseColor);
    static dvec3 normalAt(const Place& place);

    const Scene& scene_;
    std::vector<PreparedMaterial> materials_;
    std::vector<PreparedObject> objects_;
};

}  // namespace luciole::reference
