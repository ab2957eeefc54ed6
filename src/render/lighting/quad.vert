#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_volume.glsl"

layout(location = 0) flat out uint lightIndex;

// A screen-aligned quad around the light's projection, at the depth of its closest point (Calver 2003, "Light Shader Occlusion
// Optimisations").
void main() {
    lightIndex = gl_InstanceIndex;
    const LightConstants light = lightInView(lightIndex);
    ShapeBounds bounds;
    if (light.volume == kNoIndex) {
        bounds = shapeBounds(view, enclosingShape(light));
    } else {
        const vec4 ball = volumeBall(view, volumes[light.volume]);
        bounds = ShapeBounds(projectedBounds(view, ball), -ball.z - ball.w);
    }
    const vec4 rectangle = clamp(bounds.rectangle, vec4(-1), vec4(1));
    const uint corner = uint[](0u, 1u, 2u, 2u, 1u, 3u)[gl_VertexIndex];
    const vec2 position = mix(rectangle.xy, rectangle.zw, vec2(corner & 1u, corner >> 1u));
    const vec4 closest = view.clipFromView * vec4(0, 0, -bounds.depth, 1);
    const bool touchesNear = bounds.depth <= view.zNear;
    gl_Position = vec4(position, touchesNear ? 1.0 : clamp(closest.z / closest.w, 0.0, 1.0), 1);
    const bool nowhere = bounds.rectangle.x > bounds.rectangle.z || bounds.rectangle.y > bounds.rectangle.w;
    if (nowhere || (view.cullLights != 0u && !coversPixel(bounds.rectangle, view.extent)))
        gl_Position = vec4(0, 0, 0, 1);  // all corners in one place: nothing
}
