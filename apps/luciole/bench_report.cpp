#include "bench_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sample.hpp>

namespace luciole::cli {
namespace {

constexpr int kSchema = 1;  ///< of the JSON; raised with any change that a reader would stumble over

double mebibytes(uint64_t bytes) { return double(bytes) / (1 << 20); }

uint64_t drawsOf(const FrameStats& stats) {
    uint64_t draws = 0;
    for (const PassStats& pass : stats.passes) draws += pass.draws;
    return draws;
}

/// Markdown that is a table for the eye, too: columns of one width, all but the first flush right.
std::string tableOf(const std::vector<std::vector<std::string>>& rows) {
    std::vector<size_t> widths;
    for (const auto& row : rows)
        for (size_t i = 0; i < row.size(); ++i) {
            widths.resize(std::max(widths.size(), i + 1), 4);
            widths[i] = std::max(widths[i], row[i].size());
        }
    std::string text;
    for (size_t r = 0; r < rows.size(); ++r) {
        for (size_t i = 0; i < widths.size(); ++i)
            text += i == 0 ? fmt::format("| {:<{}} |", rows[r][i], widths[i]) : fmt::format(" {:>{}} |", rows[r][i], widths[i]);
        text += "\n";
        if (r > 0) continue;
        for (size_t i = 0; i < widths.size(); ++i)
            text += i == 0 ? fmt::format("| {:-<{}} |", "", widths[i]) : fmt::format(" {:->{}}: |", "", widths[i] - 1);
        text += "\n";
    }
    return text;
}

std::string headingOf(const CellResult& result) {
    std::string text = fmt::format("{}, {}x{}", result.cell.scene.uri, result.cell.view.size.x, result.cell.view.size.y);
    for (const auto& [name, value] : result.cell.at)
        if (name != "size" && result.cell.scene.uri.find(fmt::format("{}={}", name, value)) == std::string::npos) text += fmt::format(", {} {}", name, value);
    return text;
}

std::vector<bench::Timed> timed(const std::vector<bench::Measured>& results) {
    std::vector<bench::Timed> all;
    for (const bench::Measured& result : results)
        if (result.name != bench::ideal().name) all.push_back({result.name, bench::sampleOf(result.wallMs)});
    return all;
}

std::string framesTable(const std::vector<bench::Measured>& results) {
    std::vector<std::vector<std::string>> rows{
        {"technique", "frames", "median, ms", "95 % interval", "p95", "variation", "passes, ms", "evaluations", "useful", "missed", "draws", "MiB"}};
    for (const bench::Measured& result : results) {
        const bench::Sample wall = bench::sampleOf(result.wallMs);
        rows.push_back({result.name, fmt::format("{}", wall.count), fmt::format("{:.2f}", wall.median), fmt::format("{:.2f} - {:.2f}", wall.low, wall.high),
                        fmt::format("{:.2f}", wall.p95), fmt::format("{:.1f} %", 100 * wall.variation), fmt::format("{:.2f}", bench::median(result.passesMs)),
                        fmt::format("{:.2f}", result.evaluations), fmt::format("{:.2f}", result.useful), result.missed ? fmt::format("{:.0f}", *result.missed) : "-",
                        fmt::format("{}", drawsOf(result.stats)), fmt::format("{:.1f}", mebibytes(result.stats.peakBytes))});
    }
    return tableOf(rows);
}

std::string lightingRows(const std::vector<bench::Measured>& results) {
    std::vector<std::vector<std::string>> rows{{"technique", "lighting, ms", "finds lights", "evaluates them", "times ideal (of the least)"}};
    for (const bench::Measured& result : results)
        rows.push_back({result.name, fmt::format("{:.2f}", bench::median(result.lightingMs)), fmt::format("{:.2f}", bench::median(result.listsMs)),
                        fmt::format("{:.2f}", bench::median(result.shadingMs)), bench::timesIdeal(result, results)});
    return tableOf(rows);
}

std::string passRows(const std::vector<bench::Measured>& results) {
    std::vector<std::vector<std::string>> rows{{"technique: pass", "by timestamps, ms", "by ablation, ms", "draws", "MiB"}};
    for (const bench::Measured& result : results)
        for (const bench::MeasuredPass& pass : result.passes)
            rows.push_back({fmt::format("{}: {}", result.name, pass.name), fmt::format("{:.2f}", bench::median(pass.ms)), fmt::format("{:.2f}", bench::median(pass.ablatedMs)),
                            fmt::format("{}", pass.draws), fmt::format("{:.1f}", mebibytes(pass.bytes))});
    return tableOf(rows);
}

}  // namespace

std::string cellText(const CellResult& result) {
    std::string text = fmt::format("\n## {}\n\n{} lights, {} triangles\n\n{}\n{}\n", headingOf(result), result.lights, result.triangles,
                                   framesTable(result.results), lightingRows(result.results));
    if (const auto all = timed(result.results); !all.empty()) text += bench::verdict(all) + "\n";
    if (!result.results.empty() && !result.results[0].passes[0].ablatedMs.empty()) text += "\n" + passRows(result.results);
    for (const Refused& refused : result.refused) text += fmt::format("Not measured: {}: {}\n", refused.technique, refused.why);
    return text;
}

std::string summaryText(const std::vector<CellResult>& results) {
    if (results.size() < 2) return "";
    std::vector<std::string> names;
    for (const CellResult& result : results)
        for (const bench::Measured& measured : result.results)
            if (std::ranges::find(names, measured.name) == names.end()) names.push_back(measured.name);
    std::vector<std::vector<std::string>> rows{{"technique"}};
    for (const CellResult& result : results) {
        std::vector<std::string> at;
        for (const auto& [name, value] : result.cell.at) at.push_back(fmt::format("{} {}", name, value));
        rows[0].push_back(at.empty() ? headingOf(result) : fmt::format("{}", fmt::join(at, ", ")));
    }
    for (const std::string& name : names) {
        auto& row = rows.emplace_back(std::vector<std::string>{name});
        for (const CellResult& result : results) {
            const auto measured = std::ranges::find(result.results, name, &bench::Measured::name);
            row.push_back(measured == result.results.end() ? "-" : fmt::format("{:.2f}", bench::sampleOf(measured->wallMs).median));
        }
    }
    return fmt::format("\n## All frames: medians, ms\n\n{}", tableOf(rows));
}

namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const bench::Sample& sample) {
    return {{"median", sample.median}, {"low", sample.low}, {"high", sample.high}, {"p95", sample.p95}, {"least", sample.least}, {"variation", sample.variation}};
}

Json jsonOf(const bench::Measured& result) {
    Json json{{"technique", result.name},
              {"frames", result.wallMs.size()},
              {"wallMs", jsonOf(bench::sampleOf(result.wallMs))},
              {"passesMs", jsonOf(bench::sampleOf(result.passesMs))},
              {"lightingMs", jsonOf(bench::sampleOf(result.lightingMs))},
              {"findingMs", jsonOf(bench::sampleOf(result.listsMs))},
              {"evaluatingMs", jsonOf(bench::sampleOf(result.shadingMs))},
              {"evaluations", result.evaluations},
              {"usefulEvaluations", result.useful},
              {"coveredPixels", result.covered},
              {"missedPairs", result.missed ? Json(*result.missed) : Json()},
              {"draws", drawsOf(result.stats)},
              {"peakBytes", result.stats.peakBytes},
              {"passes", Json::array()}};
    for (const bench::MeasuredPass& pass : result.passes) {
        Json row{{"name", pass.name}, {"ms", jsonOf(bench::sampleOf(pass.ms))}, {"bytes", pass.bytes}, {"draws", pass.draws}};
        if (!pass.ablatedMs.empty()) row["ablatedMs"] = jsonOf(bench::sampleOf(pass.ablatedMs));
        json["passes"].push_back(row);
    }
    return json;
}

Json jsonOf(const CellResult& result) {
    Json json{{"scene", result.cell.scene.uri}, {"width", result.cell.view.size.x}, {"height", result.cell.view.size.y},
              {"lights", result.lights},        {"triangles", result.triangles},    {"at", Json::object()},
              {"settings", Json::object()},     {"results", Json::array()},         {"ranking", Json::array()},
              {"refused", Json::array()}};
    for (const auto& [name, value] : result.cell.at) json["at"][name] = value;
    for (const Setting& setting : settingsTable())
        if (setting.name != "lighting") json["settings"][std::string(setting.name)] = setting.get(result.cell.settings);
    for (const bench::Measured& measured : result.results) json["results"].push_back(jsonOf(measured));
    for (const auto& group : bench::rank(timed(result.results))) {
        Json names = Json::array();
        for (const bench::Timed& one : group) names.push_back(one.name);
        json["ranking"].push_back(names);
    }
    for (const Refused& refused : result.refused) json["refused"].push_back({{"technique", refused.technique}, {"why", refused.why}});
    return json;
}

/// What each of our documents begins with.
Json documentOf(const bench::Machine& machine) {
    return {{"schema", kSchema},
            {"machine",
             {{"device", machine.device},
              {"driver", machine.driver},
              {"processor", machine.processor},
              {"threads", machine.threads},
              {"driverThreads", machine.driverThreads},
              {"system", machine.system}}},
            {"version", machine.version},
            {"commit", machine.commit}};
}

std::string textOf(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }  // names from outside need not be UTF-8

/// Quoted where a comma, a quote or a line end would be taken for the format's own (RFC 4180).
std::string csvField(std::string text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    for (size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2)) text.insert(at, 1, '"');
    return "\"" + text + "\"";
}

}  // namespace

std::string benchJson(const bench::Machine& machine, const std::vector<CellResult>& results) {
    Json json = documentOf(machine);
    json["cells"] = Json::array();
    for (const CellResult& result : results) json["cells"].push_back(jsonOf(result));
    return textOf(json);
}

std::string reproductionText(const bench::Machine& machine, const bench::Reproduction& reproduction, const std::vector<bench::Ratio>& ratios) {
    std::vector<std::vector<std::string>> rows{{"times of", "published", "measured", "95 % interval"}};
    for (const bench::Ratio& ratio : ratios)
        rows.push_back({ratio.what, ratio.published, ratio.whyNot.empty() ? fmt::format("{:.2f}", ratio.measured) : "-",
                        ratio.whyNot.empty() ? fmt::format("{:.2f} - {:.2f}", ratio.low, ratio.high) : ratio.whyNot});
    return fmt::format("{}\n\n{}.\nOther here: {}.\n\n{}", bench::describe(machine), reproduction.source, reproduction.differs, tableOf(rows));
}

std::string reproductionJson(const bench::Machine& machine, const bench::Reproduction& reproduction, const std::vector<bench::Ratio>& ratios) {
    Json json = documentOf(machine);
    json["reproduction"] = {{"name", reproduction.name}, {"source", reproduction.source}, {"differs", reproduction.differs}, {"ratios", Json::array()}};
    for (const bench::Ratio& ratio : ratios) {
        Json row{{"what", ratio.what}, {"published", ratio.published}};
        if (ratio.whyNot.empty())
            row.update({{"measured", ratio.measured}, {"low", ratio.low}, {"high", ratio.high}});
        else
            row["whyNot"] = ratio.whyNot;
        json["reproduction"]["ratios"].push_back(row);
    }
    return textOf(json);
}

std::string benchCsv(const bench::Machine& machine, const std::vector<CellResult>& results) {
    std::vector<std::string> names{"device", "driver", "commit", "scene", "width", "height", "lights", "triangles"};
    if (!results.empty())
        for (const auto& [name, value] : results[0].cell.at) names.push_back("at_" + name);
    names.insert(names.end(), {"technique", "frames", "median_ms", "low_ms", "high_ms", "p95_ms", "least_ms", "variation", "passes_ms", "lighting_ms",
                               "finding_ms", "evaluating_ms", "evaluations", "useful", "covered_pixels", "missed_pairs", "draws", "peak_bytes"});
    std::string text = fmt::format("{}\r\n", fmt::join(names, ","));
    for (const CellResult& result : results)
        for (const bench::Measured& measured : result.results) {
            const bench::Sample wall = bench::sampleOf(measured.wallMs);
            std::vector<std::string> row{machine.device, machine.driver, machine.commit, result.cell.scene.uri};
            const auto add = [&](const auto&... values) { (row.push_back(fmt::format("{}", values)), ...); };
            add(result.cell.view.size.x, result.cell.view.size.y, result.lights, result.triangles);
            for (const auto& [name, value] : result.cell.at) row.push_back(value);
            add(measured.name, wall.count, wall.median, wall.low, wall.high, wall.p95, wall.least, wall.variation, bench::median(measured.passesMs),
                bench::median(measured.lightingMs), bench::median(measured.listsMs), bench::median(measured.shadingMs), measured.evaluations, measured.useful,
                measured.covered, measured.missed ? fmt::format("{}", *measured.missed) : "", drawsOf(measured.stats), measured.stats.peakBytes);
            std::ranges::transform(row, row.begin(), csvField);
            text += fmt::format("{}\r\n", fmt::join(row, ","));
        }
    return text;
}

}  // namespace luciole::cli
