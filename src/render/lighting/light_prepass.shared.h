// Slots of the light pre-pass. Read by both compilers.
#ifndef LUCIOLE_LIGHT_PREPASS_SHARED_H
#define LUCIOLE_LIGHT_PREPASS_SHARED_H
#include "shared.h"
SHARED_BEGIN
// Sampled images.
const uint kPrepassSurface = 0u;  // RGBA16: normal (oct), roughness, material
const uint kPrepassObject = 1u;   // R16: object ID
const uint kPrepassDepth = 2u;
const uint kPrepassTerms = 3u;    // three: LightTerms (illuminate.glsl)
SHARED_END
#endif
