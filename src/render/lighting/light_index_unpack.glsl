// The indices of one pixel, out of the index images; variant INDEXSAMPLES: of one of its samples.
#ifndef LUCIOLE_LIGHT_INDEX_UNPACK_GLSL
#define LUCIOLE_LIGHT_INDEX_UNPACK_GLSL
#include "luciole/light_index.glsl"
#include "render/lighting/light_index.shared.h"

#ifdef INDEXSAMPLES
#define INDEX_IMAGE sampler2DMS
#else
#define INDEX_IMAGE sampler2D
#endif
layout(set = 1, binding = kIndexImages) uniform INDEX_IMAGE images0;
layout(set = 1, binding = kIndexImages + 1) uniform INDEX_IMAGE images1;
layout(set = 1, binding = kIndexImages + 2) uniform INDEX_IMAGE images2;
layout(set = 1, binding = kIndexImages + 3) uniform INDEX_IMAGE images3;
layout(set = 1, binding = kIndexMoreImages) uniform INDEX_IMAGE moreImages0;
layout(set = 1, binding = kIndexMoreImages + 1) uniform INDEX_IMAGE moreImages1;
layout(set = 1, binding = kIndexMoreImages + 2) uniform INDEX_IMAGE moreImages2;
layout(set = 1, binding = kIndexMoreImages + 3) uniform INDEX_IMAGE moreImages3;

vec4 indexTexel(uint set, uint image, ivec2 pixel, int sample_) {
    if (set == 0u) {
        if (image == 0u) return texelFetch(images0, pixel, sample_);
        if (image == 1u) return texelFetch(images1, pixel, sample_);
        return image == 2u ? texelFetch(images2, pixel, sample_) : texelFetch(images3, pixel, sample_);
    }
    if (image == 0u) return texelFetch(moreImages0, pixel, sample_);
    if (image == 1u) return texelFetch(moreImages1, pixel, sample_);
    return image == 2u ? texelFetch(moreImages2, pixel, sample_) : texelFetch(moreImages3, pixel, sample_);
}

// The images of one pass, as whole numbers.
struct PackedIndices {
    uvec4 image[4];
};

PackedIndices packedIndices(uint set, uint pass, ivec2 pixel, int sample_) {
    const uint first = kKind == kPackedBits ? pass * kImages : 0u;
    PackedIndices packed;
    for (uint i = 0u; i < 4u; ++i)
        packed.image[i] = i < kImages ? uvec4(indexTexel(set, first + i, pixel, sample_) * float(kUnit) + 0.5) : uvec4(0);
    return packed;
}

// The largest index and the smallest, which is none of its own if it is the same (Trebilco 2009, "Multi-pass Max Blend Equation"; the
// text reads the second one out of the blue channel, where by its own rendering steps the second pair begins).
uint extremesEntry(uvec2 extremes, uint n) {
    if (n == 0u || extremes.x == 0u) return extremes.x;
    const uint smallest = kUnit - extremes.y;
    return smallest == extremes.x ? 0u : smallest;
}

// Entry `n` of the pass, in [0, kPerPass). Only where entries come in the order of arrival does a 0 say that no more follow.
uint indexEntry(PackedIndices packed, uint pass, uint n) {
    if (kKind == kPackedBits) return lucioleDigits(packed.image, kIndexBits, kEntryBits, n);
    if (kKind == kPackedChannels) return packed.image[n >> 2u][n & 3u];
    return extremesEntry(pass == 0u ? packed.image[0].xy : packed.image[0].zw, n);
}
bool endsAtZero() { return kKind == kPackedBits; }
#endif
