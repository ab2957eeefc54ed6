// Forward shading: a surface is lit where it is drawn, so that nothing of it is stored. A technique's shader calls beginSurface, addLight
// for each light that it finds, and endSurface. Variants: MULTISAMPLED, several samples a pixel; COUNTING, which adds up what is
// evaluated in a buffer instead of light.
#ifndef LUCIOLE_FORWARD_GLSL
#define LUCIOLE_FORWARD_GLSL
#include "output/fingerprint.shared.h"
#include "render/geometry/gbuffer.glsl"
#include "render/geometry/surface_shading.glsl"
#include "render/lighting/forward.shared.h"
#include "render/shaders/illuminate.glsl"
#include "render/shaders/samples.glsl"

layout(constant_id = 6) const uint kFirst = 1u;    // ambience and emission are added, too
layout(constant_id = 7) const uint kBlended = 0u;  // alpha says how much of the surface is there

#ifdef COUNTING
layout(early_fragment_tests) in;  // what is hidden does not count
layout(set = 1, binding = kPassStorage + kForwardCounts, scalar) buffer Counts { uint counts[]; };  // [pixel][kForwardCounters]
uvec3 counted = uvec3(0);
#else
layout(location = 0) out vec4 radiance;
#endif
#ifdef MULTISAMPLED
layout(set = 1, binding = kForwardDepth) uniform sampler2DMS depthSamples;
#endif

ShadingPoint point;
float shadingDepth;  // of the surface, as the depth buffer has it
float alpha;
vec3 sum = vec3(0);

#ifdef MULTISAMPLED
// Vulkan 1.3, "Multisampling", standard sample locations of 4 samples.
const vec2 kSamplePositions[4] = vec2[](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));

// Of the samples that the triangle covers the first one at which it is seen. Its depth there is computed from its position, so it is as
// good as equal to the stored one.
int visibleSample() {
    int best = 0;
    float bestBehind = 2.0;
    for (uint covered = uint(gl_SampleMaskIn[0]); covered != 0u; covered &= covered - 1u) {
        const int i = firstSample(covered);
        const vec4 clip = view.clipFromView * vec4(interpolateAtSample(positionView, i), 1);
        const float stored = texelFetch(depthSamples, ivec2(gl_FragCoord.xy), i).x;
        const float behind = max(stored * (1.0 - 4e-6) - clip.z / clip.w, 0.0);
        if (behind < bestBehind) {
            best = i;
            bestBehind = behind;
        }
    }
    return best;
}
#endif

void beginSurface() {
#ifdef MULTISAMPLED
    shadingSample = visibleSample();
#endif
    Surface s = surfaceHere(alpha);
    const MaterialConstants m = material.lit;
    s.Cs0 *= m.cs0Scale;
    s.Cs1 *= m.cs1Scale;
    s.N = shadingFromView(s.N);
    // As whoever only knows its depth.
#ifdef MULTISAMPLED
    const vec2 at = floor(gl_FragCoord.xy) + kSamplePositions[shadingSample];
    shadingDepth = kBlended != 0u ? depthOf(s.P) : texelFetch(depthSamples, ivec2(gl_FragCoord.xy), shadingSample).x;
#else
    const vec2 at = gl_FragCoord.xy;
    shadingDepth = gl_FragCoord.z;
#endif
    s.P = unpackPosition(vec3(at / view.extent, shadingDepth));
    point = shadingPoint(s, m);
    if (kFirst != 0u) sum = initialLight(s, m);
}

// `lit`: the share of the light that is known to arrive, besides its shadow.
void addLight(LightConstants light, float lit) {
#ifdef COUNTING
    const bool useful = reaches(light, point.s.P, point.s.objectId);
    counted += uvec3(1u, useful, useful ? fingerprint(light.sceneIndex) : 0u);
#else
    sum += lit * illuminate(point, light);
#endif
}
void addLight(LightConstants light) { addLight(light, 1.0); }

void endSurface() {
#ifdef COUNTING
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    const uint first = (pixel.y * uint(view.extent.x) + pixel.x) * kForwardCounters;
    for (uint i = 0u; i < kForwardCounters; ++i) atomicAdd(counts[first + i], counted[i]);
#else
    const float here = kBlended != 0u ? alpha : 1.0;
    radiance = vec4(sum * here, kFirst != 0u ? here : 0.0);
#endif
}
#endif
