// Which texels of a light a scene needs. Read by both compilers.
#ifndef LUCIOLE_LIGHT_TEXELS_SHARED_H
#define LUCIOLE_LIGHT_TEXELS_SHARED_H
#include "render/shaders/types.shared.h"
SHARED_BEGIN
const uint kNeedsRows = kUsesCurves | kUsesVolumes | kUsesLinks;
const uint kNeedsKinds = kUsesSpot | kUsesDirectional | kUsesCurves | kUsesVolumes | kUsesContributions | kUsesLambertian | kCountsLights | kUsesShadows;
// \param features of the scene, kUses*
SHARED_FN uint texelsOfLight(uint features) {
    if ((features & kNeedsRows) != 0u) return 5u;
    return (features & kNeedsKinds) != 0u ? 4u : 2u;
}
SHARED_END
#endif
