#pragma once
#include <string>
#include <utility>
#include <vector>

#include "options.hpp"
#include "view.hpp"

namespace luciole::cli {

/// Something that is varied, and the values that it takes.
struct Axis {
    std::string name;  ///< "size", a setting, or a parameter of built-in scenes
    std::vector<std::string> values;
};

/// From "NAME=VALUE,VALUE,..." \throws Error(usage) naming --sweep
Axis parseAxis(const std::string& text);

/// What is measured in one go: all techniques on one picture.
struct Cell {
    SceneOptions scene;
    ViewOptions view;
    RenderSettings settings;
    std::vector<std::pair<std::string, std::string>> at;  ///< the axes and their values here
};

/// Each scene with each combination of the axes' values, the last axis fastest.
/// \param base its scene's `uri` is not looked at
/// \throws Error(usage) for an axis that is none, or that a scene does not have, and for a value that it can't take
std::vector<Cell> cellsOf(const std::vector<std::string>& scenes, const Cell& base, const std::vector<Axis>& axes);

}  // namespace luciole::cli
