#pragma once
#include <cstdint>
#include <string_view>

#include <luciole/image.hpp>
#include <luciole/math.hpp>

namespace luciole {

// Both draw into an image of 3 channels; what lies outside of it is cut off.

/// \param x, y upper left corner; all in pixels
void fillRectangle(Image& image, uint32_t x, uint32_t y, uint32_t width, uint32_t height, vec3 color);

/// One line of text, its upper left corner at (x, y). The font has what legends need: digits, `.`, `%` and some small
/// letters; any other character leaves a gap. \param scale pixels per pixel of the font, >= 1
void drawText(Image& image, uint32_t x, uint32_t y, uint32_t scale, std::string_view text, vec3 color);

// Of a character, before `scale`: 5 columns and a gap; 7 rows and one for what hangs below the line.
inline constexpr uint32_t kCharacterWidth = 6;
inline constexpr uint32_t kCharacterHeight = 8;

/// Pixels, with the gap after the last character.
inline uint32_t textWidth(std::string_view text, uint32_t scale) {
    return uint32_t(text.size()) * kCharacterWidth * scale;
}

}  // namespace luciole
