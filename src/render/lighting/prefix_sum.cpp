#include "render/lighting/prefix_sum.hpp"

#include <array>

#include "frame/pass_context.hpp"
#include "render/lighting/prefix_sum.shared.h"

namespace luciole::render {

using frame::Access;
using namespace shared;

void addPrefixSum(frame::FrameGraph& graph, const std::string& name, const PrefixSum& sum) {
    constexpr uint64_t kStretch = kPrefixGroup * kPrefixEach;
    const auto groups = uint32_t((sum.most + kStretch - 1) / kStretch);
    const frame::BufferId sums = graph.createBuffer(name + "sums", groups * 4ull);
    for (uint32_t stage = 0; stage < 3; ++stage) {
        auto pass = graph.addPass(name + std::array{"sums", "places", "offsets"}[stage]);
        pass.read(sum.counts, Access::computeStorageRead, kPrefixCounts)
            .read(sum.size, Access::computeStorageRead, kPrefixSize)
            .update(sum.result, Access::computeStorageWrite, kPrefixResult);
        stage == 0 ? pass.write(sums, Access::computeStorageWrite, kPrefixSums)
                         .write(sum.places, Access::computeStorageWrite, kPrefixPlaces)
                   : pass.update(sums, Access::computeStorageWrite, kPrefixSums)
                         .update(sum.places, Access::computeStorageWrite, kPrefixPlaces);
        pass.record([stage, groups, push = PrefixPush{groups, sum.factor, sum.capacity}](frame::PassContext& context) {
            context.push(push);
            context.dispatch("render/lighting/prefix_sum.comp", {stage}, stage == 1 ? 1 : groups);
        });
    }
}

frame::BufferId addKnownSize(frame::FrameGraph& graph, uint32_t n) {
    std::array<uint32_t, kResultCount> result{};
    result[kResultTotal] = n;
    return graph.createConstantBuffer("size", result);
}

}  // namespace luciole::render
