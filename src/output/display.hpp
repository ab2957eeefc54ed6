#pragma once
#include <luciole/image.hpp>
#include <luciole/settings.hpp>

namespace luciole {

/// Linear radiance (3 channels) to the picture in [0, 1] that is shown: exposure, tone mapping, sRGB encoding.
/// The same functions that the GPU's post phase compiles (tone_map.shared.h).
Image displayImage(const Image& radiance, float exposureEv, ToneMap toneMap);

}  // namespace luciole
