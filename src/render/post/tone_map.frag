#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/shaders/frame.glsl"
#include "output/tone_map.shared.h"

layout(constant_id = 3) const uint kToneMap = 0u;  // enum ToneMap
layout(set = 1, binding = 0) uniform sampler2D radiance;
layout(location = 0) out vec4 display;

void main() {
    const vec3 exposed = texelFetch(radiance, ivec2(gl_FragCoord.xy), 0).rgb * view.exposure;
    display = vec4(displayColor(exposed, kToneMap), 1);
}
