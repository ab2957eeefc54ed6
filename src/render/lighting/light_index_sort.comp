#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_index.shared.h"
#include "render/shaders/frame.glsl"

layout(local_size_x = 64) in;
layout(set = 1, binding = kPassStorage + kIndexOffsets, scalar) readonly buffer Offsets { uint offsets[]; };
layout(set = 1, binding = kPassStorage + kIndexEntries, scalar) buffer Entries { uint entries[]; };

// Puts each pixel's list in the order of the lights, so that sums repeat to the bit: atomics fill it in any order, though nearly in that
// of the drawing, which is why insertion takes hardly more than one look at each.
void main() {
    const uint pixel = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
    if (pixel >= uint(view.extent.x) * uint(view.extent.y)) return;
    const uint first = offsets[pixel];
    const uint end = min(offsets[pixel + 1u], uint(entries.length()));
    for (uint i = first + 1u; i < end; ++i) {
        const uint light = entries[i];
        uint place = i;
        while (place > first && entries[place - 1u] > light) {
            entries[place] = entries[place - 1u];
            --place;
        }
        entries[place] = light;
    }
}
