#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/geometry/surface_input.glsl"

// The depth set-up pass of alpha-masked surfaces; the others need no fragment shader.
void main() {
    const SurfaceConstants surface = material.surface;
    if (baseColor(surface).a < surface.alphaCutoff) discard;
}
