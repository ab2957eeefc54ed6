#pragma once
#include <vector>

#include "scene/builtin/scenes.hpp"

namespace luciole {

/// Measures of the hall, metres. The nave runs from z = 0 to z = -kBay * bays, its axis is x = 0, the floor y = 0.
namespace hall {
inline constexpr float kBay = 4.5f;         ///< length of a bay
inline constexpr float kColumnX = 4.0f;     ///< axes of the columns, which stand at both ends of each bay
inline constexpr float kWallX = 8.0f;       ///< faces of the outer walls
inline constexpr float kSpring = 4.6f;      ///< top of the columns
inline constexpr float kAisleTop = 6.9f;    ///< ceiling of the aisles
inline constexpr float kCornice = 7.6f;     ///< where the vault begins
inline constexpr float kHalfArcade = 0.4f;  ///< half the thickness of the walls that the columns carry
inline constexpr float kNaveX = kColumnX - kHalfArcade;
inline constexpr float kTop = kCornice + kNaveX;
inline constexpr float kLampRadius = 0.03f;
}  // namespace hall

/// Upright cylinder around something solid that stands on the floor.
struct HallSolid {
    vec2 centre;  ///< x, z
    float radius;
    float top;
};

/// Hangs `options.lights` lights of about intensity 1 in the hall, none of them within a solid or close to `eye`.
/// \param lamps so many lights, the first ones, get a small glowing body
void addHallLights(Scene& scene, const HallOptions& options, int bays, const std::vector<HallSolid>& solids, vec3 eye,
                   uint32_t lamps);

}  // namespace luciole
