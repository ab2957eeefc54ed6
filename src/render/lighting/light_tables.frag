#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_index.shared.h"
#include "render/lighting/light_texels.glsl"

// Light data as textures (Trebilco 2009, "Light Index Geometry Lighting"), made anew from the table of lights in each frame, so that no
// update waits for a frame that still reads. Variants: COLORS, what may differ by surface; ALL, what only some lights need.
layout(constant_id = 3) const uint kRows = 1u;       // of 256 lights
layout(constant_id = 4) const uint kRemapped = 0u;   // IndexPlan
layout(set = 1, binding = kPassStorage + kIndexOrder, scalar) readonly buffer Order { uint order[]; };
layout(location = 0) out vec4 first;
#ifdef ALL
layout(location = 1) out vec4 direction;
layout(location = 2) out vec4 kind;
layout(location = 3) out vec4 rows;
#endif
#ifdef COLORS
layout(set = 1, binding = kPassStorage + kIndexShapes, scalar) readonly buffer Objects_ { uint objectOfClass[]; };
#endif

void main() {
    const uvec2 texel = uvec2(gl_FragCoord.xy);
    const uint index = texel.x + 256u * (texel.y % kRows);
    // Index zero is the null light: black, and it reaches nothing.
    first = vec4(0);
#ifdef ALL
    direction = kind = rows = vec4(0);
#endif
    if (index == 0u || index > view.lightCount) return;
    const LightConstants light = lightAt(kRemapped != 0u ? order[index - 1u] : index - 1u);
    const LightTexels texels = toTexels(light);
#ifdef COLORS
    // "Lights that should not hit a surface can be nulled out": one table for each class of objects that the same lights touch.
    if (!linked(light.linkGroup, objectOfClass[texel.y / kRows])) return;
    first = texels.color;
#else
    first = texels.place;
#endif
#ifdef ALL
    direction = texels.direction;
    kind = texels.kind;
    rows = texels.rows;
#endif
}
