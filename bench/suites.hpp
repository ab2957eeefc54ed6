#pragma once
#include <algorithm>
#include <vector>

#include <luciole/renderer.hpp>

namespace luciole::bench {

inline double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}
inline double least(const std::vector<double>& values) { return *std::ranges::min_element(values); }

/// What a frame of the hall costs, pass by pass, and what one light costs at one pixel.
void benchFrames(Renderer& renderer, int frames, uvec2 extent);

/// What the shapes of lights save: Markdown tables of milliseconds and counts.
void benchShapes(Renderer& renderer, int frames, uvec2 extent);

/// What light-indexed rendering costs beside what it is compared with, and the article's benchmark with its ratios.
void benchLightIndexed(Renderer& renderer, int frames, uvec2 extent);

}  // namespace luciole::bench
