// Prefix sums: slots and the result's layout. Read by both compilers.
#ifndef LUCIOLE_PREFIX_SUM_SHARED_H
#define LUCIOLE_PREFIX_SUM_SHARED_H
#include "shared.h"
SHARED_BEGIN
const uint kPrefixGroup = 256u;
const uint kPrefixEach = 32u;  // values of one invocation

// Storage buffers by slot.
const uint kPrefixSums = 0u;    // by group
const uint kPrefixCounts = 1u;  // the values
const uint kPrefixPlaces = 2u;  // the sums of those before them; one more at the end: the sum of all
const uint kPrefixResult = 3u;  // kResult*
const uint kPrefixSize = 4u;    // another result, whose total tells how many values there are

// A result, for lists whose lengths were summed up.
const uint kResultOver = 0u;    // lists longer than `capacity`
const uint kResultExcess = 1u;  // what they have beyond it
const uint kResultMost = 2u;    // the longest list
const uint kResultTotal = 3u;   // of all lists; of several sums into one result the largest
const uint kResultCount = 4u;

struct PrefixPush {
    uint groups;
    uint factor;    // values for each one of kPrefixSize's total
    uint capacity;
};
SHARED_END
#endif
