#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/bindings.shared.h"
#include "render/lighting/light_index.shared.h"

// Sends every value that a channel of the index images can meet through the target and its blending. Pixel (x, y): x is there, y comes.
// Variants: FIRST writes x, SECOND blends y, else what came of it is checked.
layout(constant_id = 0) const uint kKind = 0u;  // IndexPacking
layout(constant_id = 1) const uint kIndexBits = 8u;
layout(constant_id = 2) const uint kEntryBits = 2u;
layout(constant_id = 3) const uint kUnit = 255u;

const uint kBits = kKind == kPackedBits ? 8u : kIndexBits;

// What is there before and what comes. Within capacity the digits that would be shifted out are 0.
uvec2 values() {
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    if (kKind == kPackedBits) return uvec2((pixel.x >> kEntryBits) << kEntryBits, (pixel.y & ((1u << kEntryBits) - 1u)) << (8u - kEntryBits));
    if (kBits == 16u) return kKind == kPackedChannels ? uvec2(0u, pixel.x + 256u * pixel.y) : uvec2(257u * pixel.x, pixel.x + 256u * pixel.y);
    return kKind == kPackedChannels ? uvec2(0u, pixel.x) : pixel;
}

#if defined(FIRST) || defined(SECOND)
layout(location = 0) out vec4 image;
void main() {
#ifdef FIRST
    image = vec4(float(values().x) / float(kUnit));
#else
    image = vec4(float(values().y) / float(kUnit));
#endif
}
#else
layout(set = kPassSet, binding = kIndexImages) uniform sampler2D image;
layout(set = kPassSet, binding = kPassStorage + kIndexCounters) buffer Wrong { uint wrong; };
void main() {
    const uvec2 v = values();
    const uint found = uint(texelFetch(image, ivec2(gl_FragCoord.xy), 0).x * float(kUnit) + 0.5);
    const uint shifted = kEntryBits < 8u ? v.x >> kEntryBits : 0u;
    const uint expected = kKind == kPackedBits ? shifted | v.y : max(v.x, v.y);
    if (found != expected) atomicAdd(wrong, 1u);
}
#endif
