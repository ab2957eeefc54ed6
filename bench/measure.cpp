#include "measure.hpp"

#include <fmt/format.h>

#include <chrono>
#include <numeric>

#include "sample.hpp"

namespace luciole::bench {
namespace {

constexpr std::string_view kIdeal = "ideal";

double sumOf(const Image& image) { return std::accumulate(image.data.begin(), image.data.end(), 0.0); }

/// Whether a pass evaluates lights, or is there without them; else it finds out which.
bool shades(std::string_view pass, const std::string& technique) {
    if (pass == "lighting.initial") return true;
    const std::string own = "lighting." + technique;
    if (!pass.starts_with(own)) return false;
    pass.remove_prefix(own.size());
    return pass.empty() || pass == ".surfaces" || pass == ".blended" || pass == ".color";
}

void addTo(Measured& result, const PassStats& pass) {
    auto place = std::ranges::find(result.passes, pass.name, &MeasuredPass::name);
    if (place == result.passes.end()) place = result.passes.insert(place, {pass.name});
    if (const size_t frame = result.passesMs.size(); place->ms.size() <= frame) {
        place->ms.resize(frame + 1);
        place->bytes = place->draws = 0;
    }
    place->ms.back() += pass.ms.value();
    place->bytes += pass.bytes;
    place->draws += pass.draws;
}

void addAblation(Measured& result, const std::vector<PassStats>& passes) {
    for (MeasuredPass& pass : result.passes) {
        double& sum = pass.ablatedMs.emplace_back(0);
        for (const PassStats& cut : passes)
            if (cut.name == pass.name) sum += cut.ms.value();
    }
}

void add(Measured& result, const Frame& frame, const std::string& technique) {
    double passes = 0, lists = 0, shading = 0;
    for (const PassStats& pass : frame.stats.passes) {
        if (pass.name.starts_with("output.")) continue;
        addTo(result, pass);
        passes += pass.ms.value();
        if (!pass.name.starts_with("lighting.")) continue;
        if (shades(pass.name, technique))
            shading += pass.ms.value();
        else if (technique != kIdeal)
            lists += pass.ms.value();
    }
    result.passesMs.push_back(passes);
    result.listsMs.push_back(lists);
    result.shadingMs.push_back(shading);
    result.lightingMs.push_back(lists + shading);
    result.stats = frame.stats;
}

}  // namespace

Contender contender(const std::string& technique) {
    Contender made{technique, {.lighting = technique}};
    if (technique == "light-indexed") {
        made.name += ", list";
        made.settings.lidrPacking = LidrPacking::list;
    }
    return made;
}

namespace {

std::vector<Contender> contenders(std::initializer_list<const char*> techniques) {
    std::vector<Contender> made;
    for (const char* technique : techniques) made.push_back(contender(technique));
    return made;
}

}  // namespace

std::vector<Contender> listContenders() { return contenders({"tiled", "tiled-points", "clustered", "clustered-forward"}); }
std::vector<Contender> fastContenders() {
    std::vector<Contender> all = listContenders(), others = contenders({"volume-stencil", "light-prepass", "light-indexed"});
    all.insert(all.end(), others.begin(), others.end());
    return all;
}
std::vector<Contender> otherContenders() { return contenders({"quad", "volume", "volume-stencil-reference", "volume-instanced"}); }
std::vector<Contender> slowContenders() { return contenders({"brute-force", "fullscreen", "forward-loop", "forward-multipass"}); }
Contender ideal() { return contender(std::string(kIdeal)); }

std::vector<Measured> measure(Renderer& renderer, const View& view, const std::vector<Contender>& contenders, const Effort& effort,
                              const std::function<void(double)>& progress) {
    constexpr int kLeast = 3;
    using Clock = std::chrono::steady_clock;
    std::vector<Measured> results;
    for (const Contender& contender : contenders) results.push_back({.name = contender.name});
    std::vector<double> seconds(contenders.size(), 0), done(contenders.size(), 0);
    for (bool goesOn = true; goesOn;) {
        goesOn = false;
        for (size_t i = 0; i < contenders.size(); ++i) {
            if (done[i] == 1) continue;
            Measured& result = results[i];
            RenderSettings settings = contenders[i].settings;
            const auto start = Clock::now();
            renderer.render(view, settings);
            result.wallMs.push_back(renderer.render(view, settings).stats.wallMs);
            settings.measure = true;
            add(result, renderer.render(view, settings), settings.lighting);
            if (int(result.wallMs.size()) <= effort.ablations) addAblation(result, renderer.ablate(view, settings));
            seconds[i] += std::chrono::duration<double>(Clock::now() - start).count();
            const int frames = int(result.wallMs.size());
            const bool enough = frames >= effort.frames && (frames >= effort.most || sampleOf(result.wallMs).halfWidth() <= effort.halfWidth);
            const bool late = seconds[i] >= effort.seconds && frames >= std::min(kLeast, effort.frames);
            done[i] = enough || late ? 1 : std::min(0.99, std::max(double(frames) / effort.most, seconds[i] / effort.seconds));
            goesOn |= done[i] < 1;
            if (progress) progress(std::accumulate(done.begin(), done.end(), 0.0) / double(done.size()));
        }
    }
    return results;
}

void count(Renderer& renderer, const View& view, const std::vector<Contender>& contenders, std::vector<Measured>& results) {
    const double pixels = double(view.extent.x) * view.extent.y;
    const Image reached = renderer.render(view, {.lighting = "tiled"}, {"light-count"}).aovs.at("light-count");
    for (size_t i = 0; i < contenders.size(); ++i) {
        const Frame counted = renderer.render(view, contenders[i].settings, {"evaluations", "useful-evaluations"});
        const Image& evaluations = counted.aovs.at("evaluations");
        results[i].evaluations = sumOf(evaluations) / pixels;
        results[i].covered = double(std::ranges::count_if(evaluations.data, [](float lights) { return lights > 0; }));
        const Image& useful = counted.aovs.at("useful-evaluations");
        results[i].useful = sumOf(useful) / pixels;
        if (contenders[i].settings.msaa != Msaa::x1) continue;
        double missed = 0;
        for (size_t pixel = 0; pixel < useful.data.size(); ++pixel) missed += std::max(0.0f, reached.data[pixel] - useful.data[pixel]);
        results[i].missed = missed;
    }
}

std::string milliseconds(const std::vector<double>& values) {
    return fmt::format("{:.1f} ({:.1f})", median(values), least(values));
}

std::string frameTable(const std::vector<Measured>& results, std::optional<double> otherMs) {
    std::string table = fmt::format(
        "| technique | frame, ms: median (least) | its passes, ms |{} evaluations a pixel | useful | pairs missed |\n| --- | ---: | ---: |{} ---: | ---: | ---: |\n",
        otherMs ? " times faster |" : "", otherMs ? " ---: |" : "");
    for (const Measured& result : results) {
        table += fmt::format("| {} | {} | {} |", result.name, milliseconds(result.wallMs), milliseconds(result.passesMs));
        if (otherMs) table += fmt::format(" {:.2f} ({:.2f}) |", *otherMs / median(result.wallMs), *otherMs / least(result.wallMs));
        table += fmt::format(" {:.2f} | {:.2f} | {:.0f} |\n", result.evaluations, result.useful, result.missed.value());
    }
    return table;
}

std::string timesIdeal(const Measured& result, const std::vector<Measured>& results) {
    const auto bound = std::ranges::find(results, kIdeal, &Measured::name);
    if (bound == results.end()) return "-";
    return fmt::format("{:.2f} ({:.2f})", median(result.lightingMs) / median(bound->lightingMs), least(result.lightingMs) / least(bound->lightingMs));
}

std::string lightingTable(const std::vector<Measured>& results) {
    std::string table =
        "| technique | lighting, ms: median (least) | lists, ms | shading, ms | times ideal | evaluations a pixel | useful | entries | "
        "longest list | lists, MiB |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
    for (const Measured& result : results) {
        table += fmt::format("| {} | {} | {} | {} | {} | {:.2f} | {:.2f} |", result.name, milliseconds(result.lightingMs), milliseconds(result.listsMs),
                             milliseconds(result.shadingMs), timesIdeal(result, results), result.evaluations, result.useful);
        if (const auto& lists = result.stats.lightLists)
            table += fmt::format(" {} | {} | {:.2f} |\n", lists->entries, lists->longest, double(lists->bytes) / (1 << 20));
        else
            table += " - | - | - |\n";
    }
    return table;
}

}  // namespace luciole::bench
