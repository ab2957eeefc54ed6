#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_index_draw.glsl"
#include "render/lighting/light_index_unpack.glsl"

layout(early_fragment_tests) in;
layout(set = 1, binding = kPassStorage + kIndexCounters, scalar) buffer Counters { uint counters[]; };  // then [light][kLostWords]
layout(set = 1, binding = kPassStorage + kIndexOffsets, scalar) buffer Seen { uint seen[]; };           // [pixel][sample]

#ifdef MULTISAMPLED
const int kSamples = 4;
int sampleNumber() { return gl_SampleID; }
#else
const int kSamples = 1;
int sampleNumber() { return 0; }
#endif

bool kept() {
    for (uint pass = 0u; pass < kPasses; ++pass) {
        const PackedIndices packed = packedIndices(0u, pass, ivec2(gl_FragCoord.xy), sampleNumber());
        for (uint n = 0u; n < kPerPass; ++n)
            if (indexEntry(packed, pass, n) == index) return true;
    }
    return false;
}

// Looks for each light that hits the pixel in what the index images hold, and tells of those that are not there: pairs of a light and
// a pixel, pixels, and the radiance that a white surface facing the light would have sent.
void main() {
    if (!hits() || kept()) return;
    const ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (atomicExchange(seen[(pixel.y * int(view.extent.x) + pixel.x) * kSamples + sampleNumber()], 1u) == 0u)
        atomicAdd(counters[kCounterPixels], 1u);
    const uint first = kCounterCount + lightIndex * kLostWords;
    atomicAdd(counters[first], 1u);
    const vec3 P = unpackPosition(vec3(sampleHere() / view.extent, surfaceDepth()));
    const float radiance = surfaceDepth() > 0.0 ? dot(arrivalAt(lightAt(lightIndex), P).E, vec3(0.2126, 0.7152, 0.0722)) / kPi : 0.0;
    const uint amount = uint(clamp(radiance * 65536.0 + 0.5, 0.0, 4294967040.0));
    if (atomicAdd(counters[first + 1u], amount) > 0xffffffffu - amount) atomicAdd(counters[first + 2u], 1u);
}
