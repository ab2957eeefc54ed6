#include "statistics.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace luciole::cli {
namespace {

double mebibytes(uint64_t bytes) { return double(bytes) / (1 << 20); }

}  // namespace

std::string statisticsJson(const Frame& frame, const RenderSettings& settings) {
    using Json = nlohmann::ordered_json;
    const FrameStats& stats = frame.stats;
    Json json{{"device", stats.deviceName},      {"driver", stats.driver},      {"width", frame.radiance.width},
              {"height", frame.radiance.height}, {"lights", stats.lights},      {"triangles", stats.triangles},
              {"wallMs", stats.wallMs},          {"peakBytes", stats.peakBytes}};
    for (const Setting& setting : settingsTable()) json["settings"][std::string(setting.name)] = setting.get(settings);
    json["passes"] = Json::array();
    for (const PassStats& pass : stats.passes)
        json["passes"].push_back(
            {{"name", pass.name}, {"ms", pass.ms ? Json(*pass.ms) : Json()}, {"bytes", pass.bytes}});
    // Driver names come from outside and need not be UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string statisticsTable(const FrameStats& stats) {
    std::string table = fmt::format("{:<40} {:>10} {:>10}\n", "pass", "ms", "MiB");
    for (const PassStats& pass : stats.passes)
        table += fmt::format("{:<40} {:>10} {:>10.1f}\n", pass.name, pass.ms ? fmt::format("{:.3f}", *pass.ms) : "-",
                             mebibytes(pass.bytes));
    return table +
           fmt::format("{:<40} {:>10.3f} {:>10.1f}\n", "frame, wall clock; peak memory", stats.wallMs,
                       mebibytes(stats.peakBytes)) +
           fmt::format("{} lights, {} triangles on {} ({})\n", stats.lights, stats.triangles, stats.deviceName,
                       stats.driver);
}

}  // namespace luciole::cli
