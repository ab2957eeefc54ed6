#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <luciole/renderer.hpp>

/// The small pictures that a device's coefficients are measured on. Needs no device.
namespace luciole::render {

/// What shaders are made for, as far as it changes what a light or a pixel costs: each variant has coefficients of its own.
struct CostVariant {
    RenderSettings settings;   ///< without those that are data
    uint32_t equations = 0;    ///< bit e: some material uses equation e
    bool uniformLights = true; ///< all lights fit into a uniform buffer
    std::string key() const;   ///< one line that tells variants apart
};

struct CalibrationView {
    Scene scene;
    View view;
};
/// Halls: few lights and many, few that reach a pixel and many, few triangles and many, seen from inside and from outside, with surfaces
/// that blend and without, in pictures of several sizes.
std::vector<CalibrationView> calibrationViews(const CostVariant& variant);

/// So often all techniques take their turn with a picture, one soon after the other, as GPUs change their clocks; the fastest frame counts.
inline constexpr uint32_t kCalibrationRounds = 2;
inline constexpr double kCalibrationMs = 6;           ///< of frames that are measured, in each turn
inline constexpr double kMostCalibrationPairs = 4e6;  ///< of a light and a pixel: beyond, techniques that evaluate all are left out

}  // namespace luciole::render
