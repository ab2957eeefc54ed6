#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/forward.glsl"
#include "render/lighting/light_prepass.shared.h"

layout(set = 1, binding = kPrepassTerms) uniform sampler2D diffuse;
layout(set = 1, binding = kPrepassTerms + 1u) uniform sampler2D specular;
layout(set = 1, binding = kPrepassTerms + 2u) uniform sampler2D grazing;

// Gives the light terms of the pixel the surface's colours.
void main() {
    beginSurface();
    const ivec2 pixel = ivec2(gl_FragCoord.xy);
    sum += shade(point, LightTerms(texelFetch(diffuse, pixel, 0).rgb, texelFetch(specular, pixel, 0).rgb, texelFetch(grazing, pixel, 0).rgb));
    endSurface();
}
