#version 460
// Boxes without vertex buffers: an instance a box, six vertices a face.
struct Box {
    vec4 center, halfSize, color;
};
layout(set = 0, binding = 0, std430) readonly buffer Boxes { Box boxes[]; };
layout(push_constant) uniform Push {
    mat4 clipFromView;
    mat4 viewFromWorld;
};
layout(location = 0) out vec3 positionView;
layout(location = 1) out vec3 normalView;
layout(location = 2) out vec3 color;
invariant gl_Position;  // the forward pass tests for the very depth of the depth pass

void main() {
    const Box box = boxes[gl_InstanceIndex];
    const int axis = gl_VertexIndex / 12;
    const int corner = int[](0, 1, 2, 2, 1, 3)[gl_VertexIndex % 6];
    vec3 normal = vec3(0), onUnitCube;
    normal[axis] = onUnitCube[axis] = gl_VertexIndex / 6 % 2 == 0 ? 1.0 : -1.0;
    onUnitCube[(axis + 1) % 3] = (corner & 1) == 0 ? -1.0 : 1.0;
    onUnitCube[(axis + 2) % 3] = (corner & 2) == 0 ? -1.0 : 1.0;
    positionView = (viewFromWorld * vec4(box.center.xyz + box.halfSize.xyz * onUnitCube, 1)).xyz;
    normalView = mat3(viewFromWorld) * normal;
    color = box.color.rgb;
    gl_Position = clipFromView * vec4(positionView, 1);
}
