#include "statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace luciole::cli {
namespace {

double mebibytes(uint64_t bytes) { return double(bytes) / (1 << 20); }

uint64_t sum(const std::vector<PassStats>& passes, uint32_t PassStats::*member) {
    uint64_t total = 0;
    for (const PassStats& pass : passes) total += pass.*member;
    return total;
}

std::string countsLine(const OverlapCounts& counts) {
    const auto ratio = [](uint64_t a, uint64_t b) { return b == 0 ? 0 : double(a) / double(b); };
    return fmt::format("{} lights evaluated at {} pixels, {:.2f} a pixel; {} of them of use ({:.1f} %)\n",
                       counts.evaluations, counts.coveredPixels, ratio(counts.evaluations, counts.coveredPixels),
                       counts.usefulEvaluations, 100 * ratio(counts.usefulEvaluations, counts.evaluations));
}

}  // namespace

std::string statisticsJson(const Frame& frame, const RenderSettings& settings,
                           const std::optional<OverlapCounts>& counts) {
    using Json = nlohmann::ordered_json;
    const FrameStats& stats = frame.stats;
    Json json{{"device", stats.deviceName},      {"driver", stats.driver},      {"width", frame.radiance.width},
              {"height", frame.radiance.height}, {"lights", stats.lights},      {"triangles", stats.triangles},
              {"wallMs", stats.wallMs},
              {"recordMs", stats.recordMs},          {"peakBytes", stats.peakBytes}};
    for (const Setting& setting : settingsTable()) json["settings"][std::string(setting.name)] = setting.get(settings);
    json["passes"] = Json::array();
    for (const PassStats& pass : stats.passes)
        json["passes"].push_back({{"name", pass.name},
                                  {"ms", pass.ms ? Json(*pass.ms) : Json()},
                                  {"bytes", pass.bytes},
                                  {"draws", pass.draws},
                                  {"stencilDraws", pass.stencilDraws}});
    if (counts) {
        std::vector<PassStats> counting = stats.passes;
        std::erase_if(counting, [](const PassStats& pass) { return !pass.name.starts_with("counting."); });
        json["counts"] = {{"evaluations", counts->evaluations},
                          {"usefulEvaluations", counts->usefulEvaluations},
                          {"coveredPixels", counts->coveredPixels},
                          {"draws", sum(counting, &PassStats::draws)},
                          {"stencilDraws", sum(counting, &PassStats::stencilDraws)}};
    }
    if (const auto& index = stats.lightIndex) {
        json["lightIndex"] = {{"packing", index->packing},         {"fellBack", index->fellBack},       {"rounds", index->rounds},
                              {"pixelsOver", index->pixelsOver},   {"pairsOver", index->pairsOver},     {"imageBytes", index->imageBytes},
                              {"tableBytes", index->tableBytes},   {"listEntries", index->listEntries}, {"mostAtOnce", index->mostAtOnce},
                              {"withoutIndex", index->withoutIndex}, {"selfTestMs", index->selfTestMs},
                              {"wrongValues", index->wrongValues}, {"lost", Json::array()}};
        for (const LightIndexStats::Lost& lost : index->lost)
            json["lightIndex"]["lost"].push_back({{"light", lost.light}, {"pairs", lost.pairs}, {"radiance", lost.radiance}});
    }
    if (const auto& choice = stats.choice)
        json["auto"] = {{"technique", choice->technique},
                        {"reason", choice->reason},
                        {"countingFrames", choice->countingFrames},
                        {"calibrationFrames", choice->calibrationFrames},
                        {"calibrationMs", choice->calibrationMs}};
    if (const auto& lists = stats.lightLists)
        json["lightLists"] = {{"tileSize", lists->tileSize}, {"lists", lists->lists}, {"entries", lists->entries},
                              {"longest", lists->longest},   {"pages", lists->pages}, {"bytes", lists->bytes}};
    if (const auto& shadows = stats.shadows) {
        const auto list = [](const std::vector<ShadowStats::Without>& lights) {
            Json rows = Json::array();
            for (const ShadowStats::Without& without : lights) rows.push_back({{"light", without.light}, {"reason", without.reason}});
            return rows;
        };
        json["shadows"] = {{"lights", shadows->lights},   {"maps", shadows->maps},   {"drawn", shadows->drawn}, {"casterDraws", shadows->casterDraws},
                           {"coarser", shadows->coarser}, {"texels", shadows->texels}, {"bytes", shadows->bytes}, {"waiting", list(shadows->waiting)},
                           {"lost", list(shadows->lost)}};
    }
    // Driver names come from outside and need not be UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string overflowNote(const LightIndexStats& stats, const Scene& scene) {
    if (stats.pixelsOver == 0 && !stats.fellBack) return "";
    if (stats.wrongValues > 0)
        return fmt::format("light indices: lists hold all lights, as the device blends {} values of the packing asked for inexactly", stats.wrongValues);
    if (stats.fellBack)
        return fmt::format("light indices: lists hold all lights, where the packing asked for would have lost {} pairs of a light and a pixel at {} pixels",
                           stats.pairsOver, stats.pixelsOver);
    std::string note = fmt::format("light indices: {} has no room for {} pairs of a light and a pixel at {} pixels; {} lights lose something:",
                                   stats.packing, stats.pairsOver, stats.pixelsOver, stats.lost.size());
    std::vector<LightIndexStats::Lost> worst = stats.lost;
    std::ranges::stable_sort(worst, std::greater<>{}, &LightIndexStats::Lost::radiance);
    constexpr size_t kNamed = 8;
    for (size_t i = 0; i < std::min(worst.size(), kNamed); ++i) {
        const std::string& name = scene.lights[worst[i].light].name;
        note += fmt::format("{} {}{} at {} pixels", i == 0 ? "" : ",", worst[i].light, name.empty() ? "" : " \"" + name + "\"", worst[i].pairs);
    }
    return note + (worst.size() > kNamed ? ", ..." : "");
}

namespace {

/// The first of some lights by index and name, and that there are more.
std::string namedLights(const std::vector<ShadowStats::Without>& lights, const Scene& scene) {
    constexpr size_t kNamed = 8;
    std::string names;
    for (size_t i = 0; i < std::min(lights.size(), kNamed); ++i) {
        const std::string& name = scene.lights[lights[i].light].name;
        names += fmt::format("{}{}{}", i == 0 ? "" : ", ", lights[i].light, name.empty() ? "" : " \"" + name + "\"");
    }
    return names + (lights.size() > kNamed ? ", ..." : "");
}

}  // namespace

std::vector<std::string> shadowNotes(const ShadowStats& stats, const Scene& scene) {
    std::vector<std::string> notes;
    if (!stats.lost.empty())
        notes.push_back(fmt::format("shadows: {} lights go without: {}: {}", stats.lost.size(), stats.lost[0].reason, namedLights(stats.lost, scene)));
    if (!stats.waiting.empty())
        notes.push_back(fmt::format("shadows: {} lights wait for theirs: {}: {}", stats.waiting.size(), stats.waiting[0].reason, namedLights(stats.waiting, scene)));
    return notes;
}

std::string statisticsTable(const FrameStats& stats, const std::optional<OverlapCounts>& counts) {
    std::string table = fmt::format("{:<40} {:>10} {:>10} {:>8}\n", "pass", "ms", "MiB", "draws");
    for (const PassStats& pass : stats.passes)
        table += fmt::format("{:<40} {:>10} {:>10.1f} {:>8}\n", pass.name,
                             pass.ms ? fmt::format("{:.3f}", *pass.ms) : "-", mebibytes(pass.bytes), pass.draws);
    table += fmt::format("{:<40} {:>10.3f} {:>10.1f} {:>8}\n", "frame, wall clock; peak memory", stats.wallMs,
                         mebibytes(stats.peakBytes), sum(stats.passes, &PassStats::draws));
    if (counts) table += countsLine(*counts);
    if (stats.lightIndex)
        table += fmt::format("light indices: {}, {} rounds, {:.2f} MiB of images, {:.1f} KiB of tables\n", stats.lightIndex->packing,
                             stats.lightIndex->rounds, mebibytes(stats.lightIndex->imageBytes), double(stats.lightIndex->tableBytes) / 1024);
    if (const auto& lists = stats.lightLists)
        table += fmt::format("light lists: {} entries in {} lists, the longest of {}; tiles of {} pixels, {} page{}, {:.2f} MiB\n", lists->entries, lists->lists,
                             lists->longest, lists->tileSize, lists->pages, lists->pages == 1 ? "" : "s", mebibytes(lists->bytes));
    if (const auto& shadows = stats.shadows)
        table += fmt::format("shadows: {} maps of {} lights, {} of them drawn in {} draws; {:.1f} of {:.1f} MiB{}\n", shadows->maps, shadows->lights, shadows->drawn,
                             shadows->casterDraws, mebibytes(4 * shadows->texels), mebibytes(shadows->bytes),
                             shadows->coarser == 0 ? "" : fmt::format(", sides {} times halved", shadows->coarser));
    return table + fmt::format("{} lights, {} triangles on {} ({})\n", stats.lights, stats.triangles, stats.deviceName,
                               stats.driver);
}

}  // namespace luciole::cli
