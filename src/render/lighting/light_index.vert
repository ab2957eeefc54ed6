#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_index.shared.h"
#include "render/shaders/frame.glsl"

layout(set = 1, binding = kPassStorage + kIndexOrder, scalar) readonly buffer Order { uint order[]; };
layout(set = 1, binding = kPassStorage + kIndexShapes, scalar) readonly buffer Shapes { uint shapes[]; };
layout(push_constant, scalar) uniform Push { LightSlice slice; };
layout(location = 0) flat out uint lightIndex;
layout(location = 1) flat out uint index;  // what stands for it in the images
// What decides whom it hits; from here, as a fragment shader's own look-ups cost more than all the rest of it.
layout(location = 2) flat out vec4 positionRange;
layout(location = 3) flat out vec4 directionCosOuter;
layout(location = 4) flat out uvec2 typeVolume;

layout(constant_id = 10) const uint kSurfaces = 1u;  // light_index_draw.glsl
layout(constant_id = 11) const uint kRemapped = 0u;  // IndexPlan

// The volume of one light of a slice of the order. For the lights that reach a surface back faces are drawn, where the surface lies before
// them: indoors few lights lie behind it, and no near plane cuts a hole. For all lights before a surface front faces are drawn
// (Trebilco 2009, "Light Volume Front Faces"); where the near plane cuts them, back faces take their place: the mesh is turned inside
// out and put before everything.
void main() {
    const uint place = slice.first + gl_InstanceIndex;
    lightIndex = order[place];
    index = (kRemapped != 0u ? place : lightIndex) + 1u;
    const LightConstants shading = lightAt(lightIndex);
    positionRange = vec4(shading.position, shading.range);
    directionCosOuter = vec4(shading.direction, shading.cosOuter);
    typeVolume = uvec2(shading.type, shading.volume);
    const LightConstants light = lightInView(lightIndex);
    const uint shape = shapes[lightIndex];
    gl_Position = vec4(0, 0, 0, 1);  // all corners in one place: nothing
    if (shape == kShapeScreen) {
        // Vertices 1, 2 and 3 are the mesh's first triangle; of the others each either is a point or is turned away.
        const uint second = kSurfaces != 0u ? 3u : 2u;
        const uint corner = gl_VertexIndex == second ? 1u : gl_VertexIndex == 5u - second ? 2u : 0u;
        const float depth = kSurfaces != 0u ? 1e-30 : 1.0;  // 0 is where nothing is
        gl_Position = vec4(vec2(corner & 1u, corner >> 1u) * 4.0 - 1.0, depth, 1);
    } else if (shape != kShapeNone) {
        vec4 bounds = vec4(0);
        if (light.volume != kNoIndex) bounds = volumeBall(view, volumes[light.volume]);
        const bool insideOut = kSurfaces == 0u && shape == kShapeCut;
        // A mesh is symmetric: what is its vertex at angle a is, seen in a mirror, the one at -a.
        const uint slices = volumeSlices(kIndexLod);
        uint vertex = gl_VertexIndex;
        if (insideOut && vertex >= 2u) {
            const uint slice_ = (vertex - 2u) % slices;
            vertex = vertex - slice_ + (slices - slice_) % slices;
        }
        gl_Position = view.clipFromView * vec4(volumeVertex(indexShape(view, light, bounds), kIndexLod, vertex), 1);
        if (insideOut) gl_Position.z = gl_Position.w;
    }
}
