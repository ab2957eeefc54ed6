#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_index_draw.glsl"

// Variants: TWO and FOUR, so many images at a time; COUNTED, one more in which the lights of each pixel add up.
layout(location = 0) out vec4 image0;
#if defined(TWO) || defined(FOUR)
layout(location = 1) out vec4 image1;
#endif
#ifdef FOUR
layout(location = 2) out vec4 image2;
layout(location = 3) out vec4 image3;
#endif

#ifdef COUNTED
#if defined(FOUR)
layout(location = 4) out float count;
#elif defined(TWO)
layout(location = 2) out float count;
#else
layout(location = 1) out float count;
#endif
#endif

// Trebilco 2009, "Light Index Packing: Bit Shifting": a digit of the index, as the highest bits of a channel of 8.
uint written;
float digit(uint channel) {
    const uint mask = (1u << kEntryBits) - 1u;
    return float(((written >> (channel * kEntryBits)) & mask) << (8u - kEntryBits)) / float(kUnit);
}
vec4 digits(uint image) {
    const uint c = 4u * image;
    return vec4(digit(c), digit(c + 1u), digit(c + 2u), digit(c + 3u));
}

// Writes the index of a light that hits the pixel; masks, blending and the stencil see to where.
void main() {
    if (!hits()) discard;
    written = index;
    if (kShadowed == kIndexShare)
        written = packedShare(lightArrives(unpackPosition(vec3(sampleHere() / view.extent, surfaceDepth()))), indexLimit(kKind, kIndexBits, kUnit));
#ifdef COUNTED
    count = 1.0 / 255.0;
#endif
    if (kKind == kPackedBits) {
        image0 = digits(0u);
#if defined(TWO) || defined(FOUR)
        image1 = digits(1u);
#endif
#ifdef FOUR
        image2 = digits(2u);
        image3 = digits(3u);
#endif
    } else {
        const float value = float(written) / float(kUnit);
        const float complement = float(kUnit - written) / float(kUnit);
        image0 = kKind == kPackedChannels ? vec4(value) : vec4(value, complement, value, complement);
#if defined(TWO) || defined(FOUR)
        image1 = vec4(0);
#endif
#ifdef FOUR
        image2 = vec4(0);
        image3 = vec4(0);
#endif
    }
}
