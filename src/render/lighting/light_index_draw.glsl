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

// Whatever it is linked to: whose surface it is, the depth does not tell.
bool hits() {
    const float depth = surfaceDepth();
    // A stencil that does not let a light through counts it before the depth test, hidden or not: so it is tested here.
    if (kSurfaces == 0u) return kGuarded == 0u || gl_FragCoord.z >= depth;
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
    return depth > 0.0 && reaches(light, unpackPosition(vec3(sampleHere() / view.extent, depth)), 0u);
}
#endif
