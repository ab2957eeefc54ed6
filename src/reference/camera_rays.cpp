#include "reference/camera_rays.hpp"

#include <cmath>
#include <limits>

namespace luciole::reference {

CameraRays::CameraRays(const View& view)
    : worldFromView_(view.camera.worldFromView),
      eyeWorld_(worldFromView_[3]),
      backwards_(normalize(dvec3(worldFromView_[2]))),
      extent_(view.extent),
      orthographic_(view.camera.orthographic),
      nearest_(view.camera.zNear),
      farthest_(orthographic_ ? double(view.camera.zFar) : std::numeric_limits<double>::infinity()) {
    const double halfHeight = orthographic_ ? double(view.camera.halfHeight) : std::tan(double(view.camera.yFov) / 2);
    halfSize_ = dvec2(halfHeight * extent_.x / extent_.y, halfHeight);
}

Ray CameraRays::through(uint32_t x, uint32_t y) const {
    const dvec2 ndc = (dvec2(x, y) + 0.5) / extent_ * 2.0 - 1.0;  // Y points down
    const dvec3 onPicture(ndc.x * halfSize_.x, -ndc.y * halfSize_.y, 0);
    const dvec3 forwards(0, 0, -1);
    const dmat3 rotation(worldFromView_);
    if (orthographic_) return {eyeWorld_ + rotation * onPicture, rotation * forwards};
    return {eyeWorld_, rotation * (onPicture + forwards)};
}

dvec3 CameraRays::toEye(dvec3 positionWorld) const {
    return orthographic_ ? backwards_ : normalize(eyeWorld_ - positionWorld);
}

}  // namespace luciole::reference
