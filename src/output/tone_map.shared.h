// From exposed radiance to the value that is stored in a picture; read by both compilers (docs/conventions.md,
// "Picture").
#ifndef LUCIOLE_TONE_MAP_SHARED_H
#define LUCIOLE_TONE_MAP_SHARED_H
#include "shared.h"

SHARED_BEGIN

// The values of enum ToneMap.
const uint kToneMapNone = 0u;
const uint kToneMapReinhard = 1u;
const uint kToneMapAces = 2u;
const uint kToneMapAgx = 3u;

// Far beyond white in every curve, and its square is still a float.
const float kBrightest = 1.0e9f;

// NaN fails the comparison and becomes black, infinity becomes the brightest value.
SHARED_FN float displayable(float x) { return x > 0.0f ? min(x, kBrightest) : 0.0f; }

// Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", eq. 3, per channel.
SHARED_FN vec3 reinhard(vec3 x) { return x / (1.0f + x); }

// Narkowicz 2015, "ACES Filmic Tone Mapping Curve". Passes 1 at x = 7.24; the caller clamps.
SHARED_FN vec3 acesNarkowicz(vec3 x) { return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f); }

// Wrensch 2023, "Minimal AgX Implementation", base look: the inset matrix, his polynomial of degree 6 in log2 space
// (mean square error 3.7e-6), the outset matrix. The result is linear, as Sobotka's AgX encodes for a display of
// gamma 2.2. The inset and outset matrices mix channels, so a strong colour moves towards white as it brightens.
SHARED_FN vec3 agxWrensch(vec3 x) {
    const mat3 inset = mat3(0.842479062253094f, 0.0423282422610123f, 0.0423756549057051f,  //
                            0.0784335999999992f, 0.878468636469772f, 0.0784336f,           //
                            0.0792237451477643f, 0.0791661274605434f, 0.879142973793104f);
    const mat3 outset = mat3(1.19687900512017f, -0.0528968517574562f, -0.0529716355144438f,  //
                             -0.0980208811401368f, 1.15190312990417f, -0.0980434501171241f,  //
                             -0.0990297440797205f, -0.0989611768448433f, 1.15107367264116f);
    const float minEv = -12.47393f;
    const float maxEv = 4.026069f;
    const vec3 ev = log2(max(inset * x, vec3(1.0e-10f)));
    const vec3 t = (clamp(ev, minEv, maxEv) - minEv) / (maxEv - minEv);
    const vec3 t2 = t * t;
    const vec3 t4 = t2 * t2;
    const vec3 curve =
        15.5f * t4 * t2 - 40.14f * t4 * t + 31.96f * t4 - 6.868f * t2 * t + 0.4298f * t2 + 0.1191f * t - 0.00232f;
    return pow(max(outset * curve, vec3(0.0f)), vec3(2.2f));
}

// IEC 61966-2-1, of x in [0, 1].
SHARED_FN float srgbEncode(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * pow(x, 1.0f / 2.4f) - 0.055f; }

// The stored value, in [0, 1] whatever comes in. An unknown toneMap counts as none.
SHARED_FN vec3 displayColor(vec3 radianceExposed, uint toneMap) {
    vec3 x = vec3(displayable(radianceExposed.x), displayable(radianceExposed.y), displayable(radianceExposed.z));
    if (toneMap == kToneMapReinhard) x = reinhard(x);
    if (toneMap == kToneMapAces) x = acesNarkowicz(x);
    if (toneMap == kToneMapAgx) x = agxWrensch(x);
    x = clamp(x, 0.0f, 1.0f);
    return vec3(srgbEncode(x.x), srgbEncode(x.y), srgbEncode(x.z));
}

SHARED_END
#endif
