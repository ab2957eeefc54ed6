#pragma once
#include <string>

#include <luciole/renderer.hpp>

#include "measure.hpp"

namespace luciole::bench {

struct Options {
    int frames;     ///< of each contender
    uvec2 extent;
    std::string folder;  ///< of glTF halls; empty: built-in ones
};

/// What a frame of the hall costs, pass by pass, and what one light costs at one pixel.
void benchFrames(Renderer& renderer, const Options& options);

/// What the shapes of lights save: Markdown tables of milliseconds and counts.
void benchShapes(Renderer& renderer, const Options& options);

/// What light-indexed rendering costs beside what it is compared with, and the article's benchmark with its ratios.
void benchLightIndexed(Renderer& renderer, const Options& options);

/// Lists of lights by tile and cluster beside what people would use instead, and beside the bound that no list can undercut.
void benchTiles(Renderer& renderer, const Options& options);

/// What frames and lists cost from 255 lights to a million.
void benchScaling(Renderer& renderer, const Options& options);

/// What it costs if all lights move every frame: to set them anew, and the frames of the techniques with lists.
void benchMovingLights(Renderer& renderer, const Options& options);

/// How good lighting `auto` is: over a grid of configurations its choice beside the measured best, and the share of those within 10 %.
void benchAdvice(Renderer& renderer, const Options& options);

/// What shadows cost to make, to keep and to use: the article's claim (Calver 2003, "Shadow Maps").
void benchShadows(Renderer& renderer, const Options& options);

}  // namespace luciole::bench
