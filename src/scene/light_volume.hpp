#pragma once
#include <optional>
#include <string>

#include <luciole/scene.hpp>

namespace luciole {

/// A rule of LightVolume that is broken.
struct VolumeFault {
    std::string field, expected, got;
};

/// The first broken rule of a volume with at most kMaxVolumeTriangles triangles, which the caller has checked.
std::optional<VolumeFault> faultOf(const LightVolume& volume);

}  // namespace luciole
