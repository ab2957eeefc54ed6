#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <glm/gtc/packing.hpp>
#include <luciole/error.hpp>
#include <luciole/metrics.hpp>
#include <luciole/output.hpp>
#include <nlohmann/json.hpp>
#include <sample.hpp>

#include "compare_scene.hpp"

namespace luciole::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;  ///< of the data; apps/report/src/data.js reads it

/// RFC 4648, section 4.
std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        for (size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? uint32_t(bytes[i + k]) : 0);
        for (size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63];
    }
    return text;
}

std::string pictureOf(const Image& image) { return "data:image/png;base64," + base64(pngOf(image)); }

/// Half floats, planes R, G, B. Those of a picture that resembles another are mostly the other's: their XOR is mostly zeros, which shrink to
/// next to nothing.
std::vector<uint16_t> halfPlanes(const Image& radiance) {
    const size_t pixels = size_t(radiance.width) * radiance.height;
    std::vector<uint16_t> planes(3 * pixels);
    for (size_t i = 0; i < pixels; ++i)
        for (size_t c = 0; c < 3; ++c) planes[c * pixels + i] = glm::packHalf1x16(radiance.data[3 * i + c]);
    return planes;
}

std::string compressed(const std::vector<uint16_t>& values) {
    uLongf size = ::compressBound(uLong(values.size() * sizeof(uint16_t)));
    std::vector<std::byte> bytes(size);
    if (::compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(values.data()), uLong(values.size() * sizeof(uint16_t)),
                    Z_DEFAULT_COMPRESSION) != Z_OK)
        throw std::bad_alloc();  // the only way to fail with room enough
    return base64(std::span(bytes).first(size));
}

Json imageOf(const std::string& name, const Frame& frame, const std::vector<uint16_t>& planes) {
    return {{"name", name}, {"picture", pictureOf(frame.display)}, {"radiance", compressed(planes)}};
}

/// Infinity, which JSON does not know, as null.
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

const LightingTechniqueInfo& infoOf(const std::string& technique) {
    return *std::ranges::find(lightingTechniques(), technique, &LightingTechniqueInfo::name);
}

/// What is the same for all techniques, so that their maps are of one scale.
struct Scales {
    float error = 1e-6f;  ///< relative; rounding alone makes more
    float lights = 1;     ///< evaluated at a pixel
};

/// Techniques evaluate between a handful of lights and all of them: on a linear scale the better ones would all look alike.
Image logarithmic(Image counts) {
    for (float& count : counts.data) count = std::log2(1 + count);
    return counts;
}

Json techniqueOf(const Compared& compared, const Frame& reference, const Image& error, size_t image, const Scales& scales) {
    const bench::Measured& measured = compared.measured;
    const bench::Sample wall = bench::sampleOf(measured.wallMs);
    const ErrorSummary errors = summaryOf(error);
    const Image flipError = flip(reference.display, compared.frame.display);
    const LightingTechniqueInfo& info = infoOf(measured.name.substr(0, measured.name.find(' ')));
    Json json{{"name", measured.name},
              {"help", info.help},
              {"source", info.source},
              {"image", image},
              {"difference", pictureOf(heatMap(error, scales.error))},
              {"flip", pictureOf(heatMap(flipError, 1))},
              {"overlap", pictureOf(heatMap(logarithmic(compared.frame.aovs.at("evaluations")), std::log2(1 + scales.lights)))},
              {"metrics",
               {{"maxError", finite(100 * errors.max)},
                {"p999Error", finite(100 * errors.p999)},
                {"meanError", finite(100 * errors.mean)},
                {"psnr", finite(psnr(reference.display, compared.frame.display))},
                {"ssim", ssim(reference.display, compared.frame.display)},
                {"flip", summaryOf(flipError).mean}}},
              {"wallMs", {{"median", wall.median}, {"low", wall.low}, {"high", wall.high}}},
              {"passes", Json::array()},
              {"peakBytes", measured.stats.peakBytes},
              {"evaluations", measured.evaluations},
              {"useful", measured.useful}};
    for (const bench::MeasuredPass& pass : measured.passes)
        json["passes"].push_back({{"name", pass.name}, {"ms", bench::median(pass.ms)}, {"bytes", pass.bytes}, {"draws", pass.draws}});
    return json;
}

/// Numbers, if all of them are some that have a logarithm; names otherwise.
Json valuesOf(const std::vector<CellResult>& sweep) {
    Json names = Json::array(), numbers = Json::array();
    for (const CellResult& cell : sweep) {
        const std::string& text = cell.cell.at[0].second;
        names.push_back(text);
        double number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error == std::errc() && end == text.data() + text.size() && number > 0) numbers.push_back(number);
    }
    return numbers.size() == names.size() ? numbers : names;
}

Json sweepOf(const std::vector<CellResult>& sweep) {
    if (sweep.empty()) return {};
    Json json{{"parameter", sweep[0].cell.at[0].first}, {"values", valuesOf(sweep)}, {"series", Json::array()}};
    std::vector<std::string> names;
    for (const CellResult& cell : sweep)
        for (const bench::Measured& measured : cell.results)
            if (std::ranges::find(names, measured.name) == names.end()) names.push_back(measured.name);
    for (const std::string& name : names) {
        Json ms = Json::array();
        for (const CellResult& cell : sweep) {
            const auto found = std::ranges::find(cell.results, name, &bench::Measured::name);
            ms.push_back(found == cell.results.end() ? Json() : Json(bench::sampleOf(found->wallMs).median));
        }
        json["series"].push_back({{"name", name}, {"ms", ms}});
    }
    return json;
}

}  // namespace

std::string reportData(const SceneComparison& comparison, const bench::Machine& machine, const Frame& reference, const std::vector<Compared>& compared,
                       const std::vector<Refused>& refused, const std::vector<CellResult>& sweep) {
    Json json{{"schema", kSchema},
              {"title", comparison.request.scene.uri},
              {"machine",
               {{"cpu", machine.processor},
                {"threads", machine.threads},
                {"device", machine.device},
                {"driver", machine.driver},
                {"system", machine.system},
                {"version", machine.version},
                {"commit", machine.commit}}},
              {"view", {{"width", reference.radiance.width}, {"height", reference.radiance.height}}},
              {"lights", reference.stats.lights},
              {"triangles", reference.stats.triangles},
              {"images", Json::array()},
              {"techniques", Json::array()},
              {"left", Json::array()},
              {"sweep", sweepOf(sweep)}};
    const std::vector<uint16_t> truth = halfPlanes(reference.radiance);
    json["images"].push_back(imageOf("reference", reference, truth));
    Scales scales;
    std::vector<Image> errors;
    for (const Compared& one : compared) {
        errors.push_back(relativeError(reference.radiance, one.frame.radiance));
        const ErrorSummary summary = summaryOf(errors.back());
        if (std::isfinite(summary.p999)) scales.error = std::max(scales.error, float(summary.p999));
        scales.lights = std::max(scales.lights, std::ranges::max(one.frame.aovs.at("evaluations").data));
    }
    json["mapScales"] = {{"error", 100 * scales.error}, {"lights", scales.lights}};
    for (size_t i = 0; i < compared.size(); ++i) {
        std::vector<uint16_t> planes = halfPlanes(compared[i].frame.radiance);
        std::ranges::transform(planes, truth, planes.begin(), std::bit_xor());
        json["images"].push_back(imageOf(compared[i].measured.name, compared[i].frame, planes));
        json["techniques"].push_back(techniqueOf(compared[i], reference, errors[i], i + 1, scales));
    }
    for (const Refused& one : refused) json["left"].push_back({{"name", one.technique}, {"why", one.why}});
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    // Inside of HTML no text may begin a tag.
    for (size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) text.replace(at, 1, "\\u003c");
    return text;
}

}  // namespace luciole::cli
