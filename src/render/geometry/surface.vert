#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/shaders/frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv0;
layout(location = 4) in vec2 uv1;
layout(location = 5) in vec4 color;
// Of the instance: ObjectConstants.
layout(location = 6) in mat4 worldFromObject;
layout(location = 10) in mat3 worldNormalFromObject;
layout(location = 13) in float tangentSign;
layout(location = 14) in uvec2 materialAndId;

layout(location = 0) out vec3 positionView;
layout(location = 1) out vec3 positionObject;
layout(location = 2) out vec3 normalView;
layout(location = 3) out vec4 tangentView;
layout(location = 4) out vec4 uv;
layout(location = 5) out vec4 colorOut;
layout(location = 6) flat out uvec2 materialAndObject;

invariant gl_Position;  // the depth set-up pass has to give the same depth

void main() {
    const mat3 viewFromWorld = mat3(view.viewFromWorld);
    const vec4 p = view.viewFromWorld * (worldFromObject * vec4(position, 1));
    gl_Position = view.clipFromView * p;
    positionView = p.xyz;
    positionObject = position;
    normalView = viewFromWorld * (worldNormalFromObject * normal);
    tangentView = vec4(viewFromWorld * (mat3(worldFromObject) * tangent.xyz), tangent.w * tangentSign);
    uv = vec4(uv0, uv1);
    colorOut = color;
    materialAndObject = materialAndId;
}
