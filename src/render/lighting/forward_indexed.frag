#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/forward.glsl"

// Light-indexed deferred rendering (Trebilco 2009), step 3: "Lighting is done using the light index texture to access lighting
// properties in each shader".
layout(constant_id = 8) const uint kKind = 0u;       // IndexPacking
layout(constant_id = 9) const uint kIndexBits = 8u;
layout(constant_id = 10) const uint kEntryBits = 2u;
layout(constant_id = 11) const uint kPerPass = 4u;
layout(constant_id = 12) const uint kPasses = 1u;
layout(constant_id = 13) const uint kImages = 1u;
layout(constant_id = 14) const uint kUnit = 255u;
layout(constant_id = 15) const uint kSets = 1u;      // of images: one, or one a type of light
#include "render/lighting/light_index_unpack.glsl"
layout(constant_id = 16) const uint kRemapped = 0u;  // IndexPlan

layout(constant_id = 18) const uint kSoft = 0u;      // the second set of images holds how much of each light arrives

layout(set = 1, binding = kPassStorage + kIndexOrder, scalar) readonly buffer Order { uint order[]; };
layout(push_constant, scalar) uniform Push { LightSlice rest; };  // of the order: lights without an index

#ifdef TABLES
#include "render/lighting/light_tables.glsl"
#else
LightConstants indexedLight(uint index) { return lightAt(kRemapped != 0u ? order[index - 1u] : index - 1u); }
#endif

void main() {
    beginSurface();
#ifdef INDEXSAMPLES
    const int sample_ = shadingSample;
#else
    const int sample_ = 0;  // the only one
#endif
    shadowsAsked = !usesLights(kShadowsByIndex);
    for (uint set = 0u; set < kSets; ++set)
        for (uint pass = 0u; pass < kPasses; ++pass) {
            const PackedIndices packed = packedIndices(set, pass, ivec2(gl_FragCoord.xy), sample_);
            PackedIndices shadows;
            if (kSoft != 0u) shadows = packedIndices(1u, pass, ivec2(gl_FragCoord.xy), sample_);
            for (uint n = 0u; n < kPerPass; ++n) {
                const uint index = indexEntry(packed, pass, n);
                if (index != 0u) {
                    const LightConstants light = indexedLight(index);
                    const float lit = kSoft != 0u ? litShare(indexEntry(shadows, pass, n), indexLimit(kKind, kIndexBits, kUnit)) : 1.0;
                    if (light.range > 0.0) addLight(light, lit);
                } else if (endsAtZero()) {
                    break;
                }
            }
        }
    shadowsAsked = true;
    for (uint i = 0u; i < rest.count; ++i) addLight(lightAt(order[rest.first + i]));
    endSurface();
}
