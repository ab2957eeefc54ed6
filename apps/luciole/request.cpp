#include "request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <luciole/error.hpp>

#include "default_light.hpp"

namespace luciole::cli {
namespace {

void addDefaultLightOption(CLI::App& command, FrameRequest& request) {
    addParsed(
        command, "--default-light",
        [&](const std::string& text) {
            if (text != "auto" && text != "off")
                throw Error(ErrorKind::usage, fmt::format("--default-light: expected auto or off, got \"{}\"", text));
            request.defaultLight = text == "auto";
        },
        "auto: light a scene that has no light of its own [auto]")
        ->type_name("auto|off")
        ->group("Scene");
}

/// Where programs may keep what they can do without (XDG Base Directory Specification); empty: nowhere.
std::string cacheFolder() {
    const char *folder = std::getenv("XDG_CACHE_HOME"), *home = std::getenv("HOME");
    if (folder && *folder == '/') return std::string(folder) + "/luciole";
    return home && *home == '/' ? std::string(home) + "/.cache/luciole" : "";
}

}  // namespace

void addSceneAndViewOptions(CLI::App& command, FrameRequest& request) {
    addScene(command, request.scene);
    addFrameOptions(command, request);
}

void addFrameOptions(CLI::App& command, FrameRequest& request) {
    addSceneFileOptions(command, request.scene);
    addDefaultLightOption(command, request);
    addViewOptions(command, request.view);
    addSettingOptions(command, request.settings);
}

SceneAndView loadSceneAndView(const FrameRequest& request) {
    SceneAndView loaded{.scene = loadScene(request.scene, request.console)};
    loaded.view = chooseView(loaded.scene, request.view);
    if (request.defaultLight && needsDefaultLight(loaded.scene)) {
        addDefaultLight(loaded.scene, loaded.view.camera);
        request.console.note("the scene has no light; added a soft one (--default-light off leaves it dark)");
    }
    return loaded;
}

RendererOptions rendererOptions(const FrameRequest& request) {
    RendererOptions options = request.renderer;
    options.cacheFolder = cacheFolder();
    return options;
}

void requireTechnique(const SettingOptions& options, const std::string& name) {
    const auto& known = lightingTechniques();
    if (std::any_of(known.begin(), known.end(), [&](const auto& technique) { return technique.name == name; })) return;
    std::string names;
    for (const auto& technique : known) names += fmt::format("{}{}", names.empty() ? "" : ", ", technique.name);
    throw Error(ErrorKind::usage,
                fmt::format("{}: expected one of {}, got \"{}\"", originOf(options, "lighting"), names, name));
}

}  // namespace luciole::cli
