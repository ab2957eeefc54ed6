#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <luciole/scene.hpp>

namespace luciole {

/// Where a ray meets a triangle.
struct Hit {
    uint32_t object = 0;    ///< index into Scene::objects
    uint32_t triangle = 0;  ///< indices 3 * triangle .. 3 * triangle + 2 of the object's mesh
    double t = 0;           ///< the point is origin + t * direction
    double u = 0, v = 0;    ///< barycentrics of vertices 1 and 2; vertex 0 has 1 - u - v
    bool frontFace = true;  ///< seen from its counter-clockwise side, a negative determinant taken into account
};

/// The same for the whole plane of a triangle: u and v beyond [0, 1] and t behind the origin are as good as any.
/// A ray within the plane gives values that aren't finite.
struct PlaneHit {
    double t, u, v;
    double facing;  ///< cross(p1 - p0, p2 - p0) . direction: negative if the ray comes from the counter-clockwise side
};
PlaneHit intersectPlane(dvec3 origin, dvec3 direction, const std::array<dvec3, 3>& triangle);

/// Finds what a ray hits first. Embree finds the triangle in single precision; point and barycentrics are then computed
/// in double precision. Queries may run on several threads at a time and don't depend on their number.
class Visibility {
public:
    /// Says whether the surface is there at `hit` (for alpha masks). Must not throw.
    using Accept = std::function<bool(const Hit&)>;

    /// \param scene valid; must outlive this object and stay unchanged meanwhile. Objects with a singular matrix, which
    ///        have no inside and no normals, are left out
    /// \throws std::bad_alloc
    explicit Visibility(const Scene& scene);
    ~Visibility();
    Visibility(Visibility&&) noexcept;
    Visibility& operator=(Visibility&&) noexcept;

    /// The hit with the least t >= tMin. Rays pass through back faces of single-sided materials and through hits that
    /// `accept` refuses.
    /// \param origin world space, metres; may be far outside of the scene, precision does not suffer
    /// \param direction world space, any length > 0; sets the unit of t
    /// \param accept called for candidates in no particular order; empty: everything is accepted
    std::optional<Hit> closest(dvec3 origin, dvec3 direction, double tMin = 0, const Accept& accept = {}) const;

    /// Whether `accept` accepts a hit with 0 <= t <= tMax; of single-sided materials, too, both faces block.
    /// \param origin, direction, accept as for `closest`
    bool isBlocked(dvec3 origin, dvec3 direction, double tMax, const Accept& accept) const;

    /// All hits with tMin <= t <= tMax that `closest` could find, the farthest first; of those that coincide, the last
    /// one drawn is last. The triangles of one surface that meet in an edge or a vertex on the ray are hit once.
    std::vector<Hit> allBetween(dvec3 origin, dvec3 direction, double tMin, double tMax,
                                const Accept& accept = {}) const;

    /// World-space corners of a triangle, metres.
    std::array<dvec3, 3> triangleWorld(uint32_t object, uint32_t triangle) const;

    /// Name and version of the ray tracer, "Embree 3.13.5".
    static std::string engine();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace luciole
