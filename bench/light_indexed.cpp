#include <luciole/scene_io.hpp>

#include <fmt/format.h>

#include <map>
#include <numeric>

#include "suites.hpp"

namespace luciole::bench {
namespace {

struct Result {
    std::vector<double> frameMs, indexMs, surfacesMs;
    Frame last;
};

/// Milliseconds of the passes whose name contains `part`. Left out: what only finds out what was lost, which the
/// article does not do.
double msOf(const Frame& frame, std::string_view part) {
    double ms = 0;
    for (const PassStats& pass : frame.stats.passes) {
        const bool report = pass.name.ends_with(".lost") || pass.name.starts_with("output.");
        if (!report && pass.name.find(part) != std::string::npos) ms += pass.ms.value();
    }
    return ms;
}

std::map<std::string, Result> measureIndexing(Renderer& renderer, const View& view, const std::vector<Contender>& contenders,
                                      int frames) {
    std::map<std::string, Result> results;
    for (int i = 0; i < frames; ++i)
        for (const Contender& contender : contenders) {
            RenderSettings settings = contender.settings;
            settings.measure = true;
            Result& result = results[contender.name];
            result.last = renderer.render(view, settings);
            result.frameMs.push_back(msOf(result.last, ""));
            result.surfacesMs.push_back(msOf(result.last, ".surfaces"));
            result.indexMs.push_back(msOf(result.last, "light-indexed.") - result.surfacesMs.back());
        }
    return results;
}

double meanEvaluations(Renderer& renderer, const View& view, const RenderSettings& settings) {
    const Image image = renderer.render(view, settings, {"evaluations"}).aovs.at("evaluations");
    return std::accumulate(image.data.begin(), image.data.end(), 0.0) / double(image.data.size());
}

Contender indexed(const std::string& name, LidrPacking packing, uint32_t overlap) {
    return {name,
            {.lighting = "light-indexed",
             .lidrPacking = packing,
             .overlap = overlap,
             .indices = LidrIndices::n255,
             .onOverflow = OnOverflow::priority}};
}

Scene hall(double overlap) {
    return loadScene(fmt::format("builtin:hall?lights=255&overlap={}&triangles=40000&seed=1", overlap));
}

/// Figure 2.9.1 of the article: frames a second on a GeForce 6800 GT, 1024 x 768, some 40,000 triangles, 255 lights.
void benchArticle(Renderer& renderer, int frames, uvec2 extent) {
    constexpr double kMultipass = 12;
    fmt::print(
        "\n| overlap | | frame, ms: median (minimum) | times forward-multipass | the article's | lights evaluated a "
        "pixel | pairs lost |\n"
        "| ---: | --- | ---: | ---: | ---: | ---: | ---: |\n");
    for (const auto& [overlap, articleFps] : {std::pair(1u, 82.0), std::pair(2u, 62.0), std::pair(4u, 37.0)}) {
        const Scene scene = hall(overlap);
        renderer.setScene(scene);
        const View view{scene.cameras.at(0), extent};
        const std::vector<Contender> contenders{
            {"forward-multipass", {.lighting = "forward-multipass"}},
            {"light-prepass", {.lighting = "light-prepass"}},
            {"volume-stencil", {.lighting = "volume-stencil"}},
            indexed(fmt::format("light-indexed, bit-shift {}x255", overlap), LidrPacking::bitShift, overlap),
            indexed("light-indexed, bit-shift 8x255", LidrPacking::bitShift, 8),
            indexed("light-indexed, list", LidrPacking::list, 4)};
        const auto results = measureIndexing(renderer, view, contenders, frames);
        const double multipass = median(results.at("forward-multipass").frameMs);
        for (const Contender& contender : contenders) {
            const Result& result = results.at(contender.name);
            const bool articles = contender.settings.lidrPacking == LidrPacking::bitShift &&
                                  contender.settings.overlap == overlap &&
                                  contender.settings.lighting == "light-indexed";
            fmt::print("| {} | {} | {} | {:.1f} | {} | {:.2f} | {} |\n", overlap, contender.name, milliseconds(result.frameMs),
                       multipass / median(result.frameMs),
                       articles ? fmt::format("{:.1f}", articleFps / kMultipass) : "",
                       meanEvaluations(renderer, view, contender.settings),
                       result.last.stats.lightIndex ? std::to_string(result.last.stats.lightIndex->pairsOver) : "-");
            std::fflush(stdout);
        }
    }
}

/// Every packing on one scene.
void benchPackings(Renderer& renderer, int frames, uvec2 extent) {
    const Scene scene = hall(1);
    renderer.setScene(scene);
    const View view{scene.cameras.at(0), extent};
    std::vector<Contender> contenders;
    for (const auto indices : {LidrIndices::n15, LidrIndices::n255, LidrIndices::n65535})
        for (const uint32_t overlap : {1u, 2u, 4u, 8u, 16u}) {
            if ((overlap == 1 && indices == LidrIndices::n15) || (overlap == 16 && indices == LidrIndices::n65535))
                continue;
            Contender row = indexed("", LidrPacking::bitShift, overlap);
            row.settings.indices = indices;
            row.name = fmt::format("bit-shift {}x{}", overlap, getSetting(row.settings, "indices"));
            contenders.push_back(row);
        }
    for (const uint32_t overlap : {2u, 4u})
        contenders.push_back(indexed(fmt::format("max-blend {}x255", overlap), LidrPacking::maxBlend, overlap));
    contenders.push_back(indexed("max-blend-sorted 4x255", LidrPacking::maxBlendSorted, 4));
    for (const uint32_t overlap : {4u, 16u})
        contenders.push_back(indexed(fmt::format("cpu-sort {}x255", overlap), LidrPacking::cpuSort, overlap));
    contenders.push_back(indexed("list", LidrPacking::list, 4));
    Contender exact = indexed("bit-shift 8x255, on-overflow exact", LidrPacking::bitShift, 8);
    exact.settings.onOverflow = OnOverflow::exact;
    contenders.push_back(exact);
    for (const auto tables : {LidrTables::buffers, LidrTables::textures})
        for (const auto types : {LidrTypes::flag, LidrTypes::one, LidrTypes::targets}) {
            Contender row = exact;
            row.settings.lidrTables = tables;
            row.settings.lidrTypes = types;
            row.name = fmt::format("bit-shift 8x255 exact, tables {}, types {}",
                                   getSetting(row.settings, "lidr-tables"), getSetting(row.settings, "lidr-types"));
            contenders.push_back(row);
        }
    const auto results = measureIndexing(renderer, view, contenders, frames);
    fmt::print(
        "\n| packing | index passes, ms | surfaces, ms | images, bytes a pixel | tables, KiB | pairs lost | held by |\n"
        "| --- | ---: | ---: | ---: | ---: | ---: | --- |\n");
    for (const Contender& contender : contenders) {
        const Result& result = results.at(contender.name);
        const LightIndexStats& stats = *result.last.stats.lightIndex;
        fmt::print("| {} | {} | {} | {:.0f} | {:.1f} | {} | {} |\n", contender.name, milliseconds(result.indexMs),
                   milliseconds(result.surfacesMs), double(stats.imageBytes) / (double(extent.x) * extent.y),
                   double(stats.tableBytes) / 1024, stats.fellBack ? 0 : stats.pairsOver, stats.packing);
    }
}

/// Trebilco 2009, "Multi-sample Anti-aliasing": an index a sample, front faces for all samples, and surfaces that loop
/// over all lights.
void benchSamples(Renderer& renderer, int frames, uvec2 extent) {
    const Scene scene = hall(1);
    renderer.setScene(scene);
    const View view{scene.cameras.at(0), extent};
    fmt::print(
        "\n| 4 samples a pixel | frame, ms: median (minimum) | lights evaluated a pixel | held by |\n| --- | ---: | "
        "---: | --- |\n");
    std::vector<Contender> contenders{{"forward-loop, 1 sample", {.lighting = "forward-loop"}},
                                      {"forward-loop", {.lighting = "forward-loop", .msaa = Msaa::x4}}};
    for (const auto cover : {LidrCover::surface, LidrCover::frontFaces}) {
        RenderSettings settings{
            .lighting = "light-indexed", .msaa = Msaa::x4, .overlap = 16, .indices = LidrIndices::n255};
        settings.lidrCover = cover;
        contenders.push_back({"light-indexed, lidr-cover " + getSetting(settings, "lidr-cover"), settings});
    }
    const auto results = measureIndexing(renderer, view, contenders, frames);
    for (const Contender& contender : contenders)
        fmt::print("| {} | {} | {:.2f} | {} |\n", contender.name, milliseconds(results.at(contender.name).frameMs),
                   meanEvaluations(renderer, view, contender.settings),
                   results.at(contender.name).last.stats.lightIndex
                       ? results.at(contender.name).last.stats.lightIndex->packing
                       : "-");
}

}  // namespace

void benchLightIndexed(Renderer& renderer, const Options& options) {
    benchArticle(renderer, options.frames, options.extent);
    benchPackings(renderer, options.frames, options.extent);
    benchSamples(renderer, options.frames, options.extent);
}

}  // namespace luciole::bench
