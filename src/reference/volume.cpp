#include "reference/volume.hpp"

#include <cmath>
#include <limits>

namespace luciole::reference {
namespace {

/// A sum of angles as a direction and whole turns: z is a positive multiple of exp(i angle), the sum angle + 2 pi turns
/// with angle in [-pi, pi]. Adding is a product of complex numbers, which spares each triangle its arc tangent.
struct AngleSum {
    double re = 1, im = 0;
    int turns = 0;

    /// Adds the angle of (x, y), in [-pi, pi].
    void add(double x, double y) {
        const double newRe = re * x - im * y, newIm = re * y + im * x;
        const double scale = std::abs(newRe) + std::abs(newIm);
        if (!(scale > 0)) return;  // the point is a vertex
        // Two angles of [0, pi] make one of [0, 2 pi]: past pi if it points down. Likewise below.
        if (im >= 0 && y >= 0 && newIm < 0) ++turns;
        if (im < 0 && y < 0 && newIm >= 0) --turns;
        re = newRe / scale;
        im = newIm / scale;
    }
};

}  // namespace

Volume::Volume(const LightVolume& volume)
    : low_(std::numeric_limits<double>::infinity()), high_(-std::numeric_limits<double>::infinity()) {
    for (size_t i = 0; i < volume.indices.size(); i += 3) {
        std::array<dvec3, 3>& triangle = triangles_.emplace_back();
        for (size_t k = 0; k < 3; ++k) {
            triangle[k] = dvec3(volume.positionsWorld[volume.indices[i + k]]);
            low_ = min(low_, triangle[k]);
            high_ = max(high_, triangle[k]);
        }
    }
}

bool Volume::contains(dvec3 positionWorld) const {
    const dvec3 p = positionWorld;
    if (p.x < low_.x || p.y < low_.y || p.z < low_.z || p.x > high_.x || p.y > high_.y || p.z > high_.z) return false;
    return windingNumber(p) != 0;
}

// van Oosterom and Strackee 1983, "The Solid Angle of a Plane Triangle", eq. 8: tan(solid angle / 2). The solid angles of
// a closed surface add up to 4 pi w, so their halves to w whole turns.
int Volume::windingNumber(dvec3 positionWorld) const {
    AngleSum halfAngles;
    for (const auto& triangle : triangles_) {
        const dvec3 a = triangle[0] - positionWorld, b = triangle[1] - positionWorld, c = triangle[2] - positionWorld;
        const double la = length(a), lb = length(b), lc = length(c);
        halfAngles.add(la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb, dot(a, cross(b, c)));
    }
    // What is left of the angle is rounding, unless the point lies on the surface: then half a turn at most.
    return halfAngles.turns;
}

std::vector<Volume> volumesOf(const Scene& scene) {
    return {scene.lightVolumes.begin(), scene.lightVolumes.end()};
}

}  // namespace luciole::reference
