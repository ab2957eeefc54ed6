#include <fmt/format.h>

#include <algorithm>
#include <luciole/error.hpp>

#include "render/lighting/light_index.hpp"

namespace luciole::render {

using namespace shared;

namespace {

void tellLost(std::span<const uint32_t> counters, const LightIndexFrame& frame, LightIndexStats& stats) {
    for (size_t i = 0; i < frame.sceneIndices.size(); ++i) {
        const uint32_t* words = &counters[kCounterCount + i * kLostWords];
        if (words[0] == 0) continue;
        stats.lost.push_back({frame.sceneIndices[i], words[0], (double(words[1]) + 4294967296.0 * words[2]) / 65536});
        stats.pairsOver += words[0];
    }
    std::ranges::sort(stats.lost, {}, &LightIndexStats::Lost::light);
}

}  // namespace

std::optional<LightingAttempt> judge(const LightIndexFrame& frame, std::span<const uint32_t> counters,
                                     LightIndexStats& stats) {
    stats = frame.stats;
    LightingAttempt next = frame.attempt;
    if (frame.attempt.list) {
        stats.listEntries = counters[kCounterEntries];
        if (stats.listEntries > frame.attempt.entries) {
            // A quarter more, so that a moving view does not ask for more each time.
            next.entries = stats.listEntries + stats.listEntries / 4;
            if (next.entries * 4 > frame.largestBuffer) next.slices *= 2, next.entries = frame.largestBuffer / 4;
            return next;
        }
        if (frame.attempt.slices == 1) {
            stats.mostAtOnce = counters[kCounterMost];
            if (frame.layout) stats.pixelsOver = counters[kCounterPixels], stats.pairsOver = counters[kCounterPairs];
        }
        return std::nullopt;
    }
    stats.pixelsOver = counters[kCounterPixels];
    if (frame.attempt.report)
        tellLost(counters, frame, stats);
    else if (stats.pixelsOver > 0 || frame.drops) {
        next.list = frame.onOverflow == OnOverflow::exact;
        next.report = !next.list;
        next.entries = 0;
        return next;
    }
    if (frame.onOverflow == OnOverflow::fail && stats.pairsOver > 0)
        throw Error(ErrorKind::limit,
                    fmt::format("light-indexed: expected at most {} lights a pixel of the {} that {} tells apart, got "
                                "more at {} pixels: "
                                "{} pairs of a light and a pixel do not fit (on-overflow exact keeps them)",
                                frame.layout->overlap, frame.layout->mostIndex, stats.packing, stats.pixelsOver,
                                stats.pairsOver));
    return std::nullopt;
}

}  // namespace luciole::render
