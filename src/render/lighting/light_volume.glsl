// The shapes of lights, in shaders that read the frame's tables.
#ifndef LUCIOLE_LIGHT_VOLUME_GLSL
#define LUCIOLE_LIGHT_VOLUME_GLSL
#include "render/lighting/light_volume.shared.h"
#include "render/shaders/frame.glsl"

// Where there are no spot lights, none of their trigonometry.
LightShape shapeOf(LightConstants light) {
    if ((kLights & kUsesSpot) == 0u) return LightShape(light.position, vec3(0, 0, 1), light.range, kHalfTurn);
    return lightShape(light);
}

// The light's shape, larger by what the G-buffer may be off.
LightShape enclosingShape(LightConstants light) {
    const LightShape shape = shapeOf(light);
    return inflate(shape, slackOf(view, shape));
}

// Vertex of the mesh of a light, clip space.
vec4 volumePosition(LightConstants light, uint lod, uint vertex) {
    // Not at depth 0, which is where nothing is.
    if (lod == kVolumeScreen) return vec4(vec2(vertex & 1u, vertex >> 1u) * 4.0 - 1.0, 1e-30, 1);
    return view.clipFromView * vec4(volumeVertex(enclosingShape(light), lod, vertex), 1);
}

#endif
