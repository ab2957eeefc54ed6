#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/geometry/gbuffer_read.glsl"
#include "render/lighting/contribution.glsl"
#include "render/lighting/light_lists.glsl"

// Deferred shading by lists: the G-buffer is read once, and the pixel's lights are summed in registers (Andersson 2009, "Parallel
// Graphics in Frostbite"; Olsson and Assarsson 2011, "Tiled Shading"). Variant CLUSTERED.
layout(constant_id = 3) const uint kTileSize = 16u;
layout(constant_id = 4) const uint kParts = 1u;
layout(constant_id = 5) const uint kFirst = 1u;  // the light that is there without lights is added, too
layout(location = 0) out vec4 sum;

void main() {
    const ivec2 pixel = ivec2(gl_FragCoord.xy);
    const Surface s = readSurface(pixel);
    const ShadingPoint p = shadingPoint(s);
    sum = vec4(0);
    if (kFirst != 0u && !usesLights(kCountsLights)) sum = vec4(initialLight(s, materialAt(s.material)), 1);
    const uvec2 list = listAt(uvec2(pixel), texelFetch(gbufferDepth, pixel, 0).x, kTileSize, kParts);
    for (uint i = list.x; i < list.y; ++i) sum += addend(p, lightAt(entries[i]));
    sum = sumOf(p, sum);
}
