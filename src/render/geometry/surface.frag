#version 460
#extension GL_GOOGLE_include_directive : require
// The geometry phase: fills the G-buffer (Calver 2003, "Geometry phase").
#include "render/geometry/gbuffer.glsl"
#include "render/geometry/surface_shading.glsl"

layout(location = 0) out vec4 outA;
layout(location = 1) out vec4 outB;
layout(location = 2) out vec4 outC;
layout(location = 3) out vec4 outD;

void main() {
    float alpha;
    const Texels texels = packSurface(surfaceHere(alpha), gl_FragCoord);
    outA = texels.a;
    outB = texels.b;
    outC = texels.c;
    outD = texels.d;
}
