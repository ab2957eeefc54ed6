#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/shaders/frame.glsl"

layout(location = 0) flat out uint lightIndex;
invariant gl_Position;  // what marks the stencil and what lights are two pipelines

// A mesh that bounds a light, triangle by triangle.
void main() {
    lightIndex = gl_InstanceIndex;
    const vec3 fromEye = volumeVertices[gl_VertexIndex] - eyeWorld;
    gl_Position = view.clipFromView * vec4(mat3(view.viewFromWorld) * fromEye, 1);
}
