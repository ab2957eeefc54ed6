#pragma once
#include <cstdint>
#include <string_view>

#include <luciole/image.hpp>
#include <luciole/math.hpp>

/// What pictures of counts and errors have in common: maps at the top of a page, and below them a legend.
namespace luciole {

vec3 rgb8(uint32_t hex);
vec3 viridis(float t);

inline const vec3 kPage = vec3(0x28) / 255.0f;
inline const vec3 kInk = vec3(0xe0) / 255.0f;
inline const vec3 kNone = vec3(0x14) / 255.0f;  ///< where nothing was counted: the only grey of the maps, darker than each colour

// The legend, from the lower edge of the maps down; in pixels of the font.
inline constexpr uint32_t kMargin = 6;
inline constexpr uint32_t kTitleY = 5;
inline constexpr uint32_t kStatisticsY = 16;
inline constexpr uint32_t kBarY = 32;
inline constexpr uint32_t kBarHeight = 8;
inline constexpr uint32_t kNumbersY = 45;
inline constexpr uint32_t kLegendHeight = 57;

/// Text keeps its share of the page, from a size that can be read up to one where it would only cost memory. \return pixels per pixel of
/// the font
uint32_t legendScale(uint32_t mapWidth);

/// The least of ..., 0.5, 1, 2, 5, 10, 20, ... that is no less than `least`, > 0: numbers that people like on a scale.
double tickStep(double least);

float largest(const Image& counts);

/// Counts or errors as colours from 0 to `top`, grey where `covered` is not above 0. \param x of the map's left edge
void drawMap(Image& page, uint32_t x, const Image& counts, const Image& covered, float top);

/// What the colours of a map stand for.
struct MapScale {
    double top;                      ///< the last colour; the first is 0
    int decimals = 0;                ///< of the numbers at the scale; counts have none
    std::string_view grey = "none";  ///< what grey pixels are
};

/// The grey, then the colours with numbers, between x = `left` and `right` of the page.
void drawScale(Image& page, uint32_t left, uint32_t right, uint32_t mapHeight, uint32_t scale, const MapScale& colors);

}  // namespace luciole
