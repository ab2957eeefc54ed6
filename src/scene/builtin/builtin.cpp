#include "scene/builtin/builtin.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

#include <fmt/format.h>
#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/builtin/scenes.hpp"

namespace luciole {

namespace {

constexpr std::string_view kScheme = "builtin:";

/// Parameters by name, all of a scene's, those not given at their fallback.
using Values = std::map<std::string_view, double>;

/// A row of the table: what the world sees, and how the scene is made.
struct Row {
    BuiltinScene scene;
    Scene (*make)(const Values&);
};

const std::vector<Row>& rows() {
    constexpr double kMaxSeed = 4294967295.0;
    static const std::vector<Row> kRows = {
        {{"hall",
          "a colonnade whose columns hide much of it, hung with small coloured lamps",
          {{"lights", "number of lights", 255, 0, 1'048'576},
           {"overlap", "mean number of lights that reach a visible pixel, at 4:3", 4, 0.1, 256, false},
           {"triangles", "number of triangles, met within 2 %", 40'000, 1'000, 4'000'000},
           {"seed", "where the lights hang and things stand", 1, 0, kMaxSeed},
           {"gltf", "1: materials are glTF's own, each of one colour", 0, 0, 1}}},
         [](const Values& values) {
             return makeHall({.lights = uint32_t(values.at("lights")),
                              .overlap = values.at("overlap"),
                              .triangles = uint32_t(values.at("triangles")),
                              .seed = uint32_t(values.at("seed")),
                              .gltf = values.at("gltf") != 0});
         }},
        {{"materials", "spheres with every kind of dot-product function, from plastic to metal", {}},
         [](const Values&) { return makeMaterials(); }},
        {{"fireflies",
          "a garden at dusk, lit by its fireflies",
          {{"lights", "number of fireflies", 1000, 0, 100'000},
           {"seed", "where things grow and fireflies hover", 1, 0, kMaxSeed}}},
         [](const Values& values) {
             return makeFireflies({.lights = uint32_t(values.at("lights")), .seed = uint32_t(values.at("seed"))});
         }},
    };
    return kRows;
}

[[noreturn]] void fail(const std::string& uri, std::string_view where, const std::string& expected,
                       std::string_view found) {
    throw Error(ErrorKind::usage, fmt::format("{}: {}: expected {}, got \"{}\"", uri, where, expected, found));
}

template <class Range, class Name>
std::string listed(const Range& range, Name name) {
    std::string list;
    for (const auto& item : range) list += (list.empty() ? "" : ", ") + std::string(name(item));
    return list;
}

double parseValue(const std::string& uri, const BuiltinParameter& parameter, std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool number = error == std::errc{} && end == text.data() + text.size();
    const bool inRange = value >= parameter.low && value <= parameter.high;
    if (!number || !inRange || (parameter.whole && value != std::floor(value)))
        fail(uri, parameter.name,
             fmt::format("a {}number from {:.10g} to {:.10g}", parameter.whole ? "whole " : "", parameter.low,
                         parameter.high),
             text);
    return value;
}

/// Cuts off and returns what stands before the first `separator`; all of it if there is none.
std::string_view cut(std::string_view& text, char separator) {
    const size_t at = std::min(text.find(separator), text.size());
    const std::string_view head = text.substr(0, at);
    text.remove_prefix(std::min(at + 1, text.size()));
    return head;
}

Values parseQuery(const std::string& uri, const BuiltinScene& scene, std::string_view query) {
    Values values;
    while (!query.empty()) {
        std::string_view text = cut(query, '&');
        const std::string_view key = cut(text, '=');
        const auto parameter = std::ranges::find(scene.parameters, key, &BuiltinParameter::name);
        if (parameter == scene.parameters.end()) {
            const std::string known = listed(scene.parameters, [](const auto& p) { return p.name; });
            fail(uri, key, known.empty() ? "no parameters" : "one of " + known, key);
        }
        if (!values.emplace(parameter->name, parseValue(uri, *parameter, text)).second)
            fail(uri, key, "each parameter once", key);
    }
    for (const BuiltinParameter& parameter : scene.parameters) values.emplace(parameter.name, parameter.fallback);
    return values;
}

}  // namespace

const std::vector<BuiltinScene>& builtinScenes() {
    static const std::vector<BuiltinScene> kScenes = [] {
        std::vector<BuiltinScene> scenes;
        for (const Row& row : rows()) scenes.push_back(row.scene);
        return scenes;
    }();
    return kScenes;
}

uint32_t addMesh(Scene& scene, Mesh mesh, std::string name) {
    mesh.name = std::move(name);
    scene.meshes.push_back(std::move(mesh));
    return uint32_t(scene.meshes.size() - 1);
}

uint32_t addMaterial(Scene& scene, Material material) {
    scene.materials.push_back(std::move(material));
    return uint32_t(scene.materials.size() - 1);
}

uint32_t addFunction(Scene& scene, Function function) {
    scene.functions.push_back(std::move(function));
    return uint32_t(scene.functions.size() - 1);
}

void addObject(Scene& scene, std::string name, uint32_t mesh, uint32_t material, const mat4& worldFromObject) {
    scene.objects.push_back({.name = std::move(name),
                             .mesh = mesh,
                             .material = material,
                             .worldFromObject = worldFromObject,
                             .objectId = std::min(uint32_t(scene.objects.size()), kMaxObjectId)});
}

mat4 placed(vec3 position, float angle, float scale) {
    const mat4 moved = glm::translate(mat4(1), position);
    return glm::scale(glm::rotate(moved, angle, vec3(0, 1, 0)), vec3(scale));
}

Scene makeBuiltin(const std::string& uri) {
    std::string_view rest = uri;
    if (!rest.starts_with(kScheme)) fail(uri, "scheme", std::string(kScheme), rest.substr(0, kScheme.size()));
    rest.remove_prefix(kScheme.size());
    const std::string_view name = cut(rest, '?');
    const auto row = std::ranges::find(rows(), name, [](const Row& r) { return r.scene.name; });
    if (row == rows().end())
        fail(uri, "name", "one of " + listed(rows(), [](const Row& r) { return r.scene.name; }), name);
    Scene scene = row->make(parseQuery(uri, row->scene, rest));
    scene.name = name;
    return scene;
}

}  // namespace luciole
