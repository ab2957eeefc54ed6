#include "render/advice/calibration.hpp"

#include <fmt/format.h>

#include <luciole/scene_io.hpp>
#include <optional>

namespace luciole::render {
namespace {

/// One picture. Lights, unless they fit into a uniform buffer, are so many more.
struct Row {
    uint32_t lights;
    double overlap;
    uint32_t triangles;
    uvec2 extent;
    bool blended = false;
    bool outside = false;
};

// Fixed costs from small pictures, those of pixels from larger ones, and each count both small and large beside the others. All have points and
// spots among their lights, so that all pictures run the same shaders.
const std::vector<Row> kFewLights = {
    {6, 1, 2'000, {64, 48}},       {6, 1, 40'000, {64, 48}},         {6, 1, 2'000, {320, 240}},         {16, 1, 40'000, {320, 240}},
    {64, 16, 2'000, {192, 144}},   {255, 1, 2'000, {160, 120}},      {255, 4, 10'000, {160, 120}},      {255, 16, 2'000, {128, 96}},
    {16, 1, 2'000, {256, 192}, true}, {128, 8, 4'000, {128, 96}, true}, {64, 1, 20'000, {64, 48}, true},
    {16, 2, 2'000, {256, 192}, false, true},
};
const std::vector<Row> kManyLights = {
    {1200, 1, 2'000, {64, 48}},     {1200, 1, 40'000, {64, 48}},      {1200, 1, 2'000, {192, 144}},      {1200, 1, 40'000, {160, 120}},
    {1200, 16, 2'000, {128, 96}},   {2048, 1, 2'000, {96, 72}},       {4096, 4, 10'000, {64, 48}},       {2048, 16, 2'000, {64, 48}},
    {1200, 1, 2'000, {96, 72}, true}, {1200, 8, 4'000, {64, 48}, true}, {1200, 1, 20'000, {48, 36}, true}, {16384, 4, 2'000, {128, 96}},
    {1200, 2, 2'000, {128, 96}, false, true},
};

/// The scene with materials of these equations only, and of each of them.
void useEquations(Scene& scene, uint32_t equations) {
    if (equations == 0) return;
    const auto uses = [&](LightEquation equation) { return (equations >> uint32_t(equation) & 1) != 0; };
    const std::vector<LightEquation> all{LightEquation::metallicRoughness, LightEquation::shaped, LightEquation::unlit};
    for (Material& material : scene.materials) {
        if (uses(material.equation)) continue;
        for (const LightEquation equation : all)
            if (uses(equation)) {
                material.equation = equation;
                break;
            }
        material.metallic = 0;
        material.roughness = 0.6f;
    }
    // Shaders are made for the equations of all materials, whether or not an object has them.
    for (const LightEquation equation : all)
        if (uses(equation)) scene.materials.push_back({.equation = equation});
}

}  // namespace

std::string CostVariant::key() const {
    std::string key = fmt::format("equations={} lights={}", equations, uniformLights ? "uniform" : "table");
    RenderSettings plain = settings;
    plain.lighting = RenderSettings{}.lighting;
    for (const Setting& setting : settingsTable())
        if (setting.get(plain) != setting.get(RenderSettings{})) key += fmt::format(" {}={}", setting.name, setting.get(plain));
    return key;
}

std::vector<CalibrationView> calibrationViews(const CostVariant& variant) {
    std::vector<CalibrationView> views;
    for (const Row& row : variant.uniformLights ? kFewLights : kManyLights) {
        Scene scene = loadScene(fmt::format("builtin:hall?lights={}&overlap={}&triangles={}&seed=1", row.lights, row.overlap, row.triangles));
        if (row.blended)
            for (size_t i = 0; i < scene.materials.size(); i += 2) {
                scene.materials[i].alphaMode = AlphaMode::blend;
                scene.materials[i].baseColor.a = 0.5f;
            }
        useEquations(scene, variant.equations);
        View view{row.outside ? autoCamera(scene) : scene.cameras.at(0), row.extent};
        views.push_back({std::move(scene), std::move(view)});
    }
    return views;
}

}  // namespace luciole::render
