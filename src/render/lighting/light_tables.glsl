// Lights by index, out of textures (light_tables.frag).
#ifndef LUCIOLE_LIGHT_TABLES_GLSL
#define LUCIOLE_LIGHT_TABLES_GLSL
#include "render/lighting/light_texels.glsl"

layout(set = 1, binding = kIndexTables) uniform sampler2D tablePositions;
layout(set = 1, binding = kIndexTables + 1) uniform sampler2D tableColors;
layout(set = 1, binding = kIndexTables + 2) uniform sampler2D tableDirections;
layout(set = 1, binding = kIndexTables + 3) uniform sampler2D tableKinds;
layout(set = 1, binding = kIndexTables + 4) uniform sampler2D tableRows;
layout(set = 1, binding = kPassStorage + kIndexShapes, scalar) readonly buffer Classes { uint classOfObject[]; };
layout(constant_id = 17) const uint kRows = 1u;  // of 256 lights

// What does not reach the surface's object, as the null light, has the range 0.
LightConstants indexedLight(uint index) {
    const ivec2 texel = ivec2(index & 255u, index >> 8u);
    const ivec2 own = texel + ivec2(0, usesLights(kUsesLinks) ? classOfObject[point.s.objectId] * kRows : 0u);
    LightConstants light = toLight(LightTexels(texelFetch(tablePositions, texel, 0), texelFetch(tableColors, own, 0), texelFetch(tableDirections, texel, 0),
                                               texelFetch(tableKinds, texel, 0), texelFetch(tableRows, texel, 0)));
    light.linkGroup = kNoIndex;  // the colours have seen to it
    return light;
}
#endif
