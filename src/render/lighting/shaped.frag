#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/geometry/gbuffer_read.glsl"
#include "render/lighting/contribution.glsl"

layout(location = 0) flat in uint lightIndex;
layout(location = 0) out vec4 sum;

// One light at the pixels that its shape covers.
void main() { sum = contribution(shadingPoint(readSurface(ivec2(gl_FragCoord.xy))), lightAt(lightIndex)); }
