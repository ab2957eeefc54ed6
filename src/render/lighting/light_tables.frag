#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_index.shared.h"
#include "render/shaders/illuminate.glsl"

// Light data as textures (Trebilco 2009, "Light Index Geometry Lighting"), made anew from the table of lights in each frame, so that no
// update waits for a frame that still reads. Variants: COLORS, what may differ by surface; ALL, what only some lights need.
layout(constant_id = 3) const uint kRows = 1u;       // of 256 lights
layout(constant_id = 4) const uint kRemapped = 0u;   // IndexPlan
layout(set = 1, binding = kPassStorage + kIndexOrder, scalar) readonly buffer Order { uint order[]; };
layout(location = 0) out vec4 first;
#ifdef ALL
layout(location = 1) out vec4 direction;
layout(location = 2) out vec4 kind;
layout(location = 3) out vec4 functionRows;
#endif
#ifdef COLORS
layout(set = 1, binding = kPassStorage + kIndexShapes, scalar) readonly buffer Objects_ { uint objectOfClass[]; };
#endif

// Small whole numbers as floats, which keep them; kNoIndex as -1.
float stored(uint index) { return index == kNoIndex ? -1.0 : float(index); }

void main() {
    const uvec2 texel = uvec2(gl_FragCoord.xy);
    const uint index = texel.x + 256u * (texel.y % kRows);
    // Index zero is the null light: black, and it reaches nothing.
    first = vec4(0);
#ifdef ALL
    direction = kind = functionRows = vec4(0);
#endif
    if (index == 0u || index > view.lightCount) return;
    const LightConstants light = lights[kRemapped != 0u ? order[index - 1u] : index - 1u];
#ifdef COLORS
    // "Lights that should not hit a surface can be nulled out": one table for each class of objects that the same lights touch.
    if (!linked(light.linkGroup, objectOfClass[texel.y / kRows])) return;
    first = vec4(light.color, light.range);
#else
    first = vec4(light.position, light.inverseRange);
#endif
#ifdef ALL
    direction = vec4(light.direction, light.cosOuter);
    kind = vec4(light.coneScale, light.coneOffset, float(light.type + 256u * light.flags), float(light.sceneIndex));
    functionRows = vec4(stored(light.attenuation), stored(light.falloff), stored(light.volume), 0);
#endif
}
