#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/geometry/gbuffer_read.glsl"
#include "render/lighting/contribution.glsl"
#include "render/lighting/light_index.shared.h"

layout(constant_id = 3) const uint kFirst = 1u;  // the light that is there without lights is added, too
layout(set = 1, binding = kPassStorage + kIndexOffsets, scalar) readonly buffer Offsets { uint offsets[]; };
layout(set = 1, binding = kPassStorage + kIndexEntries, scalar) readonly buffer Entries { uint entries[]; };
layout(location = 0) out vec4 sum;

// The lights of the pixel's own list, summed in registers.
void main() {
    const Surface s = readSurface(ivec2(gl_FragCoord.xy));
    const ShadingPoint p = shadingPoint(s);
    sum = vec4(0);
    if (kFirst != 0u && !usesLights(kCountsLights)) sum = vec4(initialLight(s, materialAt(s.material)), 1);
    const uint pixel = uint(gl_FragCoord.y) * uint(view.extent.x) + uint(gl_FragCoord.x);
    const uint end = min(offsets[pixel + 1u], uint(entries.length()));
    for (uint i = offsets[pixel]; i < end; ++i) sum += addend(p, lightAt(entries[i]));
    sum = sumOf(p, sum);
}
