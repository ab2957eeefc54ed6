#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_index.shared.h"
#include "render/shaders/frame.glsl"

layout(local_size_x = 64) in;
layout(set = 1, binding = kPassStorage + kIndexShapes, scalar) writeonly buffer Shapes { uint shapes[]; };

// How each light is drawn.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= view.lightCount) return;
    const LightConstants light = lightInView(i);
    vec4 bounds = vec4(0);
    if (light.volume != kNoIndex) bounds = volumeBall(view, volumes[light.volume]);
    shapes[i] = indexShapeOf(view, light, indexShape(view, light, bounds));
}
