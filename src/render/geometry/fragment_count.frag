#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/geometry/surface_shading.glsl"

layout(location = 0) out float fragments;

// One for each fragment that is shaded: what the alpha mask cuts out is none.
void main() {
    float alpha;
    surfaceHere(alpha);
    fragments = 1.0;
}
