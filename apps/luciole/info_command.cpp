#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "options.hpp"

namespace luciole::cli {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
    SceneOptions scene;
    Console console;
    bool json = false;
};

// Names of enum values, each list in the order of its enum.
constexpr std::array<std::string_view, 3> kLightTypes{"directional", "point", "spot"};
constexpr std::array<std::string_view, 3> kEquations{"metallic-roughness", "shaped", "unlit"};

std::array<size_t, 3> countLights(const Scene& scene) {
    std::array<size_t, 3> counts{};
    for (const Light& light : scene.lights) ++counts[size_t(light.type)];
    return counts;
}

Json jsonOf(vec3 v) { return {v.x, v.y, v.z}; }

std::string infoJson(const Scene& scene) {
    const Bounds bounds = boundsOf(scene);
    Json json{{"name", scene.name},
              {"triangles", triangleCount(scene)},
              {"meshes", scene.meshes.size()},
              {"objects", scene.objects.size()},
              {"textures", scene.textures.size()},
              {"functions", scene.functions.size()},
              {"linkGroups", scene.linkGroups.size()},
              {"bounds", {{"low", jsonOf(bounds.low)}, {"high", jsonOf(bounds.high)}}},
              {"exposure", scene.exposureEv},
              {"ambience", {{"sky", jsonOf(scene.ambience.sky)}, {"ground", jsonOf(scene.ambience.ground)}}}};
    const auto counts = countLights(scene);
    json["lights"]["total"] = scene.lights.size();
    for (size_t i = 0; i < counts.size(); ++i) json["lights"][std::string(kLightTypes[i])] = counts[i];
    json["cameras"] = Json::array();
    for (const Camera& camera : scene.cameras)
        json["cameras"].push_back({{"name", camera.name}, {"orthographic", camera.orthographic}});
    json["materials"] = Json::array();
    for (const Material& material : scene.materials)
        json["materials"].push_back({{"name", material.name}, {"equation", kEquations[size_t(material.equation)]}});
    json["warnings"] = scene.warnings;
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

/// One line per element with its index; the first ones only, as scenes may have thousands.
template <typename T, typename Describe>
std::string list(std::string_view title, const std::vector<T>& elements, Describe describe) {
    constexpr size_t kShown = 32;
    std::string text = fmt::format("{:<11}{}\n", title, elements.size());
    for (size_t i = 0; i < std::min(elements.size(), kShown); ++i)
        text += fmt::format("  {:>4}  {} ({})\n", i, printable(elements[i].name), describe(elements[i]));
    if (elements.size() > kShown)
        text += fmt::format("  ... and {} more; --json lists all\n", elements.size() - kShown);
    return text;
}

std::string infoText(const Scene& scene) {
    const Bounds bounds = boundsOf(scene);
    const auto counts = countLights(scene);
    std::string text = fmt::format("{:<11}{}\n", "triangles", triangleCount(scene));
    text += fmt::format("{:<11}{} of {} meshes\n", "objects", scene.objects.size(), scene.meshes.size());
    text += fmt::format("{:<11}{}\n", "textures", scene.textures.size());
    text += fmt::format("{:<11}({:.3f}, {:.3f}, {:.3f}) to ({:.3f}, {:.3f}, {:.3f}) m\n", "bounds", bounds.low.x,
                        bounds.low.y, bounds.low.z, bounds.high.x, bounds.high.y, bounds.high.z);
    text += fmt::format("{:<11}{}: {} directional, {} point, {} spot\n", "lights", scene.lights.size(), counts[0],
                        counts[1], counts[2]);
    text += list("cameras", scene.cameras, [](const Camera& camera) {
        return camera.orthographic ? std::string("orthographic")
                                   : fmt::format("perspective, {:.1f} degrees", double(camera.yFov) * 180 / kPi);
    });
    text += list("materials", scene.materials,
                 [](const Material& material) { return kEquations[size_t(material.equation)]; });
    return text;
}

void run(const InfoOptions& options) {
    const Scene scene = loadScene(options.scene, options.console);
    fmt::print("{}", options.json ? infoJson(scene) + "\n" : infoText(scene));
}

}  // namespace

void addInfoCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("info", "say what a scene holds");
    const auto options = std::make_shared<InfoOptions>();
    addSceneOptions(*command, options->scene);
    command->add_flag("--json", options->json, "print JSON");
    addConsoleOptions(*command, options->console);
    command->callback([options] { run(*options); });
}

}  // namespace luciole::cli
