// What the lighting phase knows of shadow maps. Read by both compilers.
#ifndef LUCIOLE_SHADOW_SHARED_H
#define LUCIOLE_SHADOW_SHARED_H
#include "shared.h"
SHARED_BEGIN

// One shadow map: a page of the atlas and how to get there. Set 0, kFrameShadowMaps.
struct ShadowMap {
    mat4 warp;       // from shading space, with the light (directional: the eye) at the origin, to (u, v, depth, 1) * w; u and v in texels.
                     // Depth is reversed: kShadowNear / w of lights that are somewhere, else from 1 at the first object to 0 behind the last
    vec2 low;        // of u and v: the centres of the page's outermost texels
    vec2 high;
    float texel;     // metres, the side of a texel at w = 1; 0: nothing keeps light off here
    float softness;  // Light::shadowSoftness
};

// Of each light of the scene: how many maps it has and, in the bits above, its first one. Set 0, kFrameShadowedLights.
const uint kShadowCountBits = 3u;
const uint kShadowCubeFaces = 6u;  // of a point light, or of a spot too wide for one map

// How far along u and v from where a surface is its taps may be, in texels at softness 1, beyond the half texel that every one may be off.
const float kJitteredReach = 0.5f;
const float kSmoothReach = 1.5f;

// Slope-scaled bias, in steps of depth from texel to texel: one lets a plane at any angle be lit by its own texels.
const float kShadowSlopeBias = 1.25f;
const float kShadowBias = 0.1f;    // texels towards the light
const float kNormalOffset = 1.5f;  // diagonals of that half texel and of the reach, along the normal of a plane that the map sees edge on

// Pushed for each map that is drawn.
struct ShadowPush {
    mat4 clipFromLight;  // axes of world space, the origin at the light
    vec3 originWorld;
};
SHARED_END
#endif
