#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_volume.glsl"

layout(location = 0) flat out uint lightIndex;

// A screen-aligned quad around the light's projection, at the depth of its closest point (Calver 2003, "Light Shader Occlusion
// Optimisations").
void main() {
    lightIndex = gl_InstanceIndex;
    const vec4 ball = enclosingBall(lights[lightIndex]);
    const vec4 exact = projectedBounds(view, ball);
    const vec4 bounds = clamp(exact, vec4(-1), vec4(1));
    const uint corner = uint[](0u, 1u, 2u, 2u, 1u, 3u)[gl_VertexIndex];
    const vec2 position = mix(bounds.xy, bounds.zw, vec2(corner & 1u, corner >> 1u));
    const vec4 closest = view.clipFromView * vec4(0, 0, ball.z + ball.w, 1);
    const bool touchesNear = ball.z + ball.w >= -view.zNear;
    gl_Position = vec4(position, touchesNear ? 1.0 : clamp(closest.z / closest.w, 0.0, 1.0), 1);
    const bool behind = exact.x > exact.z;
    if (behind || (view.cullLights != 0u && !coversPixel(exact, view.extent)))
        gl_Position = vec4(0, 0, 0, 1);  // all corners in one place: nothing
}
