#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_volume.glsl"

layout(push_constant, scalar) uniform Push { uint lod; };
layout(location = 0) flat out uint lightIndex;
invariant gl_Position;  // what marks the stencil and what lights are two pipelines

// A closed convex mesh around what the light can reach (Calver 2003, "Convex Light Volumes"). The instance is the light.
void main() {
    lightIndex = gl_InstanceIndex;
    gl_Position = volumePosition(lightInView(lightIndex), lod, gl_VertexIndex);
}
