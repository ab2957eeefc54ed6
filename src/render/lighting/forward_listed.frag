#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/forward.glsl"
#include "render/lighting/light_index.shared.h"

layout(set = 1, binding = kPassStorage + kIndexOrder, scalar) readonly buffer Order { uint order[]; };
layout(set = 1, binding = kPassStorage + kIndexOffsets, scalar) readonly buffer Offsets { uint offsets[]; };
layout(set = 1, binding = kPassStorage + kIndexEntries, scalar) readonly buffer Entries { uint entries[]; };
layout(push_constant, scalar) uniform Push { LightSlice rest; };  // of the order: lights that no list holds

// Light-indexed deferred rendering with a list of any length for each pixel.
void main() {
    beginSurface();
    shadowsAsked = !usesLights(kShadowsByIndex);
    const uint pixel = uint(gl_FragCoord.y) * uint(view.extent.x) + uint(gl_FragCoord.x);
    const uint end = min(offsets[pixel + 1u], uint(entries.length()));
    for (uint i = offsets[pixel]; i < end; ++i) addLight(lightAt(entries[i]));
    for (uint i = 0u; i < rest.count; ++i) addLight(lightAt(order[rest.first + i]));
    endSurface();
}
