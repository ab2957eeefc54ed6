#include "view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <luciole/error.hpp>

namespace luciole::cli {
namespace {

std::optional<size_t> indexOf(const std::vector<Camera>& cameras, const std::string& wanted) {
    const auto named =
        std::find_if(cameras.begin(), cameras.end(), [&](const Camera& camera) { return camera.name == wanted; });
    if (named != cameras.end()) return size_t(named - cameras.begin());
    size_t index = 0;
    const auto [end, code] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    if (code != std::errc() || end != wanted.data() + wanted.size() || index >= cameras.size()) return std::nullopt;
    return index;
}

Camera chooseCamera(const Scene& scene, const std::string& wanted) {
    if (wanted == "auto" || (wanted.empty() && scene.cameras.empty())) return autoCamera(scene);
    if (wanted.empty()) return scene.cameras.front();
    const std::optional<size_t> index = indexOf(scene.cameras, wanted);
    if (!index)
        throw Error(ErrorKind::usage,
                    fmt::format("--camera: expected a name or index of the scene's {} cameras, or auto, got \"{}\"; "
                                "`luciole info` lists them",
                                scene.cameras.size(), wanted));
    return scene.cameras[*index];
}

}  // namespace

void addViewOptions(CLI::App& command, ViewOptions& options) {
    addParsed(
        command, "--size", [&](const std::string& text) { options.size = parseSize("--size", text); },
        fmt::format("picture size in pixels [{}x{}]", options.size.x, options.size.y))
        ->type_name("WxH")
        ->group("View");
    command
        .add_option("--camera", options.camera,
                    "camera of the scene by name or index; auto shows all of the scene [the first, else auto]")
        ->type_name("NAME|INDEX|auto")
        ->group("View");
    addParsed(
        command, "--look-at",
        [&](const std::string& text) {
            options.lookAt = parseNumbers("--look-at", text, 6);
            if (std::equal(options.lookAt.begin(), options.lookAt.begin() + 3, options.lookAt.begin() + 3))
                throw Error(ErrorKind::usage, "--look-at: the eye and the target are the same point");
        },
        "move the camera: eye and target in metres, world space")
        ->type_name("EX,EY,EZ,TX,TY,TZ")
        ->group("View");
    addParsed(
        command, "--fov",
        [&](const std::string& text) {
            options.fov = parseNumber("--fov", text);
            if (!(*options.fov > 0 && *options.fov < 180))
                throw Error(ErrorKind::usage, fmt::format("--fov: expected above 0 and below 180, got {}", text));
        },
        "vertical field of view")
        ->type_name("DEGREES")
        ->group("View");
}

View chooseView(const Scene& scene, const ViewOptions& options) {
    View view{.camera = chooseCamera(scene, options.camera), .extent = options.size};
    if (!options.lookAt.empty()) {
        const auto& p = options.lookAt;
        view.camera.worldFromView = lookAt(vec3(p[0], p[1], p[2]), vec3(p[3], p[4], p[5]));
    }
    if (options.fov) {
        if (view.camera.orthographic) throw Error(ErrorKind::usage, "--fov: the camera is orthographic");
        view.camera.yFov = float(*options.fov * kPi / 180);
    }
    return view;
}

}  // namespace luciole::cli
