#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_index.shared.h"
#include "render/shaders/frame.glsl"

// Where each pixel's list begins: the sum of the lengths before it. Three dispatches, one per stage; a group does a stretch of pixels.
layout(constant_id = 3) const uint kStage = 0u;
layout(constant_id = 4) const uint kCapacity = 0u;  // of the packing that lists stand in for
layout(local_size_x = kScanGroup) in;
layout(set = 1, binding = kPassStorage, scalar) buffer Sums { uint sums[]; };  // by group
layout(set = 1, binding = kPassStorage + kIndexCounts, scalar) readonly buffer Counts { uint counts[]; };
layout(set = 1, binding = kPassStorage + kIndexOffsets, scalar) buffer Offsets { uint offsets[]; };
layout(set = 1, binding = kPassStorage + kIndexEntries, scalar) buffer Counters { uint counters[]; };

shared uint partial[kScanGroup];

// The sum of `partial` before this invocation; of all in `total`.
uint before(uint own, out uint total) {
    const uint i = gl_LocalInvocationIndex;
    partial[i] = own;
    barrier();
    for (uint step_ = 1u; step_ < kScanGroup; step_ *= 2u) {
        const uint lower = i >= step_ ? partial[i - step_] : 0u;
        barrier();
        partial[i] += lower;
        barrier();
    }
    total = partial[kScanGroup - 1u];
    return partial[i] - own;
}

void main() {
    const uint pixels = uint(view.extent.x) * uint(view.extent.y);
    const uint groups = (pixels + kScanGroup * kScanPixels - 1u) / (kScanGroup * kScanPixels);
    const uint i = gl_LocalInvocationIndex;
    uint total;
    if (kStage == 1u) {  // sums of groups become sums of those before them; one group does them all
        const uint each = (groups + kScanGroup - 1u) / kScanGroup;
        const uint end = min((i + 1u) * each, groups);
        uint own = 0u;
        for (uint g = i * each; g < end; ++g) own += sums[g];
        uint sum = before(own, total);
        for (uint g = i * each; g < end; ++g) {
            const uint group = sums[g];
            sums[g] = sum;
            sum += group;
        }
        if (i == 0u) {
            offsets[pixels] = total;
            counters[kCounterEntries] = max(counters[kCounterEntries], total);
        }
        return;
    }
    const uint first = gl_WorkGroupID.x * kScanGroup * kScanPixels + i * kScanPixels;
    const uint end = min(first + kScanPixels, pixels);
    uint own = 0u, most = 0u, over = 0u, pairs = 0u;
    for (uint pixel = first; pixel < end; ++pixel) {
        const uint count = counts[pixel];
        own += count;
        most = max(most, count);
        over += uint(count > kCapacity);
        pairs += count > kCapacity ? count - kCapacity : 0u;
    }
    uint sum = before(own, total);
    if (kStage == 0u) {
        if (i == 0u) sums[gl_WorkGroupID.x] = total;
        if (over > 0u) {
            atomicAdd(counters[kCounterPixels], over);
            atomicAdd(counters[kCounterPairs], pairs);
        }
        atomicMax(counters[kCounterMost], most);
    } else {
        sum += sums[gl_WorkGroupID.x];
        for (uint pixel = first; pixel < end; ++pixel) {
            offsets[pixel] = sum;
            sum += counts[pixel];
        }
    }
}
