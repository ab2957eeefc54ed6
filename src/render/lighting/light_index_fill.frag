#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_index_draw.glsl"

layout(early_fragment_tests) in;
layout(set = 1, binding = kPassStorage + kIndexCounts, scalar) buffer Counts { uint counts[]; };      // by pixel: how many are missing
layout(set = 1, binding = kPassStorage + kIndexOffsets, scalar) readonly buffer Offsets { uint offsets[]; };
layout(set = 1, binding = kPassStorage + kIndexEntries, scalar) buffer Entries { uint entries[]; };

// Puts each light that hits the pixel into the pixel's list, from its begin on as they come.
void main() {
    const uvec2 at = uvec2(gl_FragCoord.xy);
    const uint pixel = at.y * uint(view.extent.x) + at.x;
    if (!hits()) return;
    const uint place = offsets[pixel + 1u] - atomicAdd(counts[pixel], 0xffffffffu);
    if (place < uint(entries.length())) entries[place] = lightIndex;  // the host sees how many there are, and makes room
}
