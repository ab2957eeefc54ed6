#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <luciole/error.hpp>
#include <luciole/output.hpp>
#include <set>
#include <string>

#include "output/drawing.hpp"
#include "output/heat_map.hpp"

namespace luciole {
namespace {

/// Hues a golden section of the circle apart: neighbours differ much, and no two slices of a picture are the same.
vec3 sliceColor(float slice) {
    const float golden = 0.618034f;
    const float hue = 6 * (slice * golden - std::floor(slice * golden));
    const auto channel = [&](float shift) { return std::clamp(std::abs(std::fmod(hue + shift, 6.0f) - 3) - 1, 0.0f, 1.0f); };
    return 0.3f + 0.65f * vec3(channel(0), channel(4), channel(2));
}

/// Slices in their colours, tiles as the squares of a chessboard.
void drawSlices(Image& page, uint32_t x, const Image& slices, uint32_t tileSize) {
    for (uint32_t row = 0; row < slices.height; ++row)
        for (uint32_t column = 0; column < slices.width; ++column) {
            const float slice = slices.at(column, row, 0);
            const bool dark = (row / tileSize + column / tileSize) % 2 == 1;
            fillRectangle(page, x + column, row, 1, 1, slice < 0 ? kNone : (dark ? 0.8f : 1.0f) * sliceColor(slice));
        }
}

/// The colours of the slices that there are, from near to far.
void drawSwatches(Image& page, uint32_t left, uint32_t right, uint32_t mapHeight, uint32_t scale, const std::set<float>& slices) {
    const uint32_t margin = kMargin * scale;
    const uint32_t width = right - left - 2 * margin;
    uint32_t i = 0;
    for (const float slice : slices) {
        const auto edge = [&](uint32_t n) { return left + margin + uint32_t(uint64_t(width) * n / slices.size()); };
        fillRectangle(page, edge(i), mapHeight + kBarY * scale, edge(i + 1) - edge(i), kBarHeight * scale, sliceColor(slice));
        ++i;
    }
    drawText(page, left + margin, mapHeight + kNumbersY * scale, scale, "near", kInk);
    drawText(page, right - margin - textWidth("far", scale), mapHeight + kNumbersY * scale, scale, "far", kInk);
}

}  // namespace

Image lightListMap(const Image& lengths, const Image& slices, uint32_t tileSize) {
    if (lengths.channels != 1 || lengths.data.empty() || slices.channels != 1 || slices.width != lengths.width || slices.height != lengths.height)
        throw Error(ErrorKind::usage, fmt::format("list-length, list-slice: expected two images of 1 channel and one size, got {} x {} x {} and {} x {} x {}", lengths.width,
                                                  lengths.height, lengths.channels, slices.width, slices.height, slices.channels));
    double sum = 0;
    uint64_t covered = 0;
    for (const float length : lengths.data) sum += length, covered += length > 0;
    std::set<float> found(slices.data.begin(), slices.data.end());
    found.erase(found.begin(), found.lower_bound(0));
    const std::string_view titles[] = {"lights in the list", "tiles and slices of depth"};
    const std::string lines[] = {fmt::format("max {:.0f}  mean {:.2f}", largest(lengths), covered == 0 ? 0 : sum / double(covered)),
                                 fmt::format("tile side {}  slices {}", tileSize, found.size())};
    const float top = std::max(largest(lengths), 1.0f);  // 1: a scale needs two ends
    const uint32_t scale = legendScale(lengths.width);
    const uint32_t margin = kMargin * scale;
    uint32_t column = lengths.width;
    for (int i = 0; i < 2; ++i) column = std::max({column, textWidth(titles[i], scale) + 2 * margin, textWidth(lines[i], scale) + 2 * margin});
    const uint32_t right = column + kOverlapGap;

    Image page(right + column, lengths.height + kLegendHeight * scale, 3);
    fillRectangle(page, 0, 0, page.width, page.height, kPage);
    drawMap(page, 0, lengths, lengths, top);
    drawSlices(page, right, slices, tileSize);
    for (int i = 0; i < 2; ++i) {
        const uint32_t x = (i == 0 ? 0 : right) + margin;
        drawText(page, x, lengths.height + kTitleY * scale, scale, titles[i], kInk);
        drawText(page, x, lengths.height + kStatisticsY * scale, scale, lines[i], kInk);
    }
    drawScale(page, 0, column, lengths.height, scale, {.top = top});
    drawSwatches(page, right, page.width, lengths.height, scale, found);
    return page;
}

}  // namespace luciole
