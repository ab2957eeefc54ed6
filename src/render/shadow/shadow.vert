#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "render/shadow/shadow.shared.h"

// What casts shadows, as a light sees it. MASKED: with what depth_masked.frag asks for.
layout(location = 0) in vec3 position;
layout(location = 6) in mat4 worldFromObject;
layout(push_constant, scalar) uniform Push { ShadowPush map; };

#ifdef MASKED
layout(location = 3) in vec2 uv0;
layout(location = 4) in vec2 uv1;
layout(location = 5) in vec4 color;
layout(location = 4) out vec4 uv;
layout(location = 5) out vec4 colorOut;
#endif

void main() {
    const vec3 positionLight = (worldFromObject * vec4(position, 1)).xyz - map.originWorld;
    gl_Position = map.clipFromLight * vec4(positionLight, 1);
#ifdef MASKED
    uv = vec4(uv0, uv1);
    colorOut = color;
#endif
}
