// What the lighting phase knows of shadow maps. Read by both compilers.
#ifndef LUCIOLE_SHADOW_SHARED_H
#define LUCIOLE_SHADOW_SHARED_H
#include "shared.h"
SHARED_BEGIN

// Pages have from 16 to 16,384 texels a side and lie at multiples of 16. A map shows more than its light needs by a border, for taps.
const uint kPageUnit = 16u;
SHARED_FN float pageBorder(float side) { return min(4.0f, side / 8.0f); }  // texels

// A page in one word, because a software driver loads words one by one: its place, its size and Light::shadowSoftness. 0 is no page: nothing
// keeps light off.
SHARED_FN uint packPage(uvec2 first, uint sideLog2, float softness) {
    return (sideLog2 - 3u) | uint(softness * 63.75f + 0.5f) << 4u | first.x / kPageUnit << 12u | first.y / kPageUnit << 22u;
}
struct ShadowPage {
    float side;      // texels
    float softness;
    vec2 center;     // texels
};
SHARED_FN ShadowPage unpackPage(uint page) {
    ShadowPage result;
    result.side = float(8u << (page & 15u));
    result.softness = float(page >> 4u & 255u) / 63.75f;
    result.center = vec2(page >> 12u & 1023u, page >> 22u) * float(kPageUnit) + 0.5f * result.side;
    return result;
}

// One shadow map. Set 0, kFrameShadowMaps. Depth is reversed: kShadowMapNear / w of lights that are somewhere, w metres along the map's axis; of
// directional ones from 1 at the first object to 0 behind the last. Of a cube's faces only `page` is looked at, and
// the origin of local lights only with kShadowsWait.
struct ShadowMap {
    uint page;
    float scale;     // texels to a metre across the axis at w = 1, of directional lights anywhere
    vec3 right;      // the warp matrix, without what the page does: across, down and along the axis, unit
    vec3 down;
    vec3 forward;
    vec3 origin;     // the light, directional: the middle of the nearest side; in shading space
    float fall;      // directional: of depth in a metre
};

// Of each light of the scene: how many maps it has and, in the bits above, its first one. Set 0, kFrameShadowedLights.
const uint kShadowCountBits = 3u;
const uint kShadowVolumes = 7u;    // none: its first map is its bit of each pixel's mask (shadow_volumes.hpp)
const uint kShadowCubeFaces = 6u;  // of a point light, or of a spot too wide for one map

// The face of a cube that a direction leaves through: +x, -x, +y, -y, +z, -z.
SHARED_FN uint cubeFaceOf(vec3 direction) {
    const vec3 a = abs(direction);
    const uint axis = a.x >= a.y && a.x >= a.z ? 0u : a.y >= a.z ? 1u : 2u;
    const float along = axis == 0u ? direction.x : axis == 1u ? direction.y : direction.z;
    return 2u * axis + (along > 0.0f ? 0u : 1u);
}
// A vector across, down and along the axis of a face: as a camera sees it that looks along that axis, up as lookAt has it.
SHARED_FN vec3 inCubeFace(uint face, vec3 v) {
    const float side = (face & 1u) == 0u ? 1.0f : -1.0f;
    const bool x = face < 2u, y = !x && face < 4u;
    return vec3(side * (x ? v.z : y ? v.x : -v.x), y ? -v.z : -v.y, side * (x ? v.x : y ? v.y : v.z));
}
SHARED_FN float alongCubeFace(uint face, vec3 v) { return ((face & 1u) == 0u ? 1.0f : -1.0f) * (face < 2u ? v.x : face < 4u ? v.y : v.z); }

const float kShadowMapNear = 0.01f;  // metres; luciole::kShadowNear

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
