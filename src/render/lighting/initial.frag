#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/geometry/gbuffer_read.glsl"
#include "render/shaders/illuminate.glsl"

layout(location = 0) out vec4 radiance;

// Sets the light buffer to ambience and emission (Calver 2003, "Full screen lights").
void main() {
    const Surface s = readSurface(ivec2(gl_FragCoord.xy));
    radiance = vec4(initialLight(s, materialAt(s.material)), 1);
}
