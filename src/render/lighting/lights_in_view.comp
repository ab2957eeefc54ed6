#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/shaders/frame.glsl"

layout(local_size_x = 64) in;
layout(set = 1, binding = kPassStorage, scalar) writeonly buffer LightsInView { LightConstants lightsInView[]; };

// The table of lights as foreign renderers read it: LucioleStoredLight (luciole/light_index.glsl).
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < view.lightCount) lightsInView[i] = lightInView(i);
}
