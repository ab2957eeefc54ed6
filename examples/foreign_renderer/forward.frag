#version 460
#extension GL_GOOGLE_include_directive : require
layout(constant_id = 0) const uint kIndexBits = 8u;  // LightIndexer::packing()
layout(constant_id = 1) const uint kEntryBits = 2u;
layout(constant_id = 2) const uint kOverlap = 4u;
layout(constant_id = 3) const uint kImages = 1u;
layout(constant_id = 4) const uint kLoop = 0u;  // so many lights are looped over, without a look at the index images
#define LUCIOLE_SET 1
#define LUCIOLE_BINDING 0
#define LUCIOLE_PACKING uvec4(kIndexBits, kEntryBits, kOverlap, kImages)
#include "luciole/light_index.glsl"

layout(location = 0) in vec3 positionView;
layout(location = 1) in vec3 normalView;
layout(location = 2) in vec3 color;
layout(location = 0) out vec4 radiance;

// This renderer's own idea of a surface: light wraps around it.
vec3 shade(LucioleLight light) {
    const LucioleArrival arrival = lucioleArrival(light, positionView);
    return color * arrival.E * max((dot(normalView, arrival.L) + 0.5) / 1.5, 0.0);
}

void main() {
    vec3 sum = 0.05 * color;
    LucioleLights here = lucioleLights(ivec2(gl_FragCoord.xy));
    if (kLoop == 0u)
        for (uint index = lucioleNext(here); index != 0u; index = lucioleNext(here)) sum += shade(lucioleLight(index));
    else
        for (uint index = 1u; index <= kLoop; ++index) sum += shade(lucioleLight(index));
    radiance = vec4(sum, 1);
}
