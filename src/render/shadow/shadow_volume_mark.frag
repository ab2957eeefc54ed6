#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/shaders/frame.glsl"
#include "render/shadow/shadow_volume.shared.h"

layout(early_fragment_tests) in;

layout(set = kPassSet, binding = kPassStorage + kVolumeMask, scalar) buffer Mask { uint mask[]; };
layout(push_constant, scalar) uniform Push { ShadowVolumePush push; };

// Where the stencil says that volumes are entered more often than left: the light is hidden.
void main() {
    const uint pixel = uint(gl_FragCoord.y) * uint(view.extent.x) + uint(gl_FragCoord.x);
    atomicOr(mask[pixel * push.maskWords + push.light / 32u], 1u << (push.light % 32u));
}
