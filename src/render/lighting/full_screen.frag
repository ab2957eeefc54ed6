#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/geometry/gbuffer_read.glsl"
#include "render/shaders/illuminate.glsl"

layout(push_constant, scalar) uniform Push { uint lightIndex; };
layout(location = 0) out vec4 radiance;

// One light at every pixel, added to the light buffer by the blender (Calver 2003, "Full screen lights").
void main() {
    const ShadingPoint p = shadingPoint(readSurface(ivec2(gl_FragCoord.xy)));
    radiance = vec4(illuminate(p, lightAt(lightIndex)), 0);
}
