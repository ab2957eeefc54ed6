// The numbers behind the layer "light-fingerprint"; read by both compilers (docs/conventions.md, "Layers").
#ifndef LUCIOLE_FINGERPRINT_SHARED_H
#define LUCIOLE_FINGERPRINT_SHARED_H
#include "shared.h"

SHARED_BEGIN

// Of the light at `index` in the scene, in [1, 4096]: floats hold a sum of up to 4,096 of them exactly. The factor is 2^32
// divided by the golden ratio (Knuth 1998, "The Art of Computer Programming" 3, section 6.4), which spreads neighbours.
SHARED_FN uint fingerprint(uint index) { return ((index * 2654435761u) >> 20u) + 1u; }

SHARED_END
#endif
