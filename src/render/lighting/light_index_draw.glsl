// Fragments of light volumes: which light, and whether it hits the pixel. Variant MULTISAMPLED: each sample by itself.
#ifndef LUCIOLE_LIGHT_INDEX_DRAW_GLSL
#define LUCIOLE_LIGHT_INDEX_DRAW_GLSL
#include "render/geometry/gbuffer.glsl"
#include "render/lighting/light_index.shared.h"
#include "render/shaders/illuminate.glsl"

layout(constant_id = 3) const uint kKind = 0u;       // IndexPacking
layout(constant_id = 4) const uint kIndexBits = 8u;
layout(constant_id = 5) const uint kEntryBits = 2u;
layout(constant_id = 6) const uint kPerPass = 4u;
layout(constant_id = 7) const uint kPasses = 1u;
layout(constant_id = 8) const uint kImages = 1u;
layout(constant_id = 9) const uint kUnit = 255u;
layout(constant_id = 10) const uint kSurfaces = 1u;  // 1: lights that reach the surface; 0: all on the way there
layout(constant_id = 12) const uint kGuarded = 0u;   // the stencil counts the lights of each pixel

layout(constant_id = 13) const uint kShadowed = kIndexLitOrNot;

layout(location = 0) flat in uint lightIndex;
layout(location = 1) flat in uint index;  // what stands for it in the images
layout(location = 2) flat in vec4 positionRange;
layout(location = 3) flat in vec4 directionCosOuter;
layout(location = 4) flat in uvec2 typeVolume;

#ifdef MULTISAMPLED
layout(set = 1, binding = kIndexDepth) uniform sampler2DMS depths;
#else
layout(set = 1, binding = kIndexDepth) uniform sampler2D depths;
#endif

#ifdef MULTISAMPLED
vec2 sampleHere() { return floor(gl_FragCoord.xy) + gl_SamplePosition; }
float surfaceDepth() { return texelFetch(depths, ivec2(gl_FragCoord.xy), gl_SampleID).x; }
#else
vec2 sampleHere() { return gl_FragCoord.xy; }
float surfaceDepth() { return texelFetch(depths, ivec2(gl_FragCoord.xy), 0).x; }
#endif

vec3 surfaceAt(ivec2 step_) {
    const ivec2 pixel = clamp(ivec2(gl_FragCoord.xy) + step_, ivec2(0), ivec2(view.extent) - 1);
#ifdef MULTISAMPLED
    const float depth = texelFetch(depths, pixel, gl_SampleID).x;
#else
    const float depth = texelFetch(depths, pixel, 0).x;
#endif
    return unpackPosition(vec3((vec2(pixel) + fract(sampleHere())) / view.extent, depth));
}

// To the neighbour that the surface is more likely to go on to: the nearer one.
vec3 alongSurface(vec3 P, ivec2 step_) {
    const vec3 on = surfaceAt(step_) - P, back = P - surfaceAt(-step_);
    const float onSquared = dot(on, on), backSquared = dot(back, back);
    return onSquared > 0.0 && (onSquared < backSquared || backSquared == 0.0) ? on : back;
}

// How much of the light its shadow leaves at a position. What normal the surface has, only the depth of its neighbours tells.
float lightArrives(vec3 P) {
    const vec3 N = cross(alongSurface(P, ivec2(1, 0)), alongSurface(P, ivec2(0, 1)));
    const LightConstants light = lightAt(lightIndex);
    return unshadowed(light, P, N * inversesqrt(max(dot(N, N), 1e-30)), arrivalAt(light, P).L);
}

// Whatever it is linked to: whose surface it is, the depth does not tell.
bool hits() {
    const float depth = surfaceDepth();
    // A stencil that does not let a light through counts it before the depth test, hidden or not: so it is tested here.
    if (kSurfaces == 0u) return kGuarded == 0u || gl_FragCoord.z >= depth;
    const vec3 P = unpackPosition(vec3(sampleHere() / view.extent, depth));
    LightConstants light;
    light.position = positionRange.xyz;
    light.range = positionRange.w;
    light.direction = directionCosOuter.xyz;
    light.cosOuter = directionCosOuter.w;
    light.type = typeVolume.x;
    light.volume = typeVolume.y;
    light.linkGroup = kNoIndex;
#ifdef MULTISAMPLED
    light.range *= 1.00001;  // the surface finds its position by itself
    light.cosOuter -= 1e-5;
#endif
    return depth > 0.0 && reaches(light, P, 0u) && (kShadowed != kIndexIfLit || lightArrives(P) >= 0.5);
}
#endif
