#include <luciole/error.hpp>
#include <luciole/reference.hpp>
#include <luciole/scene_io.hpp>

#include "device.hpp"
#include "render/lighting/techniques.hpp"
#include "image_difference.hpp"
#include "output/request.hpp"
#include "scene_building.hpp"
#include "scenes.hpp"
#include "support.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

const std::vector<std::string> kMaskLayers{"id", "material", "depth"};

/// Bounds on the relative error (relativeError in metrics.hpp) over pixels away from edges.
struct Tolerance {
    double mean, p999;
};

/// compact stores colours as squares of 8 bits: a relative step of 2 * (0.5 / 255) / sqrt(Cs) each, 2 % at Cs = 0.04.
/// calver stores depth in 16 bits: lights close to a surface far from the near plane move (docs/gbuffer.md).
/// float stores position in 11 significant bits: 0.05 % of the distance.
Tolerance toleranceOf(GBufferLayout layout, bool textured) {
    Tolerance tolerance{};
    switch (layout) {
        case GBufferLayout::calver: tolerance = {0.01, 0.25}; break;
        case GBufferLayout::floatPosition: tolerance = {0.01, 0.10}; break;
        case GBufferLayout::compact: tolerance = {0.015, 0.03}; break;
    }
    // A driver may choose the mip level by an approximation of the gradient's length (Vulkan 1.3, "Scale Factor
    // Operation"): up to half a level off, and a normal off by that much moves a highlight.
    if (textured) tolerance.mean += 0.03, tolerance.p999 += 0.3;
    return tolerance;
}

void checkAgainstReference(ValidatedRenderer& renderer, const TestScene& test, std::initializer_list<GBufferLayout> layouts) {
    INFO("scene: " << test.name);
    std::vector<std::string> layers = kMaskLayers;
    layers.emplace_back("light-fingerprint");
    const Frame reference = renderReference(test.scene, test.view, {}, layers);
    const auto mask = interior(reference, test.hardLights ? &reference.aovs.at("light-fingerprint") : nullptr);
    for (const auto layout : layouts) {
        INFO("layout: " << int(layout));
        const Tolerance tolerance = toleranceOf(layout, test.textured);
        renderer->setScene(test.scene);
        for (const auto& technique : render::techniques()) {
            if (technique.forward && layout != GBufferLayout::compact) continue;  // they have no layout
            INFO("technique: " << technique.info.name);
            const RenderSettings settings{.lighting = std::string(technique.info.name), .gbuffer = layout};
            const ErrorSummary radiance = difference(renderer->render(test.view, settings).radiance, reference.radiance, &mask);
            INFO("mean " << radiance.mean << ", 99.9 % " << radiance.p999 << ", max " << radiance.max << ", compared " << radiance.share);
            CHECK(radiance.share > 0.03);
            CHECK(radiance.mean < tolerance.mean);
            CHECK(radiance.p999 < tolerance.p999);
        }
        const Frame frame = renderer->render(test.view, {.gbuffer = layout}, kMaskLayers);
        size_t wrong = 0;
        for (size_t i = 0; i < mask.size(); ++i)
            if (mask[i]) wrong += frame.aovs.at("id").data[i] != reference.aovs.at("id").data[i];
        // A sliver's tip may cover a pixel's centre for the one and not for the other.
        CHECK(double(wrong) <= 2e-4 * double(mask.size()));
    }
}

}  // namespace

TEST_CASE("lighting: every technique matches the reference in every G-buffer layout, on scenes that use everything") {
    ValidatedRenderer renderer;
    for (const TestScene& test : testScenes())
        checkAgainstReference(renderer, test, {GBufferLayout::calver, GBufferLayout::floatPosition, GBufferLayout::compact});
}

TEST_CASE("lighting: every technique matches the reference on real assets") {
    LUCIOLE_ASSETS_OR_SKIP(folder);
    const std::filesystem::path rigs = std::filesystem::path(LUCIOLE_SOURCE_DIR) / "examples" / "rigs";
    struct Asset {
        const char *file, *rig;
    };
    ValidatedRenderer renderer;
    for (const Asset& asset : {Asset{"DamagedHelmet/DamagedHelmet.glb", "helmet.json"},
                               Asset{"LightsPunctualLamp/LightsPunctualLamp.gltf", "lamp.json"},
                               Asset{"Sponza/Sponza.gltf", "sponza.json"},
                               Asset{"CastlePunctualLights/test_lights.glb", nullptr},
                               Asset{"bench/hall-255-o4.glb", nullptr}}) {
        Scene scene = loadScene((folder / asset.file).string());
        if (asset.rig) applyRig(scene, rigs / asset.rig);
        REQUIRE(!scene.lights.empty());
        const Camera camera = scene.cameras.empty() ? autoCamera(scene) : scene.cameras.back();
        // Not calver: its 16 bits of depth depend on the camera's near plane, and these cameras were not made for it.
        checkAgainstReference(renderer, {asset.file, std::move(scene), {camera, {192, 144}}, true},
                              {GBufferLayout::floatPosition, GBufferLayout::compact});
    }
}

TEST_CASE("additional layers: equal the reference's where a ray and a rasterizer see the same surface") {
    ValidatedRenderer renderer;
    const TestScene test = studio();
    std::vector<std::string> layers = aovNames();
    std::erase_if(layers, isListLayer);  // of the device alone
    const Frame reference = renderReference(test.scene, test.view, {}, layers);
    const auto mask = interior(reference);
    // Half a step of each layout: depth by 16 bits of near / z at 10 m, half floats, 32-bit floats; colours by 16 bits, or
    // by 8 bits of their square root at 0.2.
    struct Layout {
        GBufferLayout layout;
        double depth, color;
    };
    for (const auto& [layout, depth, color] : {Layout{GBufferLayout::calver, 2e-3, 2e-4}, Layout{GBufferLayout::floatPosition, 1e-3, 2e-4},
                                               Layout{GBufferLayout::compact, 1e-5, 0.02}}) {
        INFO("layout: " << int(layout));
        const Frame frame = renderer.render(test.scene, test.view, {.gbuffer = layout}, layers);
        const auto compared = [&](const char* name) { return difference(frame.aovs.at(name), reference.aovs.at(name), &mask); };
        CHECK(compared("material").max == 0);
        CHECK(compared("id").max == 0);
        CHECK(compared("depth").max < depth);
        CHECK(compared("cs0").max < color);
        CHECK(compared("cs1").max < color);
        if (layout == GBufferLayout::compact) CHECK(compared("light-count").p999 == 0);  // a pixel on a range's very edge may differ
        double normalError = 0;
        for (size_t i = 0; i < mask.size(); ++i) {
            if (!mask[i]) continue;
            const float* a = &frame.aovs.at("normal").data[3 * i];
            const float* b = &reference.aovs.at("normal").data[3 * i];
            normalError = std::max(normalError, glm::length(dvec3(a[0] - b[0], a[1] - b[1], a[2] - b[2])));
        }
        CHECK(normalError < 1e-4);  // octahedral, 16 bits: 2.4e-5 a coordinate at most
    }
}

TEST_CASE("assets: every one that loads renders, finite and not black, under validation") {
    LUCIOLE_ASSETS_OR_SKIP(folder);
    ValidatedRenderer renderer;
    size_t rendered = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const auto& path = entry.path();
        if ((path.extension() != ".glb" && path.extension() != ".gltf") || path.parent_path().filename() == "bad") continue;
        INFO("asset: " << path.filename().string());
        Scene scene;
        try {
            scene = loadScene(path.string());
        } catch (const Error& error) {
            CHECK(std::string(error.what()).find("extensionsRequired") != std::string::npos);
            continue;
        }
        if (scene.lights.empty()) scene.lights.push_back(directionalLight(vec3(0.3f, -0.5f, -1), vec3(3)));
        const Frame frame = renderer.render(scene, {autoCamera(scene), {32, 24}}, {});
        CHECK(std::ranges::all_of(frame.radiance.data, [](float value) { return std::isfinite(value); }));
        CHECK(std::ranges::any_of(frame.radiance.data, [](float value) { return value > 0; }));
        ++rendered;
    }
    CHECK(rendered >= 35);
}

TEST_CASE("display: the device's tone mapping equals the CPU's") {
    ValidatedRenderer renderer;
    const TestScene test = studio();
    for (const auto toneMap : {ToneMap::none, ToneMap::reinhard, ToneMap::aces, ToneMap::agx}) {
        const RenderSettings settings{.exposureEv = 0.5f, .toneMap = toneMap};
        const Frame reference = renderReference(test.scene, test.view, settings, kMaskLayers);
        const Frame frame = renderer.render(test.scene, test.view, settings);
        const auto mask = interior(reference);
        CHECK(difference(frame.display, reference.display, &mask).mean < 0.01);
    }
}
