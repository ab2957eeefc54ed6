#pragma once
#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>

#include "console.hpp"

namespace luciole::cli {

inline constexpr size_t kLimitCount = 6;  ///< rows of the table of metrics

/// Two pictures as files, and how different they may be.
struct PictureComparison {
    std::string reference, test;  ///< both .exr or both .png
    std::string layer;            ///< of EXR; empty: the picture
    float exposureEv = 0;         ///< ImageDifference
    std::array<std::optional<double>, kLimitCount> limits;
    std::string mapFile;          ///< .png; empty: none
    bool json = false;
};
void addPictureComparisonOptions(CLI::App& command, PictureComparison& comparison);

/// Prints how the test differs from the reference, and writes the map.
/// \return whether it is within the limits or, where there are none, identical
/// \throws Error(usage) for names, layers, shapes and limits that do not go together, Error(io), Error(limit)
bool comparePictures(const PictureComparison& comparison, const Console& console);

}  // namespace luciole::cli
