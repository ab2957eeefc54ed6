// Slots and counters of the forward passes. Read by both compilers.
#ifndef LUCIOLE_FORWARD_SHARED_H
#define LUCIOLE_FORWARD_SHARED_H
#include "shared.h"
SHARED_BEGIN
const uint kForwardDepth = 15u;    // sampled image: depth, sample by sample
const uint kForwardCounts = 5u;    // storage buffer: what was evaluated
const uint kForwardCounters = 3u;  // a pixel: evaluations, useful ones, their fingerprints
SHARED_END
#endif
