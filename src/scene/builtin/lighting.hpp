#pragma once
#include <vector>

#include <luciole/scene.hpp>

/// Fits the lights of a built-in scene to what its camera sees.
namespace luciole {

/// A surface point that a pixel shows.
struct VisiblePoint {
    vec3 positionWorld;
    vec3 normalWorld;  ///< of the triangle, towards the camera
    float albedo;      ///< luminance of the base colour
};

/// What the pixels of a picture of `width` x `height` show; pixels that show nothing are left out.
std::vector<VisiblePoint> visiblePoints(const Scene& scene, const Camera& camera, uint32_t width, uint32_t height);

/// Gives all lights one range, so that `overlap` lights in the mean reach a point: nearer than the range and, of a
/// spot, inside its outer cone. Where no range does, the nearest that can be had is taken. \return the mean that was
/// reached
double fitRange(std::vector<Light>& lights, const std::vector<VisiblePoint>& points, double overlap);

/// Scales all intensities by one factor, so that the mean brightness of the lit points, each cut at 1, is `radiance`.
void fitBrightness(std::vector<Light>& lights, const std::vector<VisiblePoint>& points, double radiance);

}  // namespace luciole
