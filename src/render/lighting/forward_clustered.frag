#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/forward.glsl"
#define CLUSTERED
#include "render/lighting/light_lists.glsl"

// Clustered forward shading: a surface that is drawn, opaque or not, finds its cluster by its depth (Olsson et al. 2012, "Clustered
// Deferred and Forward Shading"; Persson 2013, "Practical Clustered Shading").
layout(constant_id = 8) const uint kTileSize = 16u;
layout(constant_id = 9) const uint kParts = 1u;

void main() {
    beginSurface();
    const uvec2 list = listAt(uvec2(gl_FragCoord.xy), shadingDepth, kTileSize, kParts);
    for (uint i = list.x; i < list.y; ++i) addLight(lightAt(entries[i]));
    endSurface();
}
