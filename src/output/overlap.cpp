#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <luciole/error.hpp>
#include <luciole/output.hpp>
#include <string>

#include "output/drawing.hpp"

namespace luciole {
namespace {

constexpr vec3 rgb8(uint32_t hex) {
    return vec3(float(hex >> 16 & 255), float(hex >> 8 & 255), float(hex & 255)) / 255.0f;
}

const vec3 kPage = rgb8(0x282828);
const vec3 kInk = rgb8(0xe0e0e0);
const vec3 kNone =
    rgb8(0x141414);  ///< where no light was evaluated: the only grey of the maps, darker than each colour

/// van der Walt and Smith 2015, viridis, the default colour map of matplotlib 2.0 (CC0): ten of its 256 entries, evenly
/// spaced, sRGB; the values between them interpolated. Perceptually uniform, and its lightness grows all the way, so
/// that it reads in a grey print as well.
/// \param t in [0, 1]
vec3 viridis(float t) {
    constexpr std::array<uint32_t, 10> kColors{0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e,
                                               0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725};
    const float position = t * float(kColors.size() - 1);
    const size_t below = std::min(size_t(position), kColors.size() - 2);
    return glm::mix(rgb8(kColors[below]), rgb8(kColors[below + 1]), position - float(below));
}

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

float largest(const Image& counts) { return *std::max_element(counts.data.begin(), counts.data.end()); }

void drawMap(Image& page, uint32_t x, const Image& counts, const Image& evaluations, float top) {
    for (uint32_t row = 0; row < counts.height; ++row)
        for (uint32_t column = 0; column < counts.width; ++column) {
            const bool covered = evaluations.at(column, row, 0) > 0;
            fillRectangle(page, x + column, row, 1, 1, covered ? viridis(counts.at(column, row, 0) / top) : kNone);
        }
}

std::string statisticsLine(const Image& counts, uint64_t sum, uint64_t coveredPixels) {
    const double mean = coveredPixels == 0 ? 0 : double(sum) / double(coveredPixels);
    return fmt::format("max {:.0f}  mean {:.2f}", largest(counts), mean);
}

/// The least of 1, 2, 5, 10, 20, ... that is no less than `least`: distances between ticks that people like.
uint64_t tickStep(double least) {
    for (uint64_t decade = 1;; decade *= 10)
        for (const uint64_t factor : {1, 2, 5})
            if (double(factor * decade) >= least) return factor * decade;
}

// The legend, from the lower edge of the maps down; in pixels of the font.
constexpr uint32_t kMargin = 6;
constexpr uint32_t kTitleY = 5;
constexpr uint32_t kStatisticsY = 16;
constexpr uint32_t kBarY = 32;
constexpr uint32_t kBarHeight = 8;
constexpr uint32_t kTickHeight = 3;
constexpr uint32_t kNumbersY = 45;
constexpr uint32_t kLegendHeight = 57;
constexpr std::string_view kNoneLabel = "none";

/// The grey of pixels without light, then the scale from 0 to `top`, with numbers.
void drawScale(Image& page, uint32_t mapHeight, uint32_t scale, uint64_t top) {
    const auto y = [&](uint32_t offset) { return mapHeight + offset * scale; };
    const uint32_t margin = kMargin * scale;
    const uint32_t noneWidth = textWidth(kNoneLabel, scale) - scale;  // without the last gap
    fillRectangle(page, margin, y(kBarY), noneWidth, kBarHeight * scale, kNone);
    drawText(page, margin, y(kNumbersY), scale, kNoneLabel, kInk);

    const uint32_t left = margin + noneWidth + 2 * margin;
    const uint32_t width = page.width - margin - left;
    for (uint32_t x = 0; x < width; ++x)
        fillRectangle(page, left + x, y(kBarY), 1, kBarHeight * scale, viridis(float(x) / float(width - 1)));

    const auto drawTick = [&](uint64_t count) {
        const std::string label = fmt::format("{}", count);
        const uint32_t x = left + uint32_t(std::lround(double(width - scale) * double(count) / double(top)));
        fillRectangle(page, x, y(kBarY + kBarHeight), scale, kTickHeight * scale, kInk);
        // Centred below the tick, but never beyond the ends of the scale.
        const uint32_t labelWidth = textWidth(label, scale) - scale;
        const uint32_t centred = x + scale / 2 - std::min(x, labelWidth / 2);
        drawText(page, std::clamp(centred, left, left + width - labelWidth), y(kNumbersY), scale, label, kInk);
    };
    const uint32_t room = textWidth(fmt::format("{}", top), scale) + 4 * margin;  // of the longest number
    const uint64_t step = tickStep(double(top) * room / width);
    for (uint64_t count = 0; count == 0 || (double(top) - double(count)) * width >= double(top) * room; count += step)
        drawTick(count);
    drawTick(top);
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

    // Text keeps its share of the page, from a size that can be read up to one where it would only cost memory.
    const uint32_t scale = std::clamp(evaluations.width / 320, 1u, 8u);
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
    drawScale(page, evaluations.height, scale, uint64_t(top));
    return page;
}

}  // namespace luciole
