// One bounce by small lights: what its shader and its host code agree on. Formulas: docs/conventions.md, "Bounce".
#ifndef LUCIOLE_BOUNCE_SHARED_H
#define LUCIOLE_BOUNCE_SHARED_H
#include "shared.h"
SHARED_BEGIN

const float kBounceNear = 0.01f;  // metres along the axis; what is nearer to the light, such as its own glass, bounces nothing

// A small light ends where it gives this share, over their number, of what the light that bounces would give at the same distance from
// itself with nothing in its way. So all of them together lose no more than this share of the light's mean irradiance. Less is
// more exact and makes the lights larger: their range goes by 1 / sqrt(share).
const float kBounceShare = 1.0f / 32.0f;

struct BouncePush {
    uint light;  // that bounces: its place in the table
    uint first;  // small light
    uint grid;
    float tanOuter;
};

SHARED_END
#endif
