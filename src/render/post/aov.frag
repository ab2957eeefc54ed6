#version 460
#extension GL_GOOGLE_include_directive : require
// The additional layers, from the G-buffer.
#include "render/geometry/gbuffer_read.glsl"
#include "render/shaders/illuminate.glsl"

layout(push_constant, scalar) uniform Push { LightSlice slice; };
layout(location = 0) out vec4 scalars;  // depth, material, object ID, light count
layout(location = 1) out vec4 normal;   // world space
layout(location = 2) out vec4 cs0;
layout(location = 3) out vec4 cs1;

void main() {
    const Surface s = readSurface(ivec2(gl_FragCoord.xy));
    uint count = 0u;
    const LightSlice all = slice;  // read once, as eyeWorld is
    for (uint i = 0u; i < all.count; ++i) count += uint(reaches(lightAt(all.first + i), s.P, s.objectId));
    // Later slices are added to the first: they bring their lights only.
    const float once = slice.first == 0u ? 1.0 : 0.0;
    // materials[0] stands for "no surface", so the scene's indices are one lower.
    scalars = vec4(once * vec3(-viewFromShading(s.P).z, float(s.material) - 1.0, float(s.objectId)), float(count));
    normal = vec4(once * (s.N), 0);
    cs0 = vec4(once * s.Cs0, 0);
    cs1 = vec4(once * s.Cs1, 0);
}
