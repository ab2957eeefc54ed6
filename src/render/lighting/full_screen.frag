#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/geometry/gbuffer_read.glsl"
#include "render/lighting/contribution.glsl"

layout(push_constant, scalar) uniform Push { uint lightIndex; };
layout(location = 0) out vec4 sum;

// One light at every pixel, added to the light buffer by the blender (Calver 2003, "Full screen lights").
void main() {
    sum = contribution(shadingPoint(readSurface(ivec2(gl_FragCoord.xy))), lightAt(lightIndex));
}
