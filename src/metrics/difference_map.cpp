#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <luciole/metrics.hpp>
#include <string>
#include <vector>

#include "output/drawing.hpp"
#include "output/heat_map.hpp"

namespace luciole {
namespace {

constexpr uint32_t kGap = 4;  ///< pixels between the maps

/// Three digits that count, without the exponent that the legend's font could not show.
std::string plain(double value) {
    const int decimals = value > 0 ? std::clamp(2 - int(std::floor(std::log10(value))), 0, 9) : 0;
    return fmt::format("{:.{}f}", value, decimals);
}

struct Column {
    const Image& errors;
    double unit;  ///< that the map counts in
    std::string title, statistics;
    MapScale scale;
};

Column relativeErrorColumn(const ImageDifference& difference) {
    const ErrorSummary& error = difference.relativeError;
    constexpr double kPercent = 0.01;
    constexpr double kLeastTop = 1e-4, kMostTop = 1e9;  // rounding to floats is 6e-6 %; beyond, nobody reads the number
    const double top = tickStep(std::clamp(error.p999 / kPercent, kLeastTop, kMostTop));
    return {difference.relativeErrorMap, kPercent, "relative error in %",
            fmt::format("max {}  p99.9 {}  mean {}", plain(error.max / kPercent), plain(error.p999 / kPercent), plain(error.mean / kPercent)),
            {.top = top, .decimals = std::max(0, 1 - int(std::floor(std::log10(top) + 1e-9))), .grey = "not finite"}};
}

Column flipColumn(const ImageDifference& difference) {
    return {*difference.flipMap, 1, "flip error", fmt::format("max {}  mean {}", plain(difference.flip.max), plain(difference.flip.mean)),
            {.top = 1, .decimals = 1, .grey = "not finite"}};
}

void drawErrors(Image& page, uint32_t x, const Column& column) {
    Image shown = column.errors, finite = column.errors;
    for (float& value : finite.data) value = std::isfinite(value) ? 1 : 0;
    for (float& value : shown.data) value = float(std::min(value / column.unit, column.scale.top));
    drawMap(page, x, shown, finite, float(column.scale.top));
}

}  // namespace

Image differenceMap(const ImageDifference& difference) {
    std::vector<Column> columns{relativeErrorColumn(difference)};
    if (difference.flipMap) columns.push_back(flipColumn(difference));
    const Image& map = difference.relativeErrorMap;
    const uint32_t scale = legendScale(map.width), margin = kMargin * scale;
    uint32_t width = map.width;
    for (const Column& column : columns)
        width = std::max({width, textWidth(column.title, scale) + 2 * margin, textWidth(column.statistics, scale) + 2 * margin});

    Image page(uint32_t(columns.size()) * (width + kGap) - kGap, map.height + kLegendHeight * scale, 3);
    fillRectangle(page, 0, 0, page.width, page.height, kPage);
    uint32_t x = 0;
    for (const Column& column : columns) {
        drawErrors(page, x, column);
        drawText(page, x + margin, map.height + kTitleY * scale, scale, column.title, kInk);
        drawText(page, x + margin, map.height + kStatisticsY * scale, scale, column.statistics, kInk);
        drawScale(page, x, x + width, map.height, scale, column.scale);
        x += width + kGap;
    }
    return page;
}

}  // namespace luciole
