// The shapes that enclose what a light can reach (Calver 2003, "Shaped Lights" to "Convex Light Volumes"), in view space.
// Derivations: docs/techniques/light-volumes.md. Read by both compilers.
#ifndef LUCIOLE_LIGHT_VOLUME_SHARED_H
#define LUCIOLE_LIGHT_VOLUME_SHARED_H
#include "render/shaders/types.shared.h"
SHARED_BEGIN

const float kHalfTurn = 3.14159265358979f;

// A shape of this radius encloses whatever has a depth, metres.
const float kBoundless = 1e6f;

// A ball's sector: the points within `radius` of `apex` in directions within `angle` of `axis`. A ball has the angle pi; what
// is drawn of a sector of more than pi / 2 is its convex hull, the ball cut off at radius * cos(angle) along the axis.
struct LightShape {
    vec3 apex;
    vec3 axis;
    float radius;
    float angle;
};

// Not for directional lights. The cosine is lowered by what floats may round where the cone is tested.
SHARED_FN LightShape lightShape(LightConstants light) {
    const bool spot = light.type == kLightSpot;
    const float angle = spot ? acos(clamp(light.cosOuter - 1e-6f, -1.0f, 1.0f)) : kHalfTurn;
    LightShape shape = {light.position, spot ? light.direction : vec3(0, 0, 1), light.range, angle};
    return shape;
}

// How far from where it is a surface point of the G-buffer may seem to be, metres, for points that this light can reach
// (viewSlack in tables.cpp makes the coefficients). A shape that is larger by so much loses no pixel.
SHARED_FN float slackOf(ViewConstants view, LightShape shape) {
    const vec4 slack = view.slack;
    const float farthest = min(length(shape.apex) + shape.radius, 1e12f);
    const float nearest = max(max(view.zNear, farthest - 2.0f * shape.radius), 1e-6f);
    return slack.x + farthest * (slack.y + farthest * (slack.z + slack.w / nearest));
}

// What a device may be off in sines and their inverses, radians and share of a radius: Vulkan allows 2^-11.
const float kTrigonometry = 1e-3f;

// Contains every point within `slack` of the shape's hull.
SHARED_FN LightShape inflate(LightShape shape, float slack) {
    const float angle = min(max(shape.angle + kTrigonometry, 0.02f), kHalfTurn);
    const float shift = angle < kHalfTurn ? slack / sin(min(angle, 0.5f * kHalfTurn)) : 0.0f;
    LightShape larger = {shape.apex - shape.axis * shift, shape.axis, shape.radius + slack + shift, angle};
    return larger;
}

// The smallest ball around a sector: centre and radius.
SHARED_FN vec4 boundingBall(LightShape shape) {
    const float c = cos(shape.angle);
    if (shape.angle <= 0.25f * kHalfTurn) {
        const float radius = 0.5f * shape.radius / c;  // through the apex and the rim
        return vec4(shape.apex + shape.axis * radius, radius);
    }
    if (shape.angle <= 0.5f * kHalfTurn)
        return vec4(shape.apex + shape.axis * (shape.radius * c), shape.radius * sin(shape.angle));  // around the rim
    return vec4(shape.apex, shape.radius);
}

// The interval of x / depth over the part with depth >= zNear of a disc around (x, depth), which must reach that far: the
// slopes of the tangents from the eye, or, where a tangent touches nearer than zNear, of the disc's edge at zNear.
SHARED_FN vec2 projectedInterval(float x, float depth, float radius, float zNear) {
    const float tangent2 = x * x + depth * depth - radius * radius;  // negative: the eye is inside
    const float tangent = sqrt(max(tangent2, 0.0f));
    const float away = abs(zNear - depth);
    // Never less than what the rounding of its terms may hide.
    const float half_ = sqrt(max(radius - away + 3e-7f * radius, 0.0f) * (radius + away));
    vec2 interval = vec2(x - half_, x + half_) / zNear;
    // The point of touch is (x t + s r depth, depth t - s r x) t / |centre|^2, for s = -1 and 1.
    const float scale = tangent / max(x * x + depth * depth, 1e-30f);
    const float depthLow = (depth * tangent + radius * x) * scale;
    const float depthHigh = (depth * tangent - radius * x) * scale;
    if (tangent2 > 0.0f && depthLow >= zNear)
        interval.x = (x * tangent - radius * depth) / (depth * tangent + radius * x);
    if (tangent2 > 0.0f && depthHigh >= zNear)
        interval.y = (x * tangent + radius * depth) / (depth * tangent - radius * x);
    return interval;
}

// Bounds of a ball's projection in normalized device coordinates: low x, low y, high x, high y; low > high for a ball that is
// nearer than the near plane.
SHARED_FN vec4 projectedBounds(ViewConstants view, vec4 ball) {
    const float depth = -ball.z;
    if (depth + ball.w < view.zNear) return vec4(1, 1, -1, -1);
    vec2 x = vec2(ball.x - ball.w, ball.x + ball.w);
    vec2 y = vec2(ball.y - ball.w, ball.y + ball.w);
    if (view.orthographic == 0u) {
        x = projectedInterval(ball.x, depth, ball.w, view.zNear);
        y = projectedInterval(ball.y, depth, ball.w, view.zNear);
    }
    const vec2 scale = view.clipScale;
    return vec4(x.x * scale.x, -y.y * scale.y, x.y * scale.x, -y.x * scale.y);
}

// Bounds of a shape's projection, and the depth of its closest point or less. A cone lies in the hull of its apex and of a ball
// around its cap, whose projection, if the near plane cuts neither, is bounded by their bounds.
struct ShapeBounds {
    vec4 rectangle;  // as projectedBounds
    float depth;
};
SHARED_FN ShapeBounds shapeBounds(ViewConstants view, LightShape shape) {
    const vec4 ball = boundingBall(shape);
    ShapeBounds bounds = {projectedBounds(view, ball), -ball.z - ball.w};
    if (shape.angle > 0.5f * kHalfTurn) return bounds;
    const vec4 cap = vec4(shape.apex + shape.axis * (shape.radius * cos(shape.angle)), shape.radius * sin(shape.angle));
    const float depth = min(-shape.apex.z, -cap.z - cap.w);
    if (depth < view.zNear) return bounds;
    const vec4 a = projectedBounds(view, vec4(shape.apex, 0));
    const vec4 b = projectedBounds(view, cap);
    const vec4 both = vec4(min(a.x, b.x), min(a.y, b.y), max(a.z, b.z), max(a.w, b.w));
    const vec4 r = bounds.rectangle;
    bounds.rectangle = vec4(max(r.x, both.x), max(r.y, both.y), min(r.z, both.z), min(r.w, both.w));
    bounds.depth = max(bounds.depth, depth);
    return bounds;
}

// A ball around a mesh that bounds a light, with the G-buffer's slack.
SHARED_FN vec4 volumeBall(ViewConstants view, VolumeConstants volume) {
    const vec3 center = mat3(view.viewFromWorld) * (0.5f * (volume.low + volume.high) - vec3(view.worldFromView[3]));
    LightShape ball = {center, vec3(0, 0, 1), 0.5f * distance(volume.low, volume.high), kHalfTurn};
    return vec4(center, ball.radius + slackOf(view, ball));
}

// Whether bounds in normalized device coordinates contain the centre of a pixel of the picture.
SHARED_FN bool coversPixel(vec4 bounds, vec2 extent) {
    const vec2 low = (vec2(bounds.x, bounds.y) * 0.5f + 0.5f) * extent - 0.5f;
    const vec2 high = (vec2(bounds.z, bounds.w) * 0.5f + 0.5f) * extent - 0.5f;
    const vec2 first = max(ceil(low), vec2(0.0f));
    const vec2 last = min(floor(high), extent - 1.0f);
    return first.x <= last.x && first.y <= last.y;
}

// Levels of detail of the meshes: 0 is a box, the others have slices around the axis and rings from its end to the rim.
const uint kVolumeLods = 5u;
// One level more, for shapes whose far-off corners a rasterizer no longer resolves: a triangle over the whole picture, infinitely
// far away, drawn as a back face.
const uint kVolumeScreen = kVolumeLods;
const float kLargestRadius = 8192.0f;  // pixels; a radius of 12,750 was seen to lose a pixel on Mesa's software driver
SHARED_FN uint volumeSlices(uint lod) { return lod < 2u ? 4u : 4u * lod; }
SHARED_FN uint volumeRings(uint lod) { return lod < 3u ? 4u : 2u * lod; }

// The next finer mesh costs some 20 to 120 triangles more and saves a share of the pixels that falls as 1 / slices^2: it pays
// from these radii on, in pixels, if a triangle costs about as much as 10 pixels.
SHARED_FN uint volumeLod(float radiusPixels) {
    if (radiusPixels < 12.0f) return 0u;
    if (radiusPixels < 16.0f) return 1u;
    if (radiusPixels < 50.0f) return 2u;
    if (radiusPixels < 100.0f) return 3u;
    return radiusPixels < kLargestRadius ? 4u : kVolumeScreen;
}

// Radius, in pixels, of a ball's projection, about.
SHARED_FN float radiusInPixels(ViewConstants view, vec4 ball) {
    const float radius = ball.w * 0.5f * max(view.clipScale.x * view.extent.x, view.clipScale.y * view.extent.y);
    return view.orthographic != 0u ? radius : radius / max(-ball.z, 0.5f * ball.w);
}

// The mesh of a level, so that its faces lie outside the shape: vertices of the cap at `radius`, those of the rim at `angle`,
// and the middle of the base at `base` along the axis.
struct VolumeMesh {
    float radius;
    float angle;
    float base;
};
SHARED_FN VolumeMesh volumeMesh(LightShape shape, uint lod) {
    VolumeMesh mesh;
    mesh.angle = shape.angle;
    if (lod == 0u) {
        mesh.radius = shape.radius;
        mesh.base = min(shape.radius * cos(shape.angle), 0.0f);
        return mesh;
    }
    const float c = cos(kHalfTurn / float(volumeSlices(lod)));
    if (shape.angle < 0.5f * kHalfTurn) mesh.angle = atan(sin(shape.angle), c * cos(shape.angle));
    const float step = mesh.angle / float(volumeRings(lod));
    // A facet between two rings lies nearest to the apex where it is nearest to the equator.
    const float facet = clamp(floor(0.5f * kHalfTurn / step), 0.0f, float(volumeRings(lod)) - 1.0f);
    const float s = sin((facet + 0.5f) * step);
    mesh.radius = (1.0f + 2.0f * kTrigonometry) * shape.radius * sqrt(c * c * (1.0f - s * s) + s * s) / (c * cos(0.5f * step));
    mesh.base = min(mesh.radius * cos(mesh.angle), 0.0f);
    return mesh;
}

// A ball around the mesh.
SHARED_FN vec4 meshBall(LightShape shape, uint lod) {
    const VolumeMesh mesh = volumeMesh(shape, lod);
    LightShape whole = {shape.apex, shape.axis, mesh.radius, mesh.angle};
    if (lod > 0u) return boundingBall(whole);
    const float side = mesh.radius * sin(min(mesh.angle, 0.5f * kHalfTurn));
    const float halfHeight = 0.5f * (mesh.radius - mesh.base);
    return vec4(shape.apex + shape.axis * (mesh.base + halfHeight), sqrt(2.0f * side * side + halfHeight * halfHeight));
}

// Vertex of a level's mesh, view space. Boxes: bits 0 to 2 of `vertex` tell the corner. Others: 0 the middle of the base, 1 the
// end of the axis, then ring by ring from there to the rim, slice by slice.
SHARED_FN vec3 volumeVertex(LightShape shape, uint lod, uint vertex) {
    const VolumeMesh mesh = volumeMesh(shape, lod);
    vec3 p = vec3(0, 0, vertex == 0u ? mesh.base : mesh.radius);
    if (lod == 0u) {
        const float side = mesh.radius * sin(min(mesh.angle, 0.5f * kHalfTurn));
        p = vec3((vertex & 1u) != 0u ? side : -side, (vertex & 2u) != 0u ? side : -side, (vertex & 4u) != 0u ? mesh.radius : mesh.base);
    } else if (vertex >= 2u) {
        const uint slices = volumeSlices(lod);
        const uint ring = (vertex - 2u) / slices + 1u;
        const float polar = mesh.angle * float(ring) / float(volumeRings(lod));
        const float azimuth = 2.0f * kHalfTurn * float((vertex - 2u) % slices) / float(slices);
        p = mesh.radius * vec3(sin(polar) * cos(azimuth), sin(polar) * sin(azimuth), cos(polar));
    }
    // Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
    const vec3 n = shape.axis;
    const float s = n.z >= 0.0f ? 1.0f : -1.0f;
    const float a = -1.0f / (s + n.z);
    const float b = n.x * n.y * a;
    const vec3 u = vec3(1.0f + s * n.x * n.x * a, s * b, -s * n.x);
    const vec3 v = vec3(b, s + n.y * n.y * a, -n.y);
    return shape.apex + p.x * u + p.y * v + p.z * n;
}

// How the mesh of a light in view space is drawn. Front faces tell what hides the light; but where the near plane cuts the mesh
// they leave a hole, and there back faces are drawn (Calver 2003, "Light Shader Occlusion Optimisations").
struct VolumeDraw {
    bool visible;
    bool frontFaces;
    uint lod;
};
SHARED_FN VolumeDraw volumeDraw(ViewConstants view, LightConstants light) {
    const LightShape plain = lightShape(light);
    const float slack = slackOf(view, plain);
    const LightShape shape = inflate(plain, slack);
    const vec4 ball = boundingBall(shape);
    VolumeDraw draw;
    draw.visible = view.cullLights == 0u || coversPixel(shapeBounds(view, shape).rectangle, view.extent);
    // Where the G-buffer tells distances no better than this, its farthest ones may be anything (calver, far off).
    const bool vague = slack > 0.25f * (length(plain.apex) + plain.radius);
    draw.lod = vague ? kVolumeScreen : volumeLod(radiusInPixels(view, ball));
    const vec4 around = meshBall(shape, draw.lod);
    draw.frontFaces = draw.lod != kVolumeScreen && (view.orthographic != 0u || -around.z - around.w > 1.00001f * view.zNear);
    return draw;
}

// Where the meshes of the levels lie in the buffer of indices (volumeIndices in tables.cpp).
SHARED_FN uint volumeIndexCount(uint lod) {
    if (lod == kVolumeScreen) return 3u;
    return lod == 0u ? 36u : 6u * volumeSlices(lod) * volumeRings(lod);
}
SHARED_FN uint volumeFirstIndex(uint lod) {
    uint first = 0u;
    for (uint i = 0u; i < lod; ++i) first += volumeIndexCount(i);
    return first;
}

// volume_lists.comp: lights by how their mesh is drawn, class = lod * 2 + front faces.
const uint kVolumeGroup = 64u;
const uint kVolumeClasses = 2u * (kVolumeLods + 1u);
struct IndexedDraw {              // VkDrawIndexedIndirectCommand
    uint indexCount;
    uint instanceCount;
    uint firstIndex;
    int vertexOffset;
    uint firstInstance;
};

SHARED_END
#endif
