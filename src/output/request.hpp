#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <luciole/renderer.hpp>

namespace luciole {

inline constexpr uint32_t kMaxPictureSide = 16384;  ///< pixels

/// What every renderer refuses before it starts.
/// \throws Error(usage) for a size outside [1, kMaxPictureSide], a camera that breaks a rule of scene.hpp or an unknown AOV
void checkRequest(const View& view, const std::vector<std::string>& aovs);

/// Whether a layer tells of lists of lights, which only some techniques make.
bool isListLayer(const std::string& aov);

inline constexpr float kWidestBounce = 1.4f;  ///< radians; beyond, the square around the cone is much larger than the cone

/// What keeps a light from bouncing; empty: nothing does.
std::string whyNoBounce(const Light& light);

/// The light whose bounce the settings ask for, an index into `lights`.
/// \throws Error(usage) if there is no such light, or if it can't bounce: all but spot lights with an outer cone angle below
///         kWidestBounce, bounded by no mesh, that light more than highlights
std::optional<uint32_t> bouncingLight(std::span<const Light> lights, const RenderSettings& settings);

}  // namespace luciole
