#include "bench_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>
#include <ranges>

namespace luciole::cli {

std::vector<std::string> allTechniques() {
    std::vector<std::string> names;
    for (const LightingTechniqueInfo& technique : lightingTechniques())
        if (technique.name != "auto" && technique.name != "reference") names.emplace_back(technique.name);
    return names;
}

std::vector<std::string> techniquesNamed(const SettingOptions& options, const RenderSettings& settings) {
    const bool given = std::ranges::any_of(options.values, [](const auto& value) { return value.first == "lighting"; });
    if (!given && settings.lighting == RenderSettings{}.lighting) return {};
    const std::vector<std::string> known = allTechniques();
    if (settings.lighting == "all") return known;
    std::vector<std::string> names;
    for (const auto part : std::views::split(settings.lighting, ',')) {
        const std::string name(part.begin(), part.end());
        if (std::ranges::find(known, name) == known.end() && name != "auto" && name != bench::ideal().name)
            throw Error(ErrorKind::usage, fmt::format("{}: expected one of auto, {}, {}, some of them with commas between, or all, got \"{}\"",
                                                      originOf(options, "lighting"), fmt::join(known, ", "), bench::ideal().name, name));
        names.push_back(name);
    }
    return names;
}

std::vector<bench::Contender> contendersNamed(const std::vector<std::string>& names, const RenderSettings& settings) {
    std::vector<bench::Contender> contenders;
    for (const std::string& name : names) {
        const auto before = std::ranges::count(contenders, name, [](const bench::Contender& other) { return other.settings.lighting; });
        contenders.push_back({before == 0 ? name : fmt::format("{} ({})", name, before + 1), settings});
        contenders.back().settings.lighting = name;
    }
    return contenders;
}

std::vector<Refused> refuse(Renderer& renderer, const View& view, std::vector<bench::Contender>& contenders) {
    std::vector<Refused> refused;
    std::erase_if(contenders, [&](const bench::Contender& contender) {
        try {
            renderer.render(view, contender.settings);
            return false;
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::usage && error.kind() != ErrorKind::limit) throw;
            refused.push_back({contender.name, error.what()});
            return true;
        }
    });
    return refused;
}

std::vector<CellResult> measureCells(Renderer& renderer, const std::vector<Cell>& cells,
                                     const std::function<std::vector<bench::Contender>(const RenderSettings&)>& contendersOf,
                                     const bench::Effort& effort, const Console& console) {
    std::vector<CellResult> results;
    ProgressLine progress(console, "measuring:");
    Scene scene;
    for (size_t i = 0; i < cells.size(); ++i) {
        const Cell& cell = cells[i];
        if (i == 0 || cell.scene.uri != cells[i - 1].scene.uri) {
            scene = luciole::loadScene(cell.scene.uri, {.allowExternal = cell.scene.allowExternal});
            for (const std::string& rig : cell.scene.rigs) applyRig(scene, rig);
            console.warn(scene.warnings);
            renderer.setScene(scene);
        }
        const View view = chooseView(scene, cell.view);
        std::vector<bench::Contender> contenders = contendersOf(cell.settings);
        CellResult& result = results.emplace_back(CellResult{.cell = cell, .lights = uint32_t(scene.lights.size())});
        result.refused = refuse(renderer, view, contenders);
        if (contenders.empty()) continue;
        result.results = bench::measure(renderer, view, contenders, effort,
                                        [&](double share) { progress.show((double(i) + share) / double(cells.size())); });
        bench::count(renderer, view, contenders, result.results);
        result.triangles = result.results.front().stats.triangles;
    }
    return results;
}

}  // namespace luciole::cli
