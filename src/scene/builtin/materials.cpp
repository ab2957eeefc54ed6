#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "scene/builtin/scenes.hpp"
#include "scene/builtin/shapes.hpp"

/// A terrace of spheres. From the lowest step up: metallic-roughness, procedural surfaces, then one step for each pair
/// of dot-product functions. Objects are named after what they show.
namespace luciole {

namespace {

constexpr int kColumns = 7;
constexpr float kStepHeight = 0.55f, kStepDepth = 0.62f, kSpacing = 1.05f, kRadius = 0.4f;

/// One step of the shaped part of the terrace.
struct FunctionRow {
    std::string name;
    uint32_t fa, fb;
    vec3 color;      ///< Cs0
    vec3 highlight;  ///< Cs1
    float ks;
};

std::vector<FunctionRow> addFunctionRows(Scene& scene) {
    using Kind = Function::Kind;
    const auto add = [&](const char* name, Kind kind, float parameter = 0, std::vector<vec2> samples = {}) {
        return addFunction(scene, {name, kind, parameter, std::move(samples)});
    };
    const uint32_t lambert = add("lambert", Kind::lambert);
    const uint32_t wrap = add("wrap 0.6", Kind::wrap, 0.6f);
    const uint32_t orenNayar = add("oren-nayar 0.8", Kind::orenNayar, 0.8f);
    const uint32_t constant = add("constant 0.5", Kind::constant, 0.5f);
    const uint32_t toon = add("toon 3", Kind::toon, 3);
    const uint32_t broad = add("blinn-phong 8", Kind::blinnPhong, 8);
    const uint32_t medium = add("blinn-phong 40", Kind::blinnPhong, 40);
    const uint32_t sharp = add("blinn-phong 250", Kind::blinnPhong, 250);
    // Velvet: brightest at grazing light. And a highlight that is a ring.
    const uint32_t velvet =
        add("sampled velvet", Kind::sampled, 0,
            {{0, 0}, {0, 0}, {0, 0}, {0.15f, 0}, {0.5f, 1}, {0.9f, 1}, {0.55f, 1}, {0.35f, 1}, {0.3f, 1}});
    std::vector<vec2> ringSamples(65, vec2(0, 1));
    for (const size_t i : {60u, 61u, 62u}) ringSamples[i].x = 1;
    const uint32_t ring = add("sampled ring", Kind::sampled, 0, std::move(ringSamples));
    return {{"lambert + blinn-phong 8", lambert, broad, {0.42f, 0.06f, 0.05f}, {1, 0.55f, 0.4f}, 0.8f},
            {"lambert + blinn-phong 40", lambert, medium, {0.45f, 0.16f, 0.03f}, {1, 0.62f, 0.25f}, 1},
            {"lambert + blinn-phong 250", lambert, sharp, {0.42f, 0.3f, 0.04f}, {1, 0.8f, 0.3f}, 1.5f},
            {"wrap + blinn-phong 40", wrap, medium, {0.13f, 0.33f, 0.06f}, {0.6f, 1, 0.35f}, 1},
            {"oren-nayar + blinn-phong 8", orenNayar, broad, {0.04f, 0.32f, 0.24f}, {0.3f, 1, 0.8f}, 0.25f},
            {"constant + blinn-phong 250", constant, sharp, {0.04f, 0.2f, 0.42f}, {0.35f, 0.7f, 1}, 1.5f},
            {"toon + toon", toon, toon, {0.1f, 0.1f, 0.45f}, {0.5f, 0.55f, 1}, 0.35f},
            {"sampled + sampled", velvet, ring, {0.33f, 0.06f, 0.36f}, {1, 0.5f, 1}, 0.8f}};
}

void addSphere(Scene& scene, uint32_t mesh, int step, int column, Material material) {
    const vec3 centre((float(column) - 0.5f * (kColumns - 1)) * kSpacing, float(step) * kStepHeight + kRadius,
                      -float(step) * kStepDepth);
    const std::string name = material.name;
    addObject(scene, name, mesh, addMaterial(scene, std::move(material)), placed(centre));
}

void addMetallicRoughnessRow(Scene& scene, uint32_t mesh) {
    for (int column = 0; column < kColumns; ++column) {
        const bool metal = column > kColumns / 2;
        const float roughness = metal ? 0.1f + 0.25f * float(column - 4) : 0.1f + 0.25f * float(column);
        addSphere(scene, mesh, 0, column,
                  {.name = fmt::format("metallic {}, roughness {:.2f}", metal ? 1 : 0, roughness),
                   .baseColor = metal ? vec4(0.95f, 0.7f, 0.38f, 1) : vec4(0.3f, 0.33f, 0.38f, 1),
                   .metallic = metal ? 1.0f : 0.0f,
                   .roughness = roughness});
    }
}

void addProceduralRow(Scene& scene, uint32_t mesh) {
    constexpr std::array<float, kColumns> kScales = {2, 4, 8, 16, 1.2f, 2.4f, 4.8f};
    for (int column = 0; column < kColumns; ++column) {
        const bool checker = column < 4;
        addSphere(scene, mesh, 1, column,
                  {.name = fmt::format("{} {:.1f} per metre", checker ? "checker" : "marble", kScales[column]),
                   .surface = checker ? SurfaceShader::checker : SurfaceShader::marble,
                   .baseColor = vec4(0.62f, 0.58f, 0.52f, 1),
                   .metallic = 0,
                   .roughness = 0.25f,
                   .proceduralColor = checker ? vec3(0.05f, 0.09f, 0.14f) : vec3(0.2f, 0.1f, 0.07f),
                   .proceduralScale = kScales[column]});
    }
}

void addFunctionRow(Scene& scene, uint32_t mesh, int step, const FunctionRow& row) {
    for (int column = 0; column < kColumns; ++column) {
        const float blend = float(column) / (kColumns - 1);
        addSphere(scene, mesh, step, column,
                  {.name = fmt::format("{}, blend {:.2f}", row.name, blend),
                   .equation = LightEquation::shaped,
                   .baseColor = vec4(row.color, 1),
                   .shaped = {.diffuseFunction = row.fa,
                              .specularFunction = row.fb,
                              .specularColor = row.highlight,
                              .kd = 1 - 0.6f * blend,
                              .ks = row.ks,
                              .specularBlend = blend,
                              .kAmbient = row.color}});
    }
}

void addStage(Scene& scene, int steps) {
    const uint32_t stone = addMaterial(
        scene, {.name = "terrace", .baseColor = vec4(0.2f, 0.2f, 0.21f, 1), .metallic = 0, .roughness = 0.7f});
    const uint32_t paper = addMaterial(
        scene, {.name = "paper", .baseColor = vec4(0.11f, 0.12f, 0.14f, 1), .metallic = 0, .roughness = 0.9f});
    const float half = 0.5f * kSpacing * kColumns + 0.2f, back = -(float(steps) + 1) * kStepDepth;
    for (int step = 1; step < steps; ++step)
        addObject(scene, fmt::format("step {}", step),
                  addMesh(scene,
                          shapes::box({-half, 0, back},
                                      {half, float(step) * kStepHeight, -(float(step) - 0.5f) * kStepDepth}),
                          fmt::format("step {}", step)),
                  stone);
    // Rises behind the terrace without an edge, as in a photographer's studio.
    const auto backdrop = [=](double u, double v) {
        constexpr double kFront = 14, kWall = -9, kBend = 5, kTop = 16;
        const double x = 60 * (u - 0.5), along = v * (kFront - kWall + kPi / 2 * kBend + kTop);
        if (along < kFront - kWall) return dvec3(x, 0, kFront - along);
        const double angle = std::min((along - (kFront - kWall)) / kBend, kPi / 2);
        const double above = std::max(along - (kFront - kWall) - kPi / 2 * kBend, 0.0);
        return dvec3(x, kBend * (1 - std::cos(angle)) + above, kWall - kBend * std::sin(angle));
    };
    addObject(scene, "backdrop", addMesh(scene, shapes::patch(16, 64, backdrop, {60, 47}), "backdrop"), paper);
}

void addLights(Scene& scene) {
    scene.ambience = {.sky = {0.1f, 0.12f, 0.16f}, .ground = {0.05f, 0.045f, 0.04f}};
    scene.lights = {
        {.name = "key",
         .type = LightType::directional,
         .directionWorld = glm::normalize(vec3(0.55f, -0.75f, -0.6f)),
         .color = {2.1f, 2.02f, 1.9f}},
        {.name = "warm lamp", .positionWorld = {5.5f, 4, 3}, .color = {34, 15, 5}, .range = 16},
        {.name = "cool lamp", .positionWorld = {-6, 6.5f, -2}, .color = {6, 13, 32}, .range = 16},
        {.name = "low lamp", .positionWorld = {-1.5f, 0.9f, 2.6f}, .color = {1.2f, 2.2f, 1.4f}, .range = 6},
        {.name = "top spot",
         .type = LightType::spot,
         .positionWorld = {0.5f, 10, 1},
         .directionWorld = glm::normalize(vec3(0, -0.7f, -0.72f)),
         .color = {60, 55, 60},
         .range = 25,
         .innerConeAngle = 0.1f,
         .outerConeAngle = 0.42f},
    };
}

}  // namespace

Scene makeMaterials() {
    Scene scene;
    const uint32_t sphere = addMesh(scene, shapes::sphere(kRadius, 48, 24), "sphere");
    addMetallicRoughnessRow(scene, sphere);
    addProceduralRow(scene, sphere);
    int step = 2;
    for (const FunctionRow& row : addFunctionRows(scene)) addFunctionRow(scene, sphere, step++, row);
    addStage(scene, step);
    addLights(scene);
    scene.cameras.push_back(
        {.name = "front", .worldFromView = lookAt({0, 5.6f, 9.4f}, {0, 2.45f, -2.4f}), .yFov = 0.62f});
    return scene;
}

}  // namespace luciole
