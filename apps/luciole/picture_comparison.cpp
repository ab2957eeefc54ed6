#include "picture_comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <luciole/error.hpp>
#include <luciole/metrics.hpp>
#include <luciole/output.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "interrupt.hpp"
#include "options.hpp"
#include "outputs.hpp"

namespace luciole::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Metric {
    std::string_view option;  ///< without its dashes
    std::string_view key;     ///< of JSON
    std::string_view name;
    std::string_view unit;
    bool atLeast;             ///< more is better
    double low, high;         ///< that a limit may have
    std::string_view help;
    std::optional<double> (*value)(const ImageDifference&);
};

constexpr std::array<Metric, kLimitCount> kMetrics{{
    {"max-error", "maxErrorPercent", "relative error, largest", "%", false, 0, kInfinity, "largest relative error that passes, in %",
     [](const ImageDifference& d) { return std::optional(100 * d.relativeError.max); }},
    {"p999-error", "p999ErrorPercent", "relative error, 99.9 % of pixels", "%", false, 0, kInfinity,
     "the same for all but a thousandth of the pixels", [](const ImageDifference& d) { return std::optional(100 * d.relativeError.p999); }},
    {"mean-error", "meanErrorPercent", "relative error, mean", "%", false, 0, kInfinity, "the same for the mean",
     [](const ImageDifference& d) { return std::optional(100 * d.relativeError.mean); }},
    {"psnr", "psnrDb", "PSNR", "dB", true, 0, kInfinity, "least peak signal-to-noise ratio that passes, in dB",
     [](const ImageDifference& d) { return d.psnr; }},
    {"ssim", "ssim", "SSIM", "", true, -1, 1, "least structural similarity that passes", [](const ImageDifference& d) { return d.ssim; }},
    {"flip", "flipMean", "FLIP, mean", "", false, 0, 1, "largest mean FLIP error that passes",
     [](const ImageDifference& d) { return d.flipMap ? std::optional(d.flip.mean) : std::nullopt; }},
}};

bool isExr(const std::string& file) { return hasExtension(file, ".exr"); }

void checkFiles(const PictureComparison& comparison) {
    for (const std::string& file : {comparison.reference, comparison.test})
        if (!isExr(file) && !hasExtension(file, ".png"))
            throw Error(ErrorKind::usage, fmt::format("{}: expected a name that ends in .png or .exr", file));
    if (isExr(comparison.reference) != isExr(comparison.test))
        throw Error(ErrorKind::usage, fmt::format("compare: expected two .exr or two .png, got {} and {}", comparison.reference, comparison.test));
    if (!comparison.layer.empty() && !isExr(comparison.reference))
        throw Error(ErrorKind::usage, "--layer: PNG has no layers");
    if (comparison.mapFile.empty()) return;
    if (!hasExtension(comparison.mapFile, ".png"))
        throw Error(ErrorKind::usage, fmt::format("{}: expected a name that ends in .png", comparison.mapFile));
    requireWritable(comparison.mapFile);
}

Image readPicture(const std::string& file, const std::string& layer) {
    if (!isExr(file)) return readPng(file);
    std::map<std::string, Image> layers = readExr(file);
    const auto found = layers.find(layer);
    if (found != layers.end()) return std::move(found->second);
    std::vector<std::string> names;
    for (const auto& [name, image] : layers) names.push_back(name.empty() ? "the picture" : name);
    throw Error(ErrorKind::usage, fmt::format("{}: expected {}, got {}", file, layer.empty() ? "channels R, G, B" : fmt::format("layer {}", layer),
                                              fmt::join(names, ", ")));
}

std::string shapeOf(const Image& image) {
    return fmt::format("{}x{} with {} channel{}", image.width, image.height, image.channels, image.channels == 1 ? "" : "s");
}

/// What was compared, for people.
std::string describe(const PictureComparison& comparison, const ImageDifference& difference) {
    if (!comparison.layer.empty()) return fmt::format("layer {}", comparison.layer);
    if (!isExr(comparison.reference)) return "display values; relative errors of them in linear light";
    return difference.flipMap && comparison.exposureEv != 0 ? fmt::format("radiance; PSNR and SSIM of it at {:+} stops", comparison.exposureEv) : "radiance";
}

bool holds(const Metric& metric, double value, double limit) { return metric.atLeast ? value >= limit : value <= limit; }

/// The options of the limits that do not hold.
std::vector<std::string> exceeded(const PictureComparison& comparison, const ImageDifference& difference) {
    std::vector<std::string> options;
    for (size_t i = 0; i < kLimitCount; ++i) {
        const std::optional<double> value = kMetrics[i].value(difference);
        if (comparison.limits[i] && !(value && holds(kMetrics[i], *value, *comparison.limits[i])))
            options.push_back(fmt::format("--{}", kMetrics[i].option));
    }
    return options;
}

bool passes(const PictureComparison& comparison, const ImageDifference& difference) {
    const bool limited = std::ranges::any_of(comparison.limits, [](const auto& limit) { return limit.has_value(); });
    return difference.notFinite == 0 && (limited ? exceeded(comparison, difference).empty() : difference.identical);
}

std::string verdict(const PictureComparison& comparison, const ImageDifference& difference) {
    if (difference.notFinite > 0)
        return fmt::format("{} pixels are NaN or infinite in one of the pictures, the first at x = {}, y = {}", difference.notFinite,
                           difference.firstNotFinite.x, difference.firstNotFinite.y);
    if (difference.identical) return "identical";
    if (const auto options = exceeded(comparison, difference); !options.empty())
        return fmt::format("different: beyond {}", fmt::join(options, ", "));
    return passes(comparison, difference) ? "within the limits" : "different";
}

std::string differenceText(const PictureComparison& comparison, const ImageDifference& difference, const std::string& shape) {
    std::string text = fmt::format("{}, {}\n", shape, describe(comparison, difference));
    for (size_t i = 0; i < kLimitCount; ++i) {
        const Metric& metric = kMetrics[i];
        const std::optional<double> value = metric.value(difference), limit = comparison.limits[i];
        text += fmt::format("{:<33} {:>12} {:<2}", metric.name, value ? fmt::format("{:.6g}", *value) : "-", metric.unit);
        if (limit) text += fmt::format("  at {} {:g}", metric.atLeast ? "least" : "most", *limit);
        text.erase(text.find_last_not_of(' ') + 1);
        text += '\n';
    }
    return text + verdict(comparison, difference) + "\n";
}

std::string differenceJson(const PictureComparison& comparison, const ImageDifference& difference, const Image& reference) {
    // JSON knows no infinity.
    const auto number = [](const std::optional<double>& value) { return value && std::isfinite(*value) ? Json(*value) : Json(); };
    Json json{{"reference", comparison.reference}, {"test", comparison.test},
              {"layer", comparison.layer},         {"width", reference.width},
              {"height", reference.height},        {"channels", reference.channels},
              {"identical", difference.identical}, {"passes", passes(comparison, difference)},
              {"verdict", verdict(comparison, difference)}};
    json["notFinite"] = {{"pixels", difference.notFinite}};
    if (difference.notFinite > 0) json["notFinite"]["first"] = {difference.firstNotFinite.x, difference.firstNotFinite.y};
    for (const Metric& metric : kMetrics) json[std::string(metric.key)] = number(metric.value(difference));
    if (difference.flipMap) json["flipMax"] = difference.flip.max;
    json["limits"] = Json::object();
    for (size_t i = 0; i < kLimitCount; ++i)
        if (comparison.limits[i]) json["limits"][std::string(kMetrics[i].key)] = *comparison.limits[i];
    // File names need not be UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// \throws Error(usage) for a limit of what the images do not have
void checkLimits(const PictureComparison& comparison, const ImageDifference& difference) {
    for (size_t i = 0; i < kLimitCount; ++i)
        if (comparison.limits[i] && !kMetrics[i].value(difference) && difference.notFinite == 0)
            throw Error(ErrorKind::usage, fmt::format("--{}: expected pictures with R, G and B, got other numbers", kMetrics[i].option));
}

}  // namespace

void addPictureComparisonOptions(CLI::App& command, PictureComparison& comparison) {
    for (size_t i = 0; i < kLimitCount; ++i) {
        const auto read = [i, &limit = comparison.limits[i]](const std::string& text) {
            const Metric& metric = kMetrics[i];
            const std::string option = fmt::format("--{}", metric.option);
            limit = parseNumber(option, text);
            if (*limit < metric.low || *limit > metric.high)
                throw Error(ErrorKind::usage, fmt::format("{}: expected a number from {} to {}, got \"{}\"", option, metric.low, metric.high, text));
        };
        addParsed(command, fmt::format("--{}", kMetrics[i].option), read, std::string(kMetrics[i].help))->type_name("NUMBER")->group("Limits");
    }
    command.add_option("--layer", comparison.layer, "compare a layer of EXR instead of the picture")->type_name("NAME")->group("Pictures");
    command.add_flag("--json", comparison.json, "print JSON")->group("Pictures");
}

bool comparePictures(const PictureComparison& comparison, const Console& console) {
    checkFiles(comparison);
    const Image reference = readPicture(comparison.reference, comparison.layer), test = readPicture(comparison.test, comparison.layer);
    if (shapeOf(reference) != shapeOf(test))
        throw Error(ErrorKind::usage, fmt::format("{}: expected {}, as {}, got {}", comparison.test, shapeOf(reference), comparison.reference, shapeOf(test)));
    const PixelValues values = !comparison.layer.empty()         ? PixelValues::numbers
                               : isExr(comparison.reference) ? PixelValues::radiance
                                                                 : PixelValues::display;
    const ImageDifference difference = [&] {
        const ProgressLine progress(console, "comparing:");
        return compareImages(reference, test, values, comparison.exposureEv);
    }();
    checkLimits(comparison, difference);
    if (!comparison.mapFile.empty()) {
        const FinishFirst guard;
        writePng(comparison.mapFile, differenceMap(difference));
    }
    fmt::print("{}", comparison.json ? differenceJson(comparison, difference, reference) : differenceText(comparison, difference, shapeOf(reference)));
    return passes(comparison, difference);
}

}  // namespace luciole::cli
