#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_volume.glsl"

layout(set = 1, binding = kPassStorage, scalar) readonly buffer List { uint list[]; };
layout(push_constant, scalar) uniform Push { uint lod; uint firstPlace; };
layout(location = 0) flat out uint lightIndex;

// A closed convex mesh around what the light can reach (Calver 2003, "Convex Light Volumes"). The instance is a place in a list of lights.
void main() {
    lightIndex = list[firstPlace + gl_InstanceIndex];
    gl_Position = volumePosition(lightInView(lightIndex), lod, gl_VertexIndex);
}
