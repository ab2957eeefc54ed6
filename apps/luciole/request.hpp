#pragma once
#include "options.hpp"
#include "view.hpp"

namespace luciole::cli {

/// What every command that makes frames is asked for: the scene, how it is seen, and on which device.
struct FrameRequest {
    SceneOptions scene;
    bool defaultLight = true;
    ViewOptions view;
    SettingOptions settings;
    RendererOptions renderer = deviceDefaults();
    Console console;
};
void addSceneAndViewOptions(CLI::App& command, FrameRequest& request);
void addFrameOptions(CLI::App& command, FrameRequest& request);  ///< those of them that are not the scene itself

/// The scene, with a light if it needs one, and the view of it.
struct SceneAndView {
    Scene scene;
    View view;
};
SceneAndView loadSceneAndView(const FrameRequest& request);

/// What the renderer is made with: the device options, and where it keeps what it found out.
RendererOptions rendererOptions(const FrameRequest& request);

/// \throws Error(usage) unless there is a lighting technique `name`
void requireTechnique(const SettingOptions& options, const std::string& name);

}  // namespace luciole::cli
