#include "output/heat_map.hpp"

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

constexpr uint32_t kTickHeight = 3;

}  // namespace

vec3 rgb8(uint32_t hex) { return vec3(float(hex >> 16 & 255), float(hex >> 8 & 255), float(hex & 255)) / 255.0f; }

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

uint32_t legendScale(uint32_t mapWidth) { return std::clamp(mapWidth / 320, 1u, 8u); }

double tickStep(double least) {
    for (double decade = std::pow(10, std::floor(std::log10(least)));; decade *= 10)
        for (const double factor : {1, 2, 5})
            if (factor * decade >= least) return factor * decade;
}

float largest(const Image& counts) { return *std::max_element(counts.data.begin(), counts.data.end()); }

void drawMap(Image& page, uint32_t x, const Image& counts, const Image& covered, float top) {
    for (uint32_t row = 0; row < counts.height; ++row)
        for (uint32_t column = 0; column < counts.width; ++column) {
            const bool here = covered.at(column, row, 0) > 0;
            fillRectangle(page, x + column, row, 1, 1, here ? viridis(counts.at(column, row, 0) / top) : kNone);
        }
}

void drawScale(Image& page, uint32_t left, uint32_t right, uint32_t mapHeight, uint32_t scale, const MapScale& colors) {
    const auto y = [&](uint32_t offset) { return mapHeight + offset * scale; };
    const uint32_t margin = kMargin * scale;
    const uint32_t greyWidth = textWidth(colors.grey, scale) - scale;  // without the last gap
    fillRectangle(page, left + margin, y(kBarY), greyWidth, kBarHeight * scale, kNone);
    drawText(page, left + margin, y(kNumbersY), scale, colors.grey, kInk);

    left += greyWidth + 3 * margin;
    const uint32_t width = right - margin - left;
    for (uint32_t x = 0; x < width; ++x)
        fillRectangle(page, left + x, y(kBarY), 1, kBarHeight * scale, viridis(float(x) / float(width - 1)));

    const double top = colors.top;
    const auto labelOf = [&](double value) { return fmt::format("{:.{}f}", value, colors.decimals); };
    const auto drawTick = [&](double value) {
        const std::string label = labelOf(value);
        const uint32_t x = left + uint32_t(std::lround((width - scale) * value / top));
        fillRectangle(page, x, y(kBarY + kBarHeight), scale, kTickHeight * scale, kInk);
        // Centred below the tick, but never beyond the ends of the scale.
        const uint32_t labelWidth = textWidth(label, scale) - scale;
        const uint32_t centred = x + scale / 2 - std::min(x, labelWidth / 2);
        drawText(page, std::clamp(centred, left, left + width - labelWidth), y(kNumbersY), scale, label, kInk);
    };
    const double room = textWidth(labelOf(top), scale) + 4 * margin;  // of the longest number
    const double step = tickStep(std::max(top * room / width, std::pow(10, -colors.decimals)));
    drawTick(0);
    for (int i = 1; (top - i * step) * width >= top * room; ++i) drawTick(i * step);
    drawTick(top);
}

Image heatMap(const Image& values, float top) {
    if (values.channels != 1 || values.data.empty() || !(top > 0))
        throw Error(ErrorKind::usage, fmt::format("heat map: expected an image of 1 channel and a scale, got {} x {} x {} up to {}", values.width, values.height, values.channels, top));
    Image finite = values;
    for (float& value : finite.data)
        if (!std::isfinite(value)) value = 0;
    Image page(values.width, values.height, 3);
    drawMap(page, 0, finite, finite, top);
    return page;
}

}  // namespace luciole
