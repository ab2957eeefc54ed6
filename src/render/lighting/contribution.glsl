// What a lighting pass adds to its target for one light at one pixel: light, or, in the passes that count, (1, whether the
// light reaches the surface, the light's fingerprint if so).
#ifndef LUCIOLE_CONTRIBUTION_GLSL
#define LUCIOLE_CONTRIBUTION_GLSL
#include "output/fingerprint.shared.h"
#include "render/geometry/gbuffer_read.glsl"
#include "render/shaders/illuminate.glsl"

vec4 contribution(ShadingPoint p, LightConstants light) {
    const bool surface = p.s.material != 0u;  // where there is none, its position may be infinitely far, or no number
    if (!usesLights(kCountsLights)) return vec4(surface ? illuminate(p, light) : vec3(0), 0);
    const bool useful = surface && reaches(light, p.s.P, p.s.objectId);
    return vec4(1, useful, useful ? fingerprint(light.sceneIndex) : 0u, 0);
}
#endif
