// What a lighting pass adds to its target for one light at one pixel: light, or, in the passes that count, (1, whether the
// light reaches the surface, the light's fingerprint if so).
#ifndef LUCIOLE_CONTRIBUTION_GLSL
#define LUCIOLE_CONTRIBUTION_GLSL
#include "output/fingerprint.shared.h"
#include "render/shaders/illuminate.glsl"

// Where there is no surface, its position may be infinitely far, or no number.
bool isSurface(ShadingPoint p) { return p.s.seen; }

vec4 countOf(ShadingPoint p, LightConstants light) {
    const bool useful = isSurface(p) && reaches(light, p.s.P, p.s.objectId);
    return vec4(1, useful, useful ? fingerprint(light.sceneIndex) : 0u, 0);
}

// One light's share of a sum, which `sumOf` ends: it leaves nothing where there is no surface.
vec4 addend(ShadingPoint p, LightConstants light) {
    if (usesLights(kCountsLights)) return countOf(p, light);
    return vec4(illuminate(p, light), 0);
}
vec4 sumOf(ShadingPoint p, vec4 addends) { return usesLights(kCountsLights) || isSurface(p) ? addends : vec4(0); }

vec4 contribution(ShadingPoint p, LightConstants light) { return sumOf(p, addend(p, light)); }
#endif
