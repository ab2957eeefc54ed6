#include <fmt/format.h>

#include <algorithm>
#include <luciole/error.hpp>
#include <luciole/output.hpp>
#include <string>

#include "output/drawing.hpp"
#include "output/heat_map.hpp"

namespace luciole {
namespace {

void requireCounts(const Image& evaluations, const Image& useful) {
    const auto shape = [](const Image& image) {
        return fmt::format("{} x {} x {}", image.width, image.height, image.channels);
    };
    if (evaluations.channels != 1 || evaluations.data.empty())
        throw Error(ErrorKind::usage,
                    fmt::format("evaluations: expected an image of 1 channel, got {}", shape(evaluations)));
    if (useful.width != evaluations.width || useful.height != evaluations.height || useful.channels != 1)
        throw Error(ErrorKind::usage, fmt::format("useful-evaluations: expected the shape of evaluations, {}, got {}",
                                                  shape(evaluations), shape(useful)));
}

std::string statisticsLine(const Image& counts, uint64_t sum, uint64_t coveredPixels) {
    const double mean = coveredPixels == 0 ? 0 : double(sum) / double(coveredPixels);
    return fmt::format("max {:.0f}  mean {:.2f}", largest(counts), mean);
}

}  // namespace

OverlapCounts countOverlap(const Image& evaluations, const Image& useful) {
    requireCounts(evaluations, useful);
    OverlapCounts counts;
    for (size_t i = 0; i < evaluations.data.size(); ++i) {
        counts.evaluations += uint64_t(evaluations.data[i]);
        counts.usefulEvaluations += uint64_t(useful.data[i]);
        counts.coveredPixels += evaluations.data[i] > 0 ? 1 : 0;
    }
    return counts;
}

Image overlapHeatMap(const Image& evaluations, const Image& useful) {
    const OverlapCounts counts = countOverlap(evaluations, useful);
    const float top = std::max({largest(evaluations), largest(useful), 1.0f});  // 1: a scale needs two ends
    const std::string_view titles[] = {"lights evaluated", "lights that reach the surface"};
    std::string lines[] = {statisticsLine(evaluations, counts.evaluations, counts.coveredPixels),
                           statisticsLine(useful, counts.usefulEvaluations, counts.coveredPixels)};
    if (counts.evaluations > 0)
        lines[1] +=
            fmt::format("  useful {:.1f} %", 100 * double(counts.usefulEvaluations) / double(counts.evaluations));

    const uint32_t scale = legendScale(evaluations.width);
    const uint32_t margin = kMargin * scale;
    uint32_t column = evaluations.width;
    for (int i = 0; i < 2; ++i)
        column = std::max({column, textWidth(titles[i], scale) + 2 * margin, textWidth(lines[i], scale) + 2 * margin});

    Image page(2 * column + kOverlapGap, evaluations.height + kLegendHeight * scale, 3);
    fillRectangle(page, 0, 0, page.width, page.height, kPage);
    for (int i = 0; i < 2; ++i) {
        const uint32_t x = i == 0 ? 0 : column + kOverlapGap;
        drawMap(page, x, i == 0 ? evaluations : useful, evaluations, top);
        drawText(page, x + margin, evaluations.height + kTitleY * scale, scale, titles[i], kInk);
        drawText(page, x + margin, evaluations.height + kStatisticsY * scale, scale, lines[i], kInk);
    }
    drawScale(page, 0, page.width, evaluations.height, scale, {.top = top});
    return page;
}

}  // namespace luciole
