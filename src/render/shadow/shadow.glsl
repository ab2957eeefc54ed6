// Forward shadow mapping (Calver 2003, "Shadow Maps"): a surface's position is warped into the space of a light's shadow map, and its depth
// compared with the one that the map holds there. How maps come to be: shadow_plan.hpp, shadow_maps.hpp.
#ifndef LUCIOLE_SHADOW_GLSL
#define LUCIOLE_SHADOW_GLSL
#include "render/shaders/frame.glsl"
#include "render/shadow/shadow.shared.h"

layout(set = 0, binding = 13, scalar) readonly buffer ShadowedLights { uint shadowedLights[]; };
layout(set = 0, binding = 16, scalar) uniform UniformShadowedLights { uint uniformShadowedLights[kUniformLights]; };
layout(set = 0, binding = 14, scalar) readonly buffer ShadowMaps { ShadowMap shadowMaps[]; };
layout(set = 0, binding = 14, scalar) readonly buffer ShadowMask { uint shadowMask[]; };  // instead, with shadow volumes
layout(set = 0, binding = 15) uniform sampler2D shadowAtlas;

bool shadowsAsked = true;  // by lights that are shaded from here on

// Metres by which rounding and the G-buffer's layout may have moved a surface (viewSlack in tables.cpp); where vertices are snapped to moves it
// along its own plane.
float surfaceSlack(vec3 P) {
    const float dist = length(P);
    const float rounding = kLayout == 1u ? 1e-3 : 4e-6;  // floatPosition keeps halves
    return view.orthographic != 0u ? view.slack.x : dist * (rounding + dist * view.slack.z);
}

// Whether light arrives at what lies at a depth, as far as the texel at `at` tells.
float litAt(ShadowPage page, float depth, vec2 at) {
    const float reach = 0.5 * page.side - 0.5;  // to the centres of the outermost texels
    const ivec2 texel = ivec2(clamp(at, page.center - reach, page.center + reach));
    return depth >= texelFetch(shadowAtlas, texel, 0).x ? 1.0 : 0.0;
}

// PCF4SampleShadowMap: percentage-closer filtering with four taps on a grid that is turned, so that no two are in line.
float jitteredSample(ShadowPage page, float depth, vec2 at) {
    const vec2 jitter = vec2(0.25, 0.75) * page.softness;
    return 0.25 * (litAt(page, depth, at + vec2(-jitter.x, -jitter.y)) + litAt(page, depth, at + vec2(jitter.y, -jitter.x)) +
                   litAt(page, depth, at + vec2(jitter.x, jitter.y)) + litAt(page, depth, at + vec2(-jitter.y, jitter.x)));
}

// Percentage-closer filtering with a box of 3 texels times the softness, every texel weighted by how much of it the box holds, so that
// shadows neither step nor sparkle (after Castano 2013, "Shadow Mapping Summary", where the weights are those of bilinear taps).
float smoothSample(ShadowPage page, float depth, vec2 at) {
    const float width = max(2.0 * kSmoothReach * page.softness, 0.01);
    const float reach = 0.5 * (width + 1.0);
    const float most = min(width, 1.0);
    const vec2 first = ceil(at - 0.5 - reach) + 0.5, last = at + reach;
    float lit = 0.0, weights = 0.0;
    for (float y = first.y; y < last.y; y += 1.0)
        for (float x = first.x; x < last.x; x += 1.0) {
            const vec2 share = clamp(reach - abs(vec2(x, y) - at), 0.0, most);
            lit += share.x * share.y * litAt(page, depth, vec2(x, y));
            weights += share.x * share.y;
        }
    return lit / weights;
}

// Where a vector points to in a map's space: across, down and along its axis.
vec3 warped(uint i, uint face, bool cube, vec3 v) {
    if (cube) return inCubeFace(face, v);
    return vec3(dot(shadowMaps[i].right, v), dot(shadowMaps[i].down, v), dot(shadowMaps[i].forward, v));
}

// The last of these alone.
float along(uint i, uint face, bool cube, vec3 v) { return cube ? alongCubeFace(face, v) : dot(shadowMaps[i].forward, v); }

// Of the cascades the first that holds the position.
uint cascadeOf(uint first, uint count, vec3 P) {
    for (uint i = first; i < first + count; ++i) {
        const vec3 Q = P - shadowMaps[i].origin;
        const vec2 at = shadowMaps[i].scale * vec2(dot(shadowMaps[i].right, Q), dot(shadowMaps[i].down, Q));
        if (shadowMaps[i].page != 0u && max(abs(at.x), abs(at.y)) < 0.5 * unpackPage(shadowMaps[i].page).side - 0.5) return i;
    }
    return first + count - 1u;
}

// Whether shadow volumes hide the pixel's surface from a light. WITHOUT_PIXELS: there is none, in a compute shader.
bool isMarked(uint light) {
#ifdef WITHOUT_PIXELS
    return false;
#else
    const uint pixel = uint(gl_FragCoord.y) * uint(view.extent.x) + uint(gl_FragCoord.x);
    return (shadowMask[pixel * view.shadowMaskWords + light / 32u] >> (light % 32u) & 1u) != 0u;
#endif
}

// The share of a light that arrives at P, where the surface has normal N; L to the light.
float unshadowed(LightConstants light, vec3 P, vec3 N, vec3 L) {
    const uint maps = usesLights(kUsesUniformLights) ? uniformShadowedLights[light.sceneIndex] : shadowedLights[light.sceneIndex];
    const uint count = maps & ((1u << kShadowCountBits) - 1u);
    if (count == 0u) return 1.0;
    if (usesLights(kShadowsStencilled)) return isMarked(maps >> kShadowCountBits) ? 0.0 : 1.0;
    const bool directional = usesLights(kUsesDirectional) && light.type == kLightDirectional;
    const bool cube = !directional && (!usesLights(kUsesSpot) || count == kShadowCubeFaces);
    vec3 Q = P - light.position;
    const uint face = cubeFaceOf(Q);
    uint i = maps >> kShadowCountBits;
    if (cube) i += face;
    if (directional) i = cascadeOf(i, count, P);
    if (directional || usesLights(kShadowsWait)) Q = P - shadowMaps[i].origin;
    const uint packed = shadowMaps[i].page;
    if (packed == 0u) return 1.0;
    const ShadowPage page = unpackPage(packed);
    float scale = 0.5 * page.side - pageBorder(page.side);
    if (!cube) scale = shadowMaps[i].scale;
    // Towards the light by what rounding and the G-buffer may have moved the surface, and off the surface, on the side that the light is on, by
    // as much as brings it before its own plane at the farthest texel that is asked (Holbert 2011, "Normal Offset Shadows"). Beyond a crease,
    // that one belongs to another plane, whose slope did not bias it enough.
    const float w = along(i, face, cube, Q), nz = along(i, face, cube, N);
    const float texel = (directional ? 1.0 : w) / scale;
    const float reach = usesLights(kShadowsSmooth) ? kSmoothReach : usesLights(kShadowsJittered) ? kJitteredReach : 0.0;
    const float offset = kNormalOffset * (0.5 + reach * page.softness) * texel * sqrt(max(1.0 - nz * nz, 0.0));
    Q += L * (kShadowBias * texel + surfaceSlack(P)) + N * (dot(N, L) < 0.0 ? -offset : offset);
    const vec3 pinShadow = warped(i, face, cube, Q);
    const float perW = directional ? 1.0 : 1.0 / max(pinShadow.z, 1e-9);
    const float depth = directional ? 1.0 - pinShadow.z * shadowMaps[i].fall : kShadowMapNear * perW;
    const vec2 at = page.center + scale * perW * pinShadow.xy;
    if (usesLights(kShadowsSmooth)) return smoothSample(page, depth, at);
    if (usesLights(kShadowsJittered)) return jitteredSample(page, depth, at);
    return litAt(page, depth, at);
}
#endif
