#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/geometry/gbuffer.glsl"
#include "render/lighting/contribution.glsl"
#include "render/lighting/light_prepass.shared.h"

// The terms of one light at the pixels that its shape covers; variant EVERYWHERE: of a slice of the lights, summed in registers.
// Variant COUNTING: counts instead (contribution.glsl).
#ifdef EVERYWHERE
layout(push_constant, scalar) uniform Push { LightSlice slice; };
#else
layout(location = 0) flat in uint lightIndex;
#endif
#ifdef COUNTING
layout(location = 0) out vec4 sum;
#else
layout(location = 0) out vec4 diffuse;
layout(location = 1) out vec4 specular;
layout(location = 2) out vec4 grazing;
#endif
layout(set = 1, binding = kPrepassSurface) uniform sampler2D storedSurface;
layout(set = 1, binding = kPrepassObject) uniform sampler2D storedObject;
layout(set = 1, binding = kPrepassDepth) uniform sampler2D storedDepth;

ShadingPoint pointHere() {
    const ivec2 pixel = ivec2(gl_FragCoord.xy);
    const vec4 stored = texelFetch(storedSurface, pixel, 0);
    Surface s;
    const float depth = texelFetch(storedDepth, pixel, 0).x;
    s.P = unpackPosition(vec3(gl_FragCoord.xy / view.extent, depth));
    s.N = shadingFromView(unpackNormal(stored.xy));
    s.Cs0 = vec3(0);
    s.Cs1 = vec3(0);
    s.specularBlend = 0.0;
    s.roughness = stored.z;
    s.occlusion = 0.0;
    s.seen = depth > 0.0;
    s.material = unpackIndex(stored.w);
    s.objectId = unpackIndex(texelFetch(storedObject, pixel, 0).x);
    return shadingPoint(s);
}

void add(ShadingPoint p, LightConstants light) {
#ifdef COUNTING
    sum += countOf(p, light);
#else
    if (!isSurface(p)) return;
    const LightTerms terms = lightTerms(p, light);
    diffuse.rgb += terms.diffuse;
    specular.rgb += terms.specular;
    grazing.rgb += terms.grazing;
#endif
}

void main() {
#ifdef COUNTING
    sum = vec4(0);
#else
    diffuse = specular = grazing = vec4(0);
#endif
    const ShadingPoint p = pointHere();
#ifdef EVERYWHERE
    const LightSlice all = slice;  // read once, as eyeWorld is
    for (uint i = 0u; i < all.count; ++i) add(p, lightAt(all.first + i));
#else
    add(p, lightAt(lightIndex));
#endif
}
