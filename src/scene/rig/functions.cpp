#include <algorithm>
#include <array>

#include <fmt/format.h>

#include <luciole/error.hpp>

#include "scene/rig/sections.hpp"
#include "scene/rig/values.hpp"

namespace luciole::rig {
namespace {

using Kind = Function::Kind;

/// A kind as rigs write it; its name is also that of a built-in function with the usual parameter.
struct KindRow {
    Kind kind;
    std::string_view name;
    bool hasParameter;
    float usual;
    double low, high;  ///< bounds of the parameter
};
constexpr std::array<KindRow, 6> kKinds{{
    {Kind::lambert, "lambert", false, 0, 0, 0},
    {Kind::wrap, "wrap", true, 0.5f, 0, 1},
    {Kind::orenNayar, "orenNayar", true, 0.5f, 0, JsonNode::kMost},
    {Kind::blinnPhong, "blinnPhong", true, 32, 0, JsonNode::kMost},
    {Kind::constant, "constant", true, 1, -JsonNode::kMost, JsonNode::kMost},
    {Kind::toon, "toon", true, 3, 1, JsonNode::kMost},
}};

/// Curves for attenuation: from 1 at the light to 0 at its range.
Function linearFade() { return {.name = "linear", .kind = Kind::sampled, .samples = {vec2(1), vec2(0)}}; }
Function smoothFade() {
    constexpr int kSteps = 64;  // chords of a cubic: off by at most 6 / 8 / 64^2 = 0.0002
    Function function{.name = "smooth", .kind = Kind::sampled};
    for (int i = 0; i <= kSteps; ++i) {
        const float x = float(i) / kSteps;
        function.samples.emplace_back(1 - x * x * (3 - 2 * x), i < kSteps ? 1 : 0);
    }
    return function;
}

std::optional<Function> builtinFunction(std::string_view name) {
    for (const KindRow& row : kKinds) {
        if (row.name == name) return Function{.name = std::string(name), .kind = row.kind, .parameter = row.usual};
    }
    if (name == "linear") return linearFade();
    if (name == "smooth") return smoothFade();
    return std::nullopt;
}

vec2 sample(const JsonNode& node, bool twoChannels) {
    if (twoChannels) {
        if (!node.isArray() || node.size() != 2) node.fail("[shape, cascade], as the first sample");
        return vec2(node[0].number(), node[1].number());
    }
    if (!node.isNumber()) node.fail("a number, as the first sample");
    const auto shape = float(node.number());
    return vec2(shape, shape > 0 ? 1 : 0);
}

std::vector<vec2> samples(const JsonNode& list) {
    if (list.size() < 2) list.fail("at least 2 samples");
    const bool twoChannels = list[0].isArray();
    std::vector<vec2> result;
    for (const JsonNode& node : list.elements()) result.push_back(sample(node, twoChannels));
    return result;
}

/// Kind, parameter and samples; the name is the caller's.
Function shape(const JsonNode& node) {
    const JsonNode kind = node.at("kind");
    if (kind.isString() && kind.string() == "sampled") {
        if (const auto extra = node.find("parameter")) extra->failWith("a sampled function has no parameter");
        return {.name = "sampled", .kind = Kind::sampled, .samples = samples(node.at("samples"))};
    }
    const KindRow& row =
        kKinds[kind.choice({"lambert", "wrap", "orenNayar", "blinnPhong", "constant", "toon", "sampled"})];
    if (const auto extra = node.find("samples")) extra->failWith("only a sampled function has samples");
    Function function{.name = std::string(row.name), .kind = row.kind, .parameter = row.usual};
    if (const auto parameter = node.find("parameter")) {
        if (!row.hasParameter) parameter->failWith(fmt::format("{} has no parameter", row.name));
        function.parameter =
            float(row.kind == Kind::toon ? double(parameter->integer(1, 65536)) : parameter->number(row.low, row.high));
    }
    if (row.hasParameter) function.name = fmt::format("{}({})", row.name, function.parameter);
    return function;
}

uint32_t append(Scene& scene, Function function, const JsonNode& source) {
    if (scene.functions.size() >= kMaxFunctions) {
        throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} functions in the scene, got {}",
                                                  source.where(), kMaxFunctions, kMaxFunctions + 1));
    }
    scene.functions.push_back(std::move(function));
    return uint32_t(scene.functions.size() - 1);
}

uint32_t inPlace(const JsonNode& node, Scene& scene) {
    node.expectKeys({"kind", "parameter", "samples"});
    Function function = shape(node);
    const auto same = [&](const Function& f) {
        return f.name == function.name && f.kind == function.kind && f.parameter == function.parameter &&
               f.samples == function.samples;
    };
    const auto found = std::find_if(scene.functions.begin(), scene.functions.end(), same);
    if (found != scene.functions.end()) return uint32_t(found - scene.functions.begin());
    return append(scene, std::move(function), node);
}

}  // namespace

std::optional<uint32_t> namedFunction(std::string_view name, const JsonNode& user, Scene& scene) {
    const size_t index = indexOf(scene.functions, name);
    if (index < scene.functions.size()) return uint32_t(index);
    if (auto builtin = builtinFunction(name)) return append(scene, std::move(*builtin), user);
    return std::nullopt;
}

uint32_t functionIndex(const JsonNode& reference, Scene& scene) {
    if (reference.isObject()) return inPlace(reference, scene);
    if (!reference.isString()) reference.fail("a function's name, or a function as an object");
    if (const auto index = namedFunction(reference.string(), reference, scene)) return *index;
    reference.fail(
        fmt::format("a built-in function (lambert, wrap, orenNayar, blinnPhong, constant, toon, linear, smooth) or one "
                    "of the scene's "
                    "({})",
                    someNames(scene.functions)));
}

void applyFunctions(const JsonNode& list, Scene& scene) {
    for (const JsonNode& entry : list.elements()) {
        entry.expectKeys({"name", "kind", "parameter", "samples"});
        Function function = shape(entry);
        function.name = entry.at("name").string();
        const size_t index = indexOf(scene.functions, function.name);
        if (index < scene.functions.size()) {
            scene.functions[index] = std::move(function);  // in place: whoever uses it sees the new one
        } else {
            append(scene, std::move(function), entry);
        }
    }
}

}  // namespace luciole::rig
