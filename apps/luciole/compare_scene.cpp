#include "compare_scene.hpp"

#include <fmt/format.h>

#include <luciole/error.hpp>
#include <luciole/output.hpp>
#include <luciole/reference.hpp>
#include <report_template.hpp>

#include "interrupt.hpp"
#include "outputs.hpp"

namespace luciole::cli {
namespace {

constexpr std::string_view kMarker = "@LUCIOLE_REPORT@";

/// Without `ideal`, which makes no list of its own.
std::vector<bench::Contender> contendersFor(const SettingOptions& options, const RenderSettings& settings) {
    std::vector<std::string> names = techniquesNamed(options, settings);
    if (names.empty()) names = allTechniques();
    std::erase(names, bench::ideal().name);
    return contendersNamed(names, settings);
}

void check(const SceneComparison& comparison, std::string_view page) {
    const std::filesystem::path file = comparison.file;
    if (file.empty()) throw Error(ErrorKind::usage, "compare: -o FILE.html is required for a scene");
    if (page.find(kMarker) == std::string_view::npos)
        throw Error(ErrorKind::usage, "compare: this build has no report: it was made without Node.js, or before scripts/packages.sh had installed what the page is made of");
    if (comparison.axes.size() > 1) throw Error(ErrorKind::usage, "--sweep: expected one at most, as the report has one chart for it");
    if (file.extension() != ".html") throw Error(ErrorKind::usage, fmt::format("{}: expected a name that ends in .html", file.string()));
    requireWritable(file);
}

Frame referenceOf(const Scene& scene, const View& view, const RenderSettings& settings, const Console& console) {
    ProgressLine progress(console, "reference:");
    return renderReference(scene, view, settings, {}, [&](double share) {
        progress.show(share);
        return true;
    });
}

std::vector<Compared> measureAll(Renderer& renderer, const View& view, const std::vector<bench::Contender>& contenders, const SceneComparison& comparison) {
    std::vector<Compared> compared;
    ProgressLine progress(comparison.request.console, "measuring:");
    std::vector<bench::Measured> results = bench::measure(renderer, view, contenders, comparison.effort, [&](double share) { progress.show(share); });
    bench::count(renderer, view, contenders, results);
    for (size_t i = 0; i < contenders.size(); ++i)
        compared.push_back({std::move(results[i]), renderer.render(view, contenders[i].settings, {"evaluations", "useful-evaluations"})});
    return compared;
}

}  // namespace

void compareScene(const SceneComparison& comparison) {
    const FrameRequest& request = comparison.request;
    const std::string_view page = reportTemplate();
    check(comparison, page);
    const RenderSettings settings = resolve(request.settings);
    std::vector<bench::Contender> contenders = contendersFor(request.settings, settings);
    const std::vector<Cell> cells =
        comparison.axes.empty() ? std::vector<Cell>{} : cellsOf({request.scene.uri}, {.scene = request.scene, .view = request.view, .settings = settings}, comparison.axes);

    const auto [scene, view] = loadSceneAndView(request);
    Renderer renderer(rendererOptions(request));
    renderer.setScene(scene);
    const std::vector<Refused> refused = refuse(renderer, view, contenders);
    const Frame reference = referenceOf(scene, view, settings, request.console);
    const std::vector<Compared> compared = measureAll(renderer, view, contenders, comparison);
    const std::vector<CellResult> sweep = measureCells(
        renderer, cells, [&](const RenderSettings& with) { return contendersFor(request.settings, with); }, comparison.effort, request.console);

    std::string html(page);
    html.replace(html.find(kMarker), kMarker.size(), reportData(comparison, bench::machineOf(renderer.device()), reference, compared, refused, sweep));
    const FinishFirst guard;
    writeFileAtomically(comparison.file, std::as_bytes(std::span(html)));
}

}  // namespace luciole::cli
