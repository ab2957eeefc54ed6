#pragma once
#include <optional>
#include <string>
#include <vector>

#include <luciole/renderer.hpp>

#include "options.hpp"

namespace luciole::cli {

/// What is looked at, and how large the picture gets.
struct ViewOptions {
    uvec2 size = View{}.extent;
    std::string camera;          ///< name, index, "auto", or empty: the scene's first camera, else auto
    std::vector<double> lookAt;  ///< eye x, y, z, target x, y, z; or empty
    std::optional<double> fov;   ///< vertical, degrees
};
void addViewOptions(CLI::App& command, ViewOptions& options);

/// \throws Error(usage) for a camera that the scene does not have
View chooseView(const Scene& scene, const ViewOptions& options);

}  // namespace luciole::cli
