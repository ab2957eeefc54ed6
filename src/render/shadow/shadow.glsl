// Forward shadow mapping (Calver 2003, "Shadow Maps"): a surface's position is warped into the space of a light's shadow map, and its depth
// compared with the one that the map holds there. How maps come to be: shadow_plan.hpp, shadow_maps.hpp.
#ifndef LUCIOLE_SHADOW_GLSL
#define LUCIOLE_SHADOW_GLSL
#include "render/shaders/frame.glsl"
#include "render/shadow/shadow.shared.h"

layout(set = 0, binding = 13, scalar) readonly buffer ShadowedLights { uint shadowedLights[]; };
layout(set = 0, binding = 14, scalar) readonly buffer ShadowMaps { ShadowMap shadowMaps[]; };
layout(set = 0, binding = 15) uniform sampler2D shadowAtlas;

// The face of a cube that a direction leaves through: +x, -x, +y, -y, +z, -z.
uint cubeFaceOf(vec3 direction) {
    const vec3 a = abs(direction);
    if (a.x >= a.y && a.x >= a.z) return direction.x > 0.0 ? 0u : 1u;
    if (a.y >= a.z) return direction.y > 0.0 ? 2u : 3u;
    return direction.z > 0.0 ? 4u : 5u;
}

// Metres by which rounding and the G-buffer's layout may have moved a surface (viewSlack in tables.cpp); where vertices are snapped to moves it
// along its own plane.
float surfaceSlack(vec3 P) {
    const float dist = length(P);
    const float rounding = kLayout == 1u ? 1e-3 : 4e-6;  // floatPosition keeps halves
    return view.orthographic != 0u ? view.slack.x : dist * (rounding + dist * view.slack.z);
}

// Whether light arrives at what is warped to `pinShadow`, as far as the texel at `at` tells.
float litAt(ShadowMap map, vec4 pinShadow, vec2 at) {
    const float depth = texelFetch(shadowAtlas, ivec2(clamp(at, map.low, map.high)), 0).x;
    return pinShadow.z >= depth * pinShadow.w ? 1.0 : 0.0;
}

// PCF4SampleShadowMap: percentage-closer filtering with four taps on a grid that is turned, so that no two are in line.
float jitteredSample(ShadowMap map, vec4 pinShadow, vec2 at) {
    const vec2 jitter = vec2(0.25, 0.75) * map.softness;
    return 0.25 * (litAt(map, pinShadow, at + vec2(-jitter.x, -jitter.y)) + litAt(map, pinShadow, at + vec2(jitter.y, -jitter.x)) +
                   litAt(map, pinShadow, at + vec2(jitter.x, jitter.y)) + litAt(map, pinShadow, at + vec2(-jitter.y, jitter.x)));
}

// Percentage-closer filtering with a box of 3 texels times the softness, every texel weighted by how much of it the box holds, so that
// shadows neither step nor sparkle (after Castano 2013, "Shadow Mapping Summary", where the weights are those of bilinear taps).
float smoothSample(ShadowMap map, vec4 pinShadow, vec2 at) {
    const float width = max(2.0 * kSmoothReach * map.softness, 0.01);
    const float reach = 0.5 * (width + 1.0);
    const float most = min(width, 1.0);
    const vec2 first = ceil(at - 0.5 - reach) + 0.5, last = at + reach;
    float lit = 0.0, weights = 0.0;
    for (float y = first.y; y < last.y; y += 1.0)
        for (float x = first.x; x < last.x; x += 1.0) {
            const vec2 share = clamp(reach - abs(vec2(x, y) - at), 0.0, most);
            lit += share.x * share.y * litAt(map, pinShadow, vec2(x, y));
            weights += share.x * share.y;
        }
    return lit / weights;
}

// Of the cascades the first that holds the position.
uint cascadeOf(uint first, uint count, vec3 P) {
    for (uint i = first; i < first + count; ++i) {
        const vec2 at = (shadowMaps[i].warp * vec4(P, 1)).xy;
        if (shadowMaps[i].texel > 0.0 && all(greaterThan(at, shadowMaps[i].low)) && all(lessThan(at, shadowMaps[i].high))) return i;
    }
    return first + count - 1u;
}

// The share of a light that arrives at P, where the surface has normal N and the light lies in direction L.
float unshadowed(LightConstants light, vec3 P, vec3 N, vec3 L) {
    const uint maps = shadowedLights[light.sceneIndex];
    const uint count = maps & ((1u << kShadowCountBits) - 1u);
    if (count == 0u) return 1.0;
    uint i = maps >> kShadowCountBits;
    const bool directional = light.type == kLightDirectional;
    vec3 Q = directional ? P : P - light.position;
    if (directional) i = cascadeOf(i, count, Q);
    else if (count == kShadowCubeFaces) i += cubeFaceOf(Q);
    const ShadowMap map = shadowMaps[i];
    if (map.texel == 0.0) return 1.0;
    vec4 pinShadow = map.warp * vec4(Q, 1);
    // Towards the light by what rounding and the G-buffer may have moved the surface, and off the surface, on the side that the light is on, by
    // as much as brings it before its own plane at the farthest texel that is asked (Holbert 2011, "Normal Offset Shadows"). Beyond a crease,
    // that one belongs to another plane, whose slope did not bias it enough.
    const float texel = map.texel * max(pinShadow.w, 0.0);
    const float reach = usesLights(kShadowsSmooth) ? kSmoothReach : usesLights(kShadowsJittered) ? kJitteredReach : 0.0;
    const vec3 axis = directional ? L : vec3(map.warp[0].w, map.warp[1].w, map.warp[2].w);  // the map's: w is how far along it
    const float slant = length(cross(N, axis));
    const vec3 off = N * (kNormalOffset * (0.5 + reach * map.softness) * texel * slant * (dot(N, L) < 0.0 ? -1.0 : 1.0));
    pinShadow += map.warp * vec4(L * (kShadowBias * texel + surfaceSlack(P)) + off, 0);
    const vec2 at = pinShadow.xy / max(pinShadow.w, 1e-9);
    if (usesLights(kShadowsSmooth)) return smoothSample(map, pinShadow, at);
    if (usesLights(kShadowsJittered)) return jitteredSample(map, pinShadow, at);
    return litAt(map, pinShadow, at);
}
#endif
