#include "output/drawing.hpp"

#include <algorithm>
#include <array>

namespace luciole {
namespace {

/// Glyphs side by side, `kCharacterWidth` columns each.
struct Glyphs {
    std::string_view characters;
    std::array<std::string_view, kCharacterHeight> rows;
};

constexpr std::array kFont{
    // clang-format off
    Glyphs{"0123456789.%", {
        " ###    #    ###   ###     #  #####   ##  #####  ###   ###        ##   ",
        "#   #  ##   #   # #   #   ##  #      #        # #   # #   #       ##  #",
        "#   #   #       #     #  # #  ####  #        #  #   # #   #          # ",
        "#   #   #     ##    ##  #  #      # ####    #    ###   ####         #  ",
        "#   #   #    #        # #####     # #   #  #    #   #     #        #   ",
        "#   #   #   #     #   #    #  #   # #   #  #    #   #    #   ##   #  ##",
        " ###   ###  #####  ###     #   ###   ###   #     ###   ##    ##      ##",
        "                                                                       "}},
    Glyphs{"acdefghilmnoprstuvx", {
        "                #         ##        #       #    ##                                        #                     ",
        "                #        #  #       #             #                                        #                     ",
        " ###   ###   ## #  ###   #     #### # ##   ##     #   ## #  # ##   ###  ####  # ##   #### ###   #   # #   # #   #",
        "    # #     #  ## #   # ###   #   # ##  #   #     #   # # # ##  # #   # #   # ##  # #      #    #   # #   #  # # ",
        " #### #     #   # #####  #    #   # #   #   #     #   # # # #   # #   # #   # #      ###   #    #   # #   #   #  ",
        "#   # #   # #  ## #      #     #### #   #   #     #   # # # #   # #   # ####  #         #  #  # #  ##  # #   # # ",
        " ####  ###   ## #  ###   #        # #   #  ###   ###  # # # #   #  ###  #     #     ####    ##   ## #   #   #   #",
        "                               ###                                      #                                        "}},
    // clang-format on
};

bool isInk(char character, uint32_t column, uint32_t row) {
    for (const Glyphs& glyphs : kFont)
        if (const size_t index = glyphs.characters.find(character); index != std::string_view::npos)
            return glyphs.rows[row][index * kCharacterWidth + column] == '#';
    return false;
}

}  // namespace

void fillRectangle(Image& image, uint32_t x, uint32_t y, uint32_t width, uint32_t height, vec3 color) {
    for (uint32_t row = y; row < std::min(y + height, image.height); ++row)
        for (uint32_t column = x; column < std::min(x + width, image.width); ++column)
            for (uint32_t c = 0; c < 3; ++c) image.at(column, row, c) = color[int(c)];
}

void drawText(Image& image, uint32_t x, uint32_t y, uint32_t scale, std::string_view text, vec3 color) {
    for (const char character : text) {
        for (uint32_t row = 0; row < kCharacterHeight; ++row)
            for (uint32_t column = 0; column + 1 < kCharacterWidth; ++column)
                if (isInk(character, column, row))
                    fillRectangle(image, x + column * scale, y + row * scale, scale, scale, color);
        x += kCharacterWidth * scale;
    }
}

}  // namespace luciole
