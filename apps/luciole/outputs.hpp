#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <luciole/output.hpp>
#include <luciole/renderer.hpp>

#include "options.hpp"

namespace luciole::cli {

enum class Shown { picture, overlap, clusters };

/// What is shown of a rendered picture, and where it goes.
struct OutputOptions {
    Shown shown = Shown::picture;
    std::vector<std::string> files;  ///< .png or .exr
    int bits = 8;                    ///< of PNG
    ExrType exrType = ExrType::half;
    std::vector<std::string> aovs;  ///< layers of EXR that are asked for by name
    std::string graphFile;          ///< Graphviz; empty: none
};
void addOutputOptions(CLI::App& command, OutputOptions& options);

/// Finds before the rendering what would otherwise fail after it.
/// \throws Error(usage) for names and combinations, Error(io) for folders
void checkOutputs(const OutputOptions& options);

/// The layers to render: those that are asked for by name, and those that are shown.
std::vector<std::string> neededAovs(const OutputOptions& options);

void writeOutputs(const OutputOptions& options, const Frame& frame);

/// \param wanted with its dot, lower case; `file` may have capitals
bool hasExtension(const std::filesystem::path& file, std::string_view wanted);

/// \throws Error(io) if `file` can't be made or replaced
void requireWritable(const std::filesystem::path& file);

}  // namespace luciole::cli
