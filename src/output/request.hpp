#pragma once
#include <string>
#include <vector>

#include <luciole/renderer.hpp>

namespace luciole {

inline constexpr uint32_t kMaxPictureSide = 16384;  ///< pixels

/// What every renderer refuses before it starts.
/// \throws Error(usage) for a size outside [1, kMaxPictureSide], a camera that breaks a rule of scene.hpp or an unknown AOV
void checkRequest(const View& view, const std::vector<std::string>& aovs);

}  // namespace luciole
