#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/shaders/frame.glsl"
#include "render/shadow/shadow_volume.shared.h"

// Shadow volumes, closed and to infinity (Everitt and Kilgard 2002, "Practical and Robust Stenciled Shadow Volumes for Hardware-Accelerated
// Rendering"). Every triangle casts, whichever side the light is on: turned to the light, it is a near cap, its image at infinity a far one, and
// an edge has as many sides as its triangles turn about it in one direction more than in the other. So any mesh makes closed volumes.
layout(set = kPassSet, binding = kPassStorage + kVolumeVertices, scalar) readonly buffer Vertices { float vertices[]; };
layout(set = kPassSet, binding = kPassStorage + kVolumeIndices, scalar) readonly buffer Indices { uint indices[]; };
layout(set = kPassSet, binding = kPassStorage + kVolumeEdges, scalar) readonly buffer Edges { uvec2 edges[]; };
layout(set = kPassSet, binding = kPassStorage + kVolumeObjects, scalar) readonly buffer Objects { ObjectConstants objects[]; };
layout(push_constant, scalar) uniform Push { ShadowVolumePush push; };

vec3 cornerWorld(uint triangle, uint corner) {
    const uint v = kVertexFloats * (push.firstVertex + indices[push.firstIndex + 3u * triangle + corner]);
    return (objects[push.object].worldFromObject * vec4(vertices[v], vertices[v + 1u], vertices[v + 2u], 1)).xyz;
}

// 1 for a triangle that shows the light its front, else -1.
int sideOf(uint triangle) {
    precise vec3 a = cornerWorld(triangle, 0u), b = cornerWorld(triangle, 1u), c = cornerWorld(triangle, 2u);
    precise vec3 toLight = push.lightWorld.w * (push.lightWorld.xyz - a) - (1.0 - push.lightWorld.w) * push.lightWorld.xyz;
    precise float facing = dot(cross(b - a, c - a), toLight);
    return facing < 0.0 ? -1 : 1;
}

vec4 clipOf(vec3 world, bool far) {
    if (far) {
        const vec3 away = push.lightWorld.w > 0.0 ? world - push.lightWorld.xyz : push.lightWorld.xyz;
        if (push.reach == 0.0) return view.clipFromView * vec4(mat3(view.viewFromWorld) * away, 0);
        world += push.reach * normalize(away);
    }
    return view.clipFromView * (view.viewFromWorld * vec4(world, 1));  // as surface.vert
}

void main() {
    const uint n = uint(gl_VertexIndex), caps = 3u * push.triangles;
    if (n < 2u * caps) {
        const bool far = n >= caps;
        const uint triangle = n % caps / 3u, corner = n % 3u;
        const bool turned = (sideOf(triangle) < 0) != far;
        gl_Position = clipOf(cornerWorld(triangle, turned && corner != 0u ? 3u - corner : corner), far);
        return;
    }
    const uint quadVertex = (n - 2u * caps) % 12u;
    const uvec2 edge = edges[push.firstEdge + (n - 2u * caps) / 12u];
    int turns = sideOf(edge.x / 4u);
    if (edge.y != kNoIndex) turns += (edge.y % 4u == 1u ? 1 : -1) * sideOf(edge.y / 4u);
    // The second quad is there for an edge about which both triangles turn the same way.
    if (abs(turns) <= int(quadVertex / 6u)) {
        gl_Position = vec4(0, 0, 0, 1);
        return;
    }
    const uint corner = edge.x % 4u;
    const vec3 p = cornerWorld(edge.x / 4u, corner), q = cornerWorld(edge.x / 4u, (corner + 1u) % 3u);
    // (q, p, p at infinity) and (q, p at infinity, q at infinity), or turned round.
    const uint k = quadVertex % 6u, place = turns > 0 || k % 3u == 0u ? k : k / 3u * 3u + 3u - k % 3u;
    const bool first = place == 1u || place == 2u || place == 4u;
    gl_Position = clipOf(first ? p : q, place == 2u || place >= 4u);
}
