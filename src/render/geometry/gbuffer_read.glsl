// The G-buffer as textures of a lighting pass: bindings 0 to 4 of the pass (see readGBuffer in gbuffer.cpp).
#ifndef LUCIOLE_GBUFFER_READ_GLSL
#define LUCIOLE_GBUFFER_READ_GLSL
#include "render/geometry/gbuffer.glsl"

layout(set = 1, binding = 0) uniform sampler2D gbufferA;
layout(set = 1, binding = 1) uniform sampler2D gbufferB;
layout(set = 1, binding = 2) uniform sampler2D gbufferC;
layout(set = 1, binding = 3) uniform sampler2D gbufferD;
layout(set = 1, binding = 4) uniform sampler2D gbufferDepth;

Surface readSurface(ivec2 pixel) {
    const Texels texels = Texels(texelFetch(gbufferA, pixel, 0), texelFetch(gbufferB, pixel, 0),
                                 texelFetch(gbufferC, pixel, 0), texelFetch(gbufferD, pixel, 0));
    return unpackSurface(texels, vec2(pixel) + 0.5, texelFetch(gbufferDepth, pixel, 0).x);
}
#endif
