// What a lighting pass adds to its target for one light at one pixel: light, or, in the passes that count, (1, whether the
// light reaches the surface, the light's fingerprint if so).
#ifndef LUCIOLE_CONTRIBUTION_GLSL
#define LUCIOLE_CONTRIBUTION_GLSL
#include "output/fingerprint.shared.h"
#include "render/geometry/gbuffer_read.glsl"
#include "render/shaders/illuminate.glsl"

vec4 contribution(ShadingPoint p, LightConstants light) {
    if (!usesLights(kCountsLights)) return vec4(illuminate(p, light), 0);
    const bool useful = p.s.material != 0u && reaches(light, p.s.P, p.s.objectId);
    return vec4(1, useful, useful ? fingerprint(light.sceneIndex) : 0u, 0);
}
#endif
