#include "render/advice/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <luciole/error.hpp>
#include <numeric>

#include "render/lighting/light_index_plan.hpp"

namespace luciole::render {
namespace {

using Counts = const SceneCounts&;
using Settings = const RenderSettings&;

double one(Counts, Settings) { return 1; }
double pixels(Counts c, Settings) { return c.pixels; }
double covered(Counts c, Settings) { return c.covered; }
double fragments(Counts c, Settings s) { return s.depthPrepass ? c.covered : c.fragments; }
double triangles(Counts c, Settings) { return c.triangles; }
/// Pixels along the edges of triangles, about, which devices shade in blocks: n triangles of equal size have a circumference of so much.
double edges(Counts c, Settings) { return std::sqrt(c.triangles * c.fragments); }
double blended(Counts c, Settings) { return c.blended; }
double blendedLights(Counts c, Settings) { return c.blended * c.lights; }
double blendedEdges(Counts c, Settings) { return std::sqrt(c.triangles * c.blended); }
double blendedEdgeLights(Counts c, Settings s) { return blendedEdges(c, s) * c.lights; }
double blendedFrame(Counts c, Settings) { return c.blended > 0 ? 1 : 0; }
double blendedTriangles(Counts c, Settings) { return c.blended > 0 ? c.triangles : 0; }
double edgeLights(Counts c, Settings s) { return edges(c, s) * c.lights + blendedEdgeLights(c, s); }
double allLights(Counts c, Settings) { return c.covered * c.lights; }
double lights(Counts c, Settings) { return c.lights; }
double visible(Counts c, Settings) { return c.visible; }
double shapeTriangles(Counts c, Settings) { return c.shapeTriangles; }
double everywhere(Counts c, Settings) { return c.covered * c.unbounded; }
double inRectangle(Counts c, Settings) { return c.inRectangle; }
double behindNearest(Counts c, Settings) { return c.behindNearest; }
double onShape(Counts c, Settings) { return c.onShape; }
double behindFace(Counts c, Settings) { return c.behindFace; }
double reaching(Counts c, Settings) { return c.reaching; }
double inTile(Counts c, Settings s) { return c.inTile + everywhere(c, s); }
double inCluster(Counts c, Settings s) { return c.inCluster + everywhere(c, s); }
/// Clusters reach from the nearest to the farthest surface that blends, so that each finds some share of what lies before the opaque one.
double blendedInCluster(Counts c, Settings) { return c.blendedBehindFront + c.blended * c.unbounded; }
double blendedEdgeInCluster(Counts c, Settings s) { return c.blended > 0 ? blendedEdges(c, s) * blendedInCluster(c, s) / c.blended : 0; }
double edgeInCluster(Counts c, Settings s) {
    return (c.covered > 0 ? edges(c, s) * inCluster(c, s) / c.covered : 0) + blendedEdgeInCluster(c, s);
}

/// Whether light-indexed rendering indexes all lights before a surface, not only those that reach it.
bool indexesBefore(Counts c, Settings s) {
    return s.lidrCover == LidrCover::frontFaces || (s.lidrCover == LidrCover::automatic && c.blended > 0);
}
/// Whether it makes lists, because the packing has not enough room.
bool lists(Counts c, Settings s) {
    if (s.lidrPacking == LidrPacking::list) return true;
    const IndexLayout layout = indexLayout(s, uint32_t(c.lights));
    if (layout.mostIndex < c.lights) return true;
    return !layout.sorted && (indexesBefore(c, s) ? c.mostBefore : c.mostReaching) + uint32_t(c.unbounded) > layout.overlap;
}
/// Lists are for a pixel, so with several samples they hold what lies before any of them.
bool evaluatesBefore(Counts c, Settings s) { return indexesBefore(c, s) || (s.msaa != Msaa::x1 && lists(c, s)); }
/// What of its light volumes is drawn: back faces behind the surface, or front faces before it.
double indexFragments(Counts c, Settings s) { return (evaluatesBefore(c, s) ? c.behindFront : c.beforeBack) + everywhere(c, s); }
double indexed(Counts c, Settings s) { return (evaluatesBefore(c, s) ? c.surfaceBehindFront : c.reaching) + everywhere(c, s); }
/// What surfaces that blend evaluate: the same lists, or all lights.
double blendedIndexed(Counts c, Settings s) { return indexesBefore(c, s) ? c.blendedBehindFront + c.blended * c.unbounded : blendedLights(c, s); }
/// Edges of triangles, with as many lights as there are elsewhere.
double edgeIndexed(Counts c, Settings s) { return c.covered > 0 ? edges(c, s) * indexed(c, s) / c.covered : 0; }
double packedPixels(Counts c, Settings s) { return lists(c, s) ? 0 : c.pixels; }
double packedFragments(Counts c, Settings s) { return lists(c, s) ? 0 : indexFragments(c, s); }
double listFrame(Counts c, Settings s) { return lists(c, s) ? 1 : 0; }
double listPixels(Counts c, Settings s) { return lists(c, s) ? c.pixels : 0; }
double listFragments(Counts c, Settings s) { return lists(c, s) ? indexFragments(c, s) : 0; }
double listIndexed(Counts c, Settings s) { return lists(c, s) ? indexed(c, s) : 0; }

/// A row with the terms of its kind's frame first. Of deferred techniques these are G-buffer and tone mapping,
CostModel withGBuffer(std::string_view technique, std::vector<CostTerm> own) {
    own.insert(own.begin(), {{"deferred.frame", one},
                             {"deferred.pixel", pixels},
                             {"deferred.fragment", fragments},
                             {"deferred.triangle", triangles},
                             {"deferred.edge", edges}});
    return {technique, std::move(own)};
}
/// of most of them blended surfaces with all lights in a loop,
CostModel withBlendedLoop(std::string_view technique, std::vector<CostTerm> own) {
    own.insert(own.begin(), {{"deferred.blended", blended},
                             {"deferred.blended-light", blendedLights},
                             {"deferred.blended-edge-light", blendedEdgeLights}});
    return withGBuffer(technique, std::move(own));
}
/// and of those that add to it, the light that is there without lights.
CostModel deferred(std::string_view technique, std::vector<CostTerm> own) {
    own.insert(own.begin(), {{"deferred.covered", covered}});
    return withBlendedLoop(technique, std::move(own));
}
CostModel forward(std::string_view technique, std::vector<CostTerm> own) {
    own.insert(own.begin(), {{"forward.frame", one},
                             {"forward.pixel", pixels},
                             {"forward.covered", covered},
                             {"forward.triangle", triangles},
                             {"forward.edge", edges},
                             {"forward.blended", blended}});
    return {technique, std::move(own)};
}

}  // namespace

const std::vector<CostModel>& costModels() {
    static const std::vector<CostModel> models = {
        deferred("brute-force", {{"brute-force.evaluation", allLights}, {"brute-force.covered", covered}}),
        deferred("fullscreen", {{"fullscreen.light", lights}, {"fullscreen.evaluation", allLights}}),
        deferred("quad", {{"quad.frame", one},
                          {"quad.light", lights},
                          {"quad.fragment", inRectangle},
                          {"quad.evaluation", behindNearest},
                          {"brute-force.evaluation", everywhere}}),
        deferred("volume", {{"volume.frame", one},
                            {"volume.light", visible},
                            {"volume.triangle", shapeTriangles},
                            {"volume.fragment", onShape},
                            {"volume.evaluation", behindFace},
                            {"brute-force.evaluation", everywhere}}),
        deferred("volume-stencil", {{"volume-stencil.frame", one},
                                    {"volume-stencil.light", visible},
                                    {"volume-stencil.triangle", shapeTriangles},
                                    {"volume-stencil.fragment", onShape},
                                    {"volume-stencil.evaluation", reaching},
                                    {"brute-force.evaluation", everywhere}}),
        deferred("volume-stencil-reference", {{"volume-stencil-reference.frame", one},
                                              {"volume-stencil-reference.light", visible},
                                              {"volume-stencil-reference.triangle", shapeTriangles},
                                              {"volume-stencil-reference.fragment", onShape},
                                              {"volume-stencil-reference.evaluation", reaching},
                                              {"brute-force.evaluation", everywhere}}),
        deferred("volume-instanced", {{"volume-instanced.frame", one},
                                      {"volume-instanced.light", lights},
                                      {"volume-instanced.triangle", shapeTriangles},
                                      {"volume-instanced.fragment", onShape},
                                      {"volume-instanced.evaluation", behindFace},
                                      {"brute-force.evaluation", everywhere}}),
        withBlendedLoop("tiled", {{"tiled.frame", one},
                                  {"tiled.pixel", pixels},
                                  {"tiled.covered", covered},
                                  {"tiled.light", lights},
                                  {"tiled.evaluation", inTile}}),
        withBlendedLoop("tiled-points", {{"tiled-points.frame", one},
                                         {"tiled-points.pixel", pixels},
                                         {"tiled-points.covered", covered},
                                         {"tiled-points.light", lights},
                                         {"tiled-points.evaluation", inTile}}),
        withGBuffer("clustered", {{"clustered.frame", one},
                                  {"clustered.pixel", pixels},
                                  {"clustered.covered", covered},
                                  {"clustered.light", lights},
                                  {"clustered.evaluation", inCluster},
                                  {"clustered.blended-frame", blendedFrame},
                                  {"clustered.blended-triangle", blendedTriangles},
                                  {"clustered.blended", blended},
                                  {"clustered.blended-edge", blendedEdges},
                                  {"clustered.blended-light", blendedInCluster},
                                  {"clustered.blended-edge-light", blendedEdgeInCluster}}),
        forward("clustered-forward", {{"clustered-forward.frame", one},
                                      {"clustered-forward.pixel", pixels},
                                      {"clustered-forward.light", lights},
                                      {"clustered-forward.evaluation", inCluster},
                                      {"clustered-forward.blended-light", blendedInCluster},
                                      {"clustered-forward.edge-light", edgeInCluster}}),
        forward("forward-loop", {{"forward-loop.evaluation", allLights},
                                 {"forward-loop.blended-light", blendedLights},
                                 {"forward-loop.edge-light", edgeLights}}),
        forward("light-indexed", {{"light-indexed.frame", one},
                                  {"light-indexed.light", lights},
                                  {"light-indexed.packed-pixel", packedPixels},
                                  {"light-indexed.packed-fragment", packedFragments},
                                  {"light-indexed.list-frame", listFrame},
                                  {"light-indexed.list-pixel", listPixels},
                                  {"light-indexed.list-fragment", listFragments},
                                  {"light-indexed.list-entry", listIndexed},
                                  {"light-indexed.evaluation", indexed},
                                  {"light-indexed.blended-light", blendedIndexed},
                                  {"light-indexed.edge-light", edgeIndexed}}),
    };
    return models;
}

bool CostModel::evaluatesAll() const {
    return std::ranges::any_of(terms, [](const CostTerm& term) { return term.count == allLights; });
}

namespace {

const CostModel* modelOf(std::string_view technique) {
    const auto found = std::ranges::find(costModels(), technique, &CostModel::technique);
    return found == costModels().end() ? nullptr : &*found;
}

/// min |A x - b| with x >= 0, by coordinate descent on the normal equations (Franc, Hlavac and Navara 2005, "Sequential Coordinate-Wise
/// Algorithm for the Non-negative Least Squares Problem"). \param rows of A, with b as their last element
std::vector<double> nonNegativeLeastSquares(const std::vector<std::vector<double>>& rows, size_t unknowns) {
    // Columns of equal length, so that no unit makes one of them seem small.
    std::vector<double> scale(unknowns, 0);
    for (const auto& row : rows)
        for (size_t j = 0; j < unknowns; ++j) scale[j] += row[j] * row[j];
    for (double& s : scale) s = s > 0 ? 1 / std::sqrt(s) : 0;
    std::vector<std::vector<double>> h(unknowns, std::vector<double>(unknowns, 0));
    std::vector<double> gradient(unknowns, 0);  // A^T A x - A^T b, at x = 0
    for (const auto& row : rows)
        for (size_t i = 0; i < unknowns; ++i) {
            gradient[i] -= scale[i] * row[i] * row[unknowns];
            for (size_t j = 0; j < unknowns; ++j) h[i][j] += scale[i] * row[i] * scale[j] * row[j];
        }
    std::vector<double> x(unknowns, 0);
    constexpr int kSweeps = 20'000;
    constexpr double kStill = 1e-10;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        double most = 0;
        for (size_t i = 0; i < unknowns; ++i) {
            if (h[i][i] <= 0) continue;  // counted in no sample
            const double next = std::max(0.0, x[i] - gradient[i] / h[i][i]);
            const double step = next - x[i];
            if (step == 0) continue;
            x[i] = next;
            for (size_t j = 0; j < unknowns; ++j) gradient[j] += step * h[i][j];
            most = std::max(most, std::abs(step));
        }
        if (most < kStill) break;
    }
    for (size_t j = 0; j < unknowns; ++j) x[j] *= scale[j];
    return x;
}

}  // namespace

Coefficients fit(std::span<const CostSample> samples, const RenderSettings& settings) {
    std::map<std::string_view, size_t> column;
    for (const CostSample& sample : samples)
        if (const CostModel* model = modelOf(sample.technique))
            for (const CostTerm& term : model->terms) column.emplace(term.coefficient, column.size());
    std::vector<std::vector<double>> rows;
    for (const CostSample& sample : samples) {
        const CostModel* model = modelOf(sample.technique);
        if (!model || !(sample.ms > 0)) continue;
        std::vector<double>& row = rows.emplace_back(column.size() + 1, 0);
        for (const CostTerm& term : model->terms) row[column.at(term.coefficient)] += term.count(sample.counts, settings) / sample.ms;
        row.back() = 1;
    }
    // Something else may have run while a frame was measured, so that some samples are far too high: what fits badly counts less the
    // worse it fits, as in a fit of least absolute errors (Holland and Welsch 1977, "Robust Regression Using Iteratively Reweighted
    // Least-Squares").
    constexpr int kReweightings = 8;
    constexpr double kGoodFit = 0.03;  // relative error
    std::vector<double> values(column.size(), 0);
    std::vector<double> weights(rows.size(), 1);
    for (int i = 0; i <= kReweightings; ++i) {
        std::vector<std::vector<double>> weighted = rows;
        for (size_t r = 0; r < rows.size(); ++r)
            for (double& value : weighted[r]) value *= std::sqrt(weights[r]);
        values = nonNegativeLeastSquares(weighted, column.size());
        for (size_t r = 0; r < rows.size(); ++r) {
            const double error = std::inner_product(values.begin(), values.end(), rows[r].begin(), -1.0);
            weights[r] = kGoodFit / std::max(kGoodFit, std::abs(error));
        }
    }
    Coefficients coefficients;
    for (const auto& [name, index] : column) coefficients.emplace(name, values[index]);
    return coefficients;
}

std::optional<double> predictedMs(std::string_view technique, const SceneCounts& counts, const RenderSettings& settings,
                                  const Coefficients& coefficients) {
    const CostModel* model = modelOf(technique);
    if (!model) return std::nullopt;
    double ms = 0;
    for (const CostTerm& term : model->terms) {
        const auto coefficient = coefficients.find(term.coefficient);
        if (coefficient == coefficients.end()) return std::nullopt;
        ms += coefficient->second * term.count(counts, settings);
    }
    return ms;
}

std::string whyNot(const LightingTechnique& technique, const RenderSettings& settings, const Circumstances& circumstances) {
    const bool indexes = technique.info.name == "light-indexed";
    if (!technique.whyInexact.empty()) return std::string(technique.whyInexact);
    if (settings.msaa != Msaa::x1 && !technique.samples) return "stores one surface a pixel (msaa 4)";
    if (settings.msaa != Msaa::x1 && !circumstances.samples) return "the device shades no samples (msaa 4)";
    if (settings.lightBuffer == LightBufferFormat::rgba16f && technique.blendsLights)
        return "rounds the sum after each light (light-buffer rgba16f)";
    if (technique.points && !circumstances.points) return "the device draws no points as large as a tile that bring along enough";
    if (circumstances.lists && !technique.info.lists) return "makes no lists of lights (list layers)";
    if (circumstances.bounce && technique.onHost) return "the host looks at each light, and a bounce's are made on the device";
    if (!indexes) return "";
    const bool sorts = settings.lidrPacking == LidrPacking::cpuSort || settings.lidrPacking == LidrPacking::maxBlendSorted;
    if (circumstances.bounce && sorts) return "the host sorts lights, and a bounce's are made on the device (lidr-packing)";
    if (settings.lidrPacking != LidrPacking::list) {
        if (settings.onOverflow != OnOverflow::exact) return "may lose lights, or fail (on-overflow)";
        try {
            indexLayout(settings, circumstances.lights);
        } catch (const Error& error) {
            return error.what();
        }
    }
    if (settings.lidrShare)
        return circumstances.feedback ? "shows the first of surfaces that coincide (lidr-share)"
                                      : "the device can't sample what it draws into (lidr-share)";
    return "";
}

namespace {

std::string reasonOf(const LightingAdvice& advice) {
    const SceneCounts& c = advice.counts;
    const auto perPixel = [&](double count) { return c.covered > 0 ? count / c.covered : 0; };
    const auto chosen = std::ranges::find(advice.techniques, advice.technique, &TechniqueAdvice::technique);
    std::string reason = "lighting auto: " + advice.technique;
    if (chosen->predictedMs) reason += fmt::format(", {:.1f} ms predicted", *chosen->predictedMs);
    const auto next = std::ranges::find_if(advice.techniques, [&](const TechniqueAdvice& row) { return &row != &*chosen && row.predictedMs; });
    if (chosen->predictedMs && next != advice.techniques.end())
        reason += fmt::format(", next {} {:.1f} ms", next->technique, *next->predictedMs);
    reason += fmt::format("; {:.0f} lights, {:.1f} a pixel, {:.0f} % of the picture covered {:.1f} times", c.lights,
                          perPixel(c.reaching) + c.unbounded, c.pixels > 0 ? 100 * c.covered / c.pixels : 0, perPixel(c.fragments));
    if (c.blended > 0) reason += fmt::format(", {:.2f} blended", c.pixels > 0 ? c.blended / c.pixels : 0);
    return reason;
}

}  // namespace

LightingAdvice advise(const SceneCounts& counts, const RenderSettings& settings, const Circumstances& circumstances,
                      const Coefficients& coefficients) {
    LightingAdvice advice{.counts = counts};
    for (const LightingTechnique& technique : techniques()) {
        TechniqueAdvice row{.technique = std::string(technique.info.name), .whyNot = whyNot(technique, settings, circumstances)};
        if (row.whyNot.empty()) row.predictedMs = predictedMs(row.technique, counts, settings, coefficients);
        if (row.whyNot.empty() && !row.predictedMs && row.technique != yardstickOf(technique)) row.whyNot = "its cost is not known";
        advice.techniques.push_back(std::move(row));
    }
    std::ranges::stable_sort(advice.techniques, {}, [](const TechniqueAdvice& row) {
        return std::pair(!row.whyNot.empty(), row.predictedMs.value_or(HUGE_VAL));
    });
    const TechniqueAdvice& first = advice.techniques.front();
    if (!first.whyNot.empty())
        throw Error(ErrorKind::usage, fmt::format("lighting: auto finds no technique for these settings; {}: {}", first.technique, first.whyNot));
    advice.technique = first.technique;
    advice.reason = reasonOf(advice);
    return advice;
}

bool coversModels(const Coefficients& coefficients, const RenderSettings& settings) {
    return std::ranges::all_of(costModels(), [&](const CostModel& model) {
        return !whyNot(techniqueNamed(std::string(model.technique)), settings, {}).empty() ||
               std::ranges::all_of(model.terms, [&](const CostTerm& term) { return coefficients.contains(term.coefficient); });
    });
}

std::string textOf(const Coefficients& coefficients) {
    std::string text;
    for (const auto& [name, value] : coefficients) text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, value);
    return text;
}

std::optional<Coefficients> coefficientsFrom(std::string_view text) {
    Coefficients coefficients;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(word.size() + 1, text.size()));
        const size_t equals = word.find('=');
        if (equals == 0 || equals == std::string_view::npos) return std::nullopt;
        double value = 0;
        const auto [end, error] = std::from_chars(word.data() + equals + 1, word.data() + word.size(), value);
        if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value) || value < 0) return std::nullopt;
        if (!coefficients.emplace(word.substr(0, equals), value).second) return std::nullopt;
    }
    if (coefficients.empty()) return std::nullopt;
    return coefficients;
}

}  // namespace luciole::render
