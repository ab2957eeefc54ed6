#include <fmt/format.h>

#include <algorithm>
#include <luciole/error.hpp>

#include "render/lighting/light_index.hpp"

namespace luciole::render {

using namespace shared;

namespace {

void tellLost(std::span<const uint32_t> counters, const GpuScene& scene, LightIndexStats& stats) {
    for (uint32_t i = 0; i < scene.lightCount(); ++i) {
        const uint32_t* words = &counters[kCounterCount + size_t(i) * kLostWords];
        if (words[0] == 0) continue;
        stats.lost.push_back(
            {scene.lights().sources[i].sceneIndex, words[0], (double(words[1]) + 4294967296.0 * words[2]) / 65536});
        stats.pairsOver += words[0];
    }
    std::ranges::sort(stats.lost, {}, &LightIndexStats::Lost::light);
}

}  // namespace

std::optional<LightIndexAttempt> judge(const LightIndexFrame& frame, std::span<const uint32_t> counters,
                                       const RenderSettings& settings, const GpuScene& scene, uint64_t largestBuffer,
                                       LightIndexStats& stats) {
    stats = frame.stats;
    LightIndexAttempt next = frame.attempt;
    if (frame.attempt.list) {
        stats.listEntries = counters[kCounterEntries];
        if (stats.listEntries > frame.attempt.entries) {
            // A quarter more, so that a moving view does not ask for more each time.
            next.entries = stats.listEntries + stats.listEntries / 4;
            if (next.entries * 4 > largestBuffer) next.slices *= 2, next.entries = largestBuffer / 4;
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
        tellLost(counters, scene, stats);
    else if (stats.pixelsOver > 0 || !frame.dropped.empty()) {
        next.list = settings.onOverflow == OnOverflow::exact;
        next.report = !next.list;
        next.entries = 0;
        return next;
    }
    if (settings.onOverflow == OnOverflow::fail && stats.pairsOver > 0)
        throw Error(ErrorKind::limit,
                    fmt::format("light-indexed: expected at most {} lights a pixel of the {} that {} tells apart, got "
                                "more at {} pixels: "
                                "{} pairs of a light and a pixel do not fit (on-overflow exact keeps them)",
                                frame.layout->overlap, frame.layout->mostIndex, stats.packing, stats.pixelsOver,
                                stats.pairsOver));
    return std::nullopt;
}

}  // namespace luciole::render
