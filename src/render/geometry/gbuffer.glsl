// Packing of the three G-buffer layouts (docs/gbuffer.md). Needs kLayout and `view` from frame.glsl.
//   calver   A RGBA16: position after the perspective divide, specular blend   B RGBA16: normal (oct), roughness, occlusion
//            C RGBA16: Cs0, material                                           D RGBA16: Cs1, object ID
//   float    A RGBA16F: position in view space, specular blend; B, C, D as calver
//   compact  A RGBA8: sqrt Cs0, specular blend   B RGBA8: sqrt Cs1, occlusion
//            C RGBA16: normal (oct), roughness, object ID   D R16: material    position from depth
#ifndef LUCIOLE_GBUFFER_GLSL
#define LUCIOLE_GBUFFER_GLSL
#include "render/shaders/frame.glsl"
#include "render/shaders/surface.glsl"

const uint kCalver = 0u;
const uint kFloatPosition = 1u;
const uint kCompact = 2u;

struct Texels {
    vec4 a, b, c, d;
};

// A quarter of a step more, so that a driver that truncates keeps the index, too.
float packIndex(uint index) { return (float(index) + 0.25) / 65535.0; }
uint unpackIndex(float stored) { return uint(stored * 65535.0 + 0.5); }

// Octahedral map of the sphere to [0, 1]^2 (Meyer et al. 2010, "On Floating-Point Normal Vectors").
vec2 packNormal(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return p * 0.5 + 0.5;
}
vec3 unpackNormal(vec2 stored) {
    const vec2 p = stored * 2.0 - 1.0;
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    return n * inversesqrt(dot(n, n));
}

// Calver 2003, "Storing Position": PackPositionForGBuffer. The rasterizer has divided by w and biased x and y already.
// Not below one step of 16 bits: 0 would be infinitely far.
vec3 packPosition(vec4 fragCoord) { return vec3(fragCoord.xy / view.extent, max(fragCoord.z, 1.0 / 65535.0)); }
// UnPackPositionFromGBuffer, into shading space.
vec3 unpackPosition(vec3 stored) {
    const mat4 m = view.shadingFromGBuffer;
    const vec3 p = m[0].xyz * stored.x + m[1].xyz * stored.y + m[2].xyz * stored.z + m[3].xyz;
    return p * (1.0 / (m[2].w * stored.z + m[3].w));  // the camera looks straight ahead: w depends on depth alone
}

// Depth, as the depth buffer has it, of an interpolated position: where the near plane cuts a triangle, a rasterizer may put it before the
// plane, which is at 1.
float depthOf(vec3 positionView) {
    const vec4 clip = view.clipFromView * vec4(positionView, 1);
    return clip.w > 0.0 ? clamp(clip.z / clip.w, 0.0, 1.0) : 1.0;
}

// `s` in view space, `s.Cs0` and `s.Cs1` already divided by the material's scales.
Texels packSurface(Surface s, vec4 fragCoord) {
    const vec2 normal = packNormal(s.N);
    if (kLayout == kCompact)
        return Texels(vec4(sqrt(s.Cs0), s.specularBlend), vec4(sqrt(s.Cs1), s.occlusion),
                      vec4(normal, s.roughness, packIndex(s.objectId)), vec4(packIndex(s.material), 0, 0, 0));
    const vec3 position = kLayout == kCalver ? packPosition(fragCoord) : clamp(s.P, -65504.0, 65504.0);
    return Texels(vec4(position, s.specularBlend), vec4(normal, s.roughness, s.occlusion), vec4(s.Cs0, packIndex(s.material)),
                  vec4(s.Cs1, packIndex(s.objectId)));
}

// In shading space.
Surface unpackSurface(Texels t, vec2 pixelCenter, float depth) {
    Surface s;
    if (kLayout == kCompact) {
        s.P = unpackPosition(vec3(pixelCenter / view.extent, depth));
        s.N = shadingFromView(unpackNormal(t.c.xy));
        s.Cs0 = t.a.rgb * t.a.rgb;
        s.Cs1 = t.b.rgb * t.b.rgb;
        s.specularBlend = t.a.w;
        s.occlusion = t.b.w;
        s.roughness = t.c.z;
        s.objectId = unpackIndex(t.c.w);
        s.material = unpackIndex(t.d.x);
        s.seen = depth > 0.0;  // not by the material, whose target most lighting passes need for nothing else
    } else {
        s.P = kLayout == kCalver ? unpackPosition(t.a.xyz) : shadingFromView(t.a.xyz);
        s.N = shadingFromView(unpackNormal(t.b.xy));
        s.specularBlend = t.a.w;
        s.roughness = t.b.z;
        s.occlusion = t.b.w;
        s.Cs0 = t.c.rgb;
        s.material = unpackIndex(t.c.w);
        s.seen = s.material != 0u;
        s.Cs1 = t.d.rgb;
        s.objectId = unpackIndex(t.d.w);
    }
    const MaterialConstants m = materialAt(s.material);
    if (usesMaterials(kMaterialsScale)) {
        s.Cs0 *= m.cs0Scale;
        s.Cs1 *= m.cs1Scale;
    }
    return s;
}
#endif
