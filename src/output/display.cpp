#include "output/display.hpp"

#include <cmath>

#include "output/tone_map.shared.h"

namespace luciole {

static_assert(shared::kToneMapNone == uint32_t(ToneMap::none));
static_assert(shared::kToneMapReinhard == uint32_t(ToneMap::reinhard));
static_assert(shared::kToneMapAces == uint32_t(ToneMap::aces));
static_assert(shared::kToneMapAgx == uint32_t(ToneMap::agx));

Image displayImage(const Image& radiance, float exposureEv, ToneMap toneMap) {
    Image display(radiance.width, radiance.height, 3);
    const float exposure = std::exp2(exposureEv);
    for (size_t i = 0; i + 2 < display.data.size(); i += 3) {
        const vec3 exposed = exposure * vec3(radiance.data[i], radiance.data[i + 1], radiance.data[i + 2]);
        const vec3 color = shared::displayColor(exposed, uint32_t(toneMap));
        for (int c = 0; c < 3; ++c) display.data[i + size_t(c)] = color[c];
    }
    return display;
}

}  // namespace luciole
