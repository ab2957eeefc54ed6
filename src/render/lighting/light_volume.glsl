// The shapes of lights, in shaders that read the frame's tables.
#ifndef LUCIOLE_LIGHT_VOLUME_GLSL
#define LUCIOLE_LIGHT_VOLUME_GLSL
#include "render/lighting/light_volume.shared.h"
#include "render/shaders/frame.glsl"

// The light's shape, larger by what the G-buffer may be off.
LightShape enclosingShape(LightConstants light) {
    const LightShape shape = lightShape(light);
    return inflate(shape, slackOf(view, shape));
}

// A ball around all that the light can reach. Not for unbounded lights.
vec4 enclosingBall(LightConstants light) {
    if (light.volume == kNoIndex) return boundingBall(enclosingShape(light));
    const VolumeConstants bounds = volumes[light.volume];
    const vec3 center = mat3(view.viewFromWorld) * (0.5 * (bounds.low + bounds.high) - view.worldFromView[3].xyz);
    const LightShape ball = {center, vec3(0, 0, 1), 0.5 * distance(bounds.low, bounds.high), kHalfTurn};
    return vec4(center, ball.radius + slackOf(view, ball));
}
#endif
