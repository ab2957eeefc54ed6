#pragma once
#include <luciole/renderer.hpp>

namespace luciole::reference {

/// World space; `direction` is one metre long along the view axis, so that a ray's parameter is the depth in metres.
struct Ray {
    dvec3 origin, direction;
};

/// The rays of a picture through its pixel centres.
class CameraRays {
public:
    explicit CameraRays(const View& view);

    /// Pixel (x, y), row 0 at the top. Pixels beyond the picture's edge are as good as any.
    Ray through(uint32_t x, uint32_t y) const;

    /// V, the unit direction from a point to the eye.
    dvec3 toEye(dvec3 positionWorld) const;
    dvec3 backwards() const { return backwards_; }  ///< (0, 0, 1) of view space; V of an infinite viewer
    double nearest() const { return nearest_; }     ///< metres; what is nearer isn't drawn
    double farthest() const { return farthest_; }   ///< metres; infinite for a perspective camera

private:
    dmat4 worldFromView_;
    dvec3 eyeWorld_, backwards_;
    dvec2 extent_;
    dvec2 halfSize_;  ///< of the picture; perspective: at depth 1
    bool orthographic_;
    double nearest_, farthest_;
};

}  // namespace luciole::reference
