#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/bindings.shared.h"
#include "render/lighting/prefix_sum.shared.h"

// Where each list begins: the sum of the lengths before it. Three dispatches, one per stage; a group does a stretch of values.
layout(constant_id = 0) const uint kStage = 0u;
layout(local_size_x = kPrefixGroup) in;
layout(push_constant, scalar) uniform Push { PrefixPush push; };
layout(set = 1, binding = kPassStorage + kPrefixSums, scalar) buffer Sums { uint sums[]; };
layout(set = 1, binding = kPassStorage + kPrefixCounts, scalar) readonly buffer Counts { uint counts[]; };
layout(set = 1, binding = kPassStorage + kPrefixPlaces, scalar) buffer Places { uint places[]; };
layout(set = 1, binding = kPassStorage + kPrefixResult, scalar) buffer Result { uint result[]; };
layout(set = 1, binding = kPassStorage + kPrefixSize, scalar) readonly buffer Size { uint size[]; };

shared uint partial[kPrefixGroup];

// The sum of `partial` before this invocation; of all in `total`.
uint before(uint own, out uint total) {
    const uint i = gl_LocalInvocationIndex;
    partial[i] = own;
    barrier();
    for (uint step_ = 1u; step_ < kPrefixGroup; step_ *= 2u) {
        const uint lower = i >= step_ ? partial[i - step_] : 0u;
        barrier();
        partial[i] += lower;
        barrier();
    }
    total = partial[kPrefixGroup - 1u];
    return partial[i] - own;
}

void main() {
    const uint count = size[kResultTotal] * push.factor;
    const uint i = gl_LocalInvocationIndex;
    uint total;
    if (kStage == 1u) {  // sums of groups become sums of those before them; one group does them all
        const uint each = (push.groups + kPrefixGroup - 1u) / kPrefixGroup;
        const uint end = min((i + 1u) * each, push.groups);
        uint own = 0u;
        for (uint g = i * each; g < end; ++g) own += sums[g];
        uint sum = before(own, total);
        for (uint g = i * each; g < end; ++g) {
            const uint group = sums[g];
            sums[g] = sum;
            sum += group;
        }
        if (i == 0u) {
            places[count] = total;
            result[kResultTotal] = max(result[kResultTotal], total);
        }
        return;
    }
    const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    const uint first = min(group * kPrefixGroup * kPrefixEach + i * kPrefixEach, count);
    const uint end = min(first + kPrefixEach, count);
    uint own = 0u, most = 0u, over = 0u, excess = 0u;
    for (uint v = first; v < end; ++v) {
        const uint length_ = counts[v];
        own += length_;
        most = max(most, length_);
        over += uint(length_ > push.capacity);
        excess += length_ > push.capacity ? length_ - push.capacity : 0u;
    }
    uint sum = before(own, total);
    if (kStage == 0u) {
        if (i == 0u && group < push.groups) sums[group] = total;
        if (over > 0u) {
            atomicAdd(result[kResultOver], over);
            atomicAdd(result[kResultExcess], excess);
        }
        if (most > 0u) atomicMax(result[kResultMost], most);
    } else if (group < push.groups) {
        sum += sums[group];
        for (uint v = first; v < end; ++v) {
            places[v] = sum;
            sum += counts[v];
        }
    }
}
