#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <luciole/renderer.hpp>

namespace luciole::render {

/// What the camera sees, as far as light has to be there.
class SeenSpace {
public:
    explicit SeenSpace(const View& view)
        : viewFromWorld_(inverse(dmat4(view.camera.worldFromView))), eye_(view.camera.worldFromView[3]), orthographic_(view.camera.orthographic) {
        const double aspect = double(view.extent.x) / view.extent.y;
        const double half = orthographic_ ? view.camera.halfHeight : std::tan(0.5 * view.camera.yFov);
        width_ = {half * aspect, half};
        pixels_ = 0.5 * view.extent.y / half;
    }
    /// Whether some of the points' hull may be seen.
    bool meets(std::span<const dvec3> points) const {
        std::array<bool, 5> allOutside{true, true, true, true, true};
        for (const dvec3& point : points) {
            const dvec3 p(viewFromWorld_ * dvec4(point, 1));
            const double scale = orthographic_ ? 1 : -p.z;
            const dvec2 most = width_ * scale;
            allOutside[0] &= p.x > most.x;
            allOutside[1] &= -p.x > most.x;
            allOutside[2] &= p.y > most.y;
            allOutside[3] &= -p.y > most.y;
            allOutside[4] &= p.z > 0;
        }
        return std::ranges::count(allOutside, true) == 0;
    }
    bool meets(dvec4 ball) const {
        const dvec3 p(viewFromWorld_ * dvec4(dvec3(ball), 1));
        if (p.z > ball.w) return false;
        const dvec2 beyond = dvec2(std::abs(p.x), std::abs(p.y)) - width_ * (orthographic_ ? 1.0 : -p.z);
        const dvec2 slope = orthographic_ ? dvec2(1) : sqrt(1.0 + width_ * width_);
        return beyond.x <= ball.w * slope.x && beyond.y <= ball.w * slope.y;
    }
    /// Pixels that a metre at a point is high, the point no nearer than `least` metres.
    double pixelsPerMetre(dvec3 point, double least) const { return orthographic_ ? pixels_ : pixels_ / std::max({distance(point, eye_), least, 1e-6}); }

private:
    dmat4 viewFromWorld_;
    dvec3 eye_;
    bool orthographic_;
    dvec2 width_;
    double pixels_;
};

}  // namespace luciole::render
