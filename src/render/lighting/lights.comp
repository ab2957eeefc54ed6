#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_volume.shared.h"
#include "render/shaders/frame.glsl"

layout(local_size_x = 64) in;
layout(set = 1, binding = kPassStorage, scalar) writeonly buffer LightsInView { LightConstants lightsInView[]; };

// Takes the lights from world into view space, so that what the host does per frame does not grow with their number.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < view.lightCount) lightsInView[i] = inView(sources[i], view.viewFromWorld, view.worldFromView[3].xyz);
}
