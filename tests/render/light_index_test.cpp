#include <filesystem>
#include <fstream>
#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>
#include <random>

#include "device.hpp"
#include "image_difference.hpp"
#include "gpu/shaders.hpp"
#include "render/lighting/light_index_self_test.hpp"
#include "scene_building.hpp"
#include "scenes.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

const std::vector<std::string> kCounts{"evaluations", "useful-evaluations", "light-fingerprint"};

struct Row {
    LidrPacking packing;
    uint32_t overlap;
    LidrIndices indices;
};

RenderSettings settingsOf(const Row& row, OnOverflow onOverflow = OnOverflow::exact) {
    return {.lighting = "light-indexed", .lidrPacking = row.packing, .overlap = row.overlap, .indices = row.indices, .onOverflow = onOverflow};
}

/// The thirteen rows of Table 2.9.1.
const std::vector<Row> kTable = [] {
    std::vector<Row> rows;
    for (const auto& [indices, overlaps] : {std::pair(LidrIndices::n15, std::vector{2u, 4u, 8u, 16u}), std::pair(LidrIndices::n255, std::vector{1u, 2u, 4u, 8u, 16u}),
                                            std::pair(LidrIndices::n65535, std::vector{1u, 2u, 4u, 8u})})
        for (const uint32_t overlap : overlaps) rows.push_back({LidrPacking::bitShift, overlap, indices});
    return rows;
}();

/// Every packing at every capacity.
std::vector<Row> allRows() {
    std::vector<Row> rows = kTable;
    for (const uint32_t overlap : {2u, 4u})
        for (const auto indices : {LidrIndices::n255, LidrIndices::n65535}) rows.push_back({LidrPacking::maxBlend, overlap, indices});
    rows.push_back({LidrPacking::maxBlendSorted, 4, LidrIndices::n255});
    for (uint32_t overlap = 1; overlap <= 16; ++overlap) rows.push_back({LidrPacking::cpuSort, overlap, overlap % 3 ? LidrIndices::n255 : LidrIndices::n65535});
    rows.push_back({LidrPacking::list, 4, LidrIndices::automatic});
    return rows;
}

std::string nameOf(const Row& row) {
    const RenderSettings settings = settingsOf(row);
    return getSetting(settings, "lidr-packing") + " " + std::to_string(row.overlap) + "x" + getSetting(settings, "indices");
}

/// Lights that hit each pixel, whatever they are linked to: as brute force counts them.
std::vector<uint32_t> hitsOf(ValidatedRenderer& renderer, Scene scene, const View& view) {
    for (Light& light : scene.lights) light.linkGroup = kNone;
    const Frame frame = renderer.render(scene, view, {}, {"light-count"});
    return {frame.aovs.at("light-count").data.begin(), frame.aovs.at("light-count").data.end()};
}

}  // namespace

TEST_CASE("light-indexed: every packing at every capacity equals the loop over all lights, on seven scenes") {
    ValidatedRenderer renderer;
    const auto scenes = testScenes();
    REQUIRE(scenes.size() >= 8);
    for (const TestScene& test : scenes) {
        if (test.name == "texture corners" || test.name == "builtin:materials") continue;  // many pipelines, no other lights
        renderer->setScene(test.scene);
        const View view{test.view.camera, {96, 72}};
        const Frame yardstick = renderer->render(view, {.lighting = "forward-loop"}, kCounts);
        for (const Row& row : allRows()) {
            INFO("scene " << test.name << ", " << nameOf(row));
            const Frame frame = renderer->render(view, settingsOf(row), kCounts);
            // Sums of n positive terms in any order differ by at most 2 n units of roundoff (2^-24).
            CHECK(difference(frame.radiance, yardstick.radiance).max <= 2.0 * double(test.scene.lights.size() + 1) * std::exp2(-24));
            CHECK(frame.aovs.at("useful-evaluations").data == yardstick.aovs.at("useful-evaluations").data);
            CHECK(frame.aovs.at("light-fingerprint").data == yardstick.aovs.at("light-fingerprint").data);
        }
    }
}

TEST_CASE("light-indexed: pixels over capacity are exactly those reported, and all others are right") {
    ValidatedRenderer renderer;
    size_t saturated = 0;
    for (const TestScene& test : testScenes()) {
        if (test.name == "texture corners" || test.name == "builtin:materials") continue;
        const View view{test.view.camera, {96, 72}};
        const std::vector<uint32_t> hits = hitsOf(renderer, test.scene, view);
        renderer->setScene(test.scene);
        const Frame yardstick = renderer->render(view, {.lighting = "forward-loop"});
        for (const Row& row : kTable) {
            if (row.indices == LidrIndices::n15 && test.scene.lights.size() > 15) continue;
            INFO("scene " << test.name << ", " << nameOf(row));
            uint64_t pixels = 0, pairs = 0;
            std::vector<bool> within;
            for (const uint32_t count : hits) {
                within.push_back(count <= row.overlap);
                pixels += count > row.overlap;
                pairs += count > row.overlap ? count - row.overlap : 0;
            }
            RenderSettings settings = settingsOf(row, OnOverflow::priority);
            settings.lidrCover = LidrCover::surface;  // what brute force counts
            const Frame frame = renderer->render(view, settings);
            const LightIndexStats& stats = *frame.stats.lightIndex;
            CHECK(stats.pixelsOver == pixels);
            CHECK(stats.pairsOver == pairs);
            CHECK(difference(frame.radiance, yardstick.radiance, &within).max <= 2.0 * double(test.scene.lights.size() + 1) * std::exp2(-24));
            if (pixels > 0) {
                ++saturated;
                CHECK(difference(frame.radiance, yardstick.radiance).max > 1e-3);
                settings.onOverflow = OnOverflow::exact;
                const Frame exact = renderer->render(view, settings);
                CHECK(exact.stats.lightIndex->fellBack);
                CHECK(exact.stats.lightIndex->pixelsOver == pixels);
                CHECK(exact.stats.lightIndex->pairsOver == pairs);
                settings.onOverflow = OnOverflow::fail;
                CHECK_THROWS_AS(renderer->render(view, settings), Error);
            }
        }
    }
    CHECK(saturated > 20);
}

namespace {

/// The settings beside the packing, each way at least once, and in company.
std::vector<RenderSettings> variants() {
    std::vector<RenderSettings> settingsList;
    const auto add = [&](LidrPacking packing, uint32_t overlap, LidrTables tables, LidrTypes types, LidrCover cover) {
        RenderSettings settings = settingsOf({packing, overlap, LidrIndices::automatic});
        settings.lidrTables = tables;
        settings.lidrTypes = types;
        settings.lidrCover = cover;
        settingsList.push_back(settings);
    };
    using enum LidrPacking;
    for (const auto types : {LidrTypes::flag, LidrTypes::one, LidrTypes::targets}) {
        add(bitShift, 8, LidrTables::textures, types, LidrCover::surface);
        add(cpuSort, 6, LidrTables::buffers, types, LidrCover::frontFaces);
    }
    add(bitShift, 16, LidrTables::textures, LidrTypes::targets, LidrCover::frontFaces);
    add(maxBlend, 4, LidrTables::textures, LidrTypes::flag, LidrCover::frontFaces);
    add(maxBlendSorted, 4, LidrTables::textures, LidrTypes::one, LidrCover::surface);
    add(list, 4, LidrTables::buffers, LidrTypes::one, LidrCover::frontFaces);
    return settingsList;
}

}  // namespace

TEST_CASE("light-indexed: tables of either kind, types of lights, covers and samples give the picture of the loop over all lights") {
    ValidatedRenderer renderer;
    for (const TestScene& test : testScenes()) {
        if (test.name == "texture corners" || test.name == "builtin:materials") continue;
        renderer->setScene(test.scene);
        const View view{test.view.camera, {48, 36}};
        for (const auto msaa : {Msaa::x1, Msaa::x4}) {
            const Frame yardstick = renderer->render(view, {.lighting = "forward-loop", .msaa = msaa}, kCounts);
            for (RenderSettings settings : variants()) {
                settings.msaa = msaa;
                INFO("scene " << test.name << ", msaa " << getSetting(settings, "msaa") << ", " << getSetting(settings, "lidr-packing") << " x" << settings.overlap
                              << ", tables " << getSetting(settings, "lidr-tables") << ", types " << getSetting(settings, "lidr-types") << ", cover "
                              << getSetting(settings, "lidr-cover"));
                const Frame frame = renderer->render(view, settings, kCounts);
                CHECK(difference(frame.radiance, yardstick.radiance).max <= 2.0 * double(test.scene.lights.size() + 1) * std::exp2(-24));
                CHECK(frame.aovs.at("useful-evaluations").data == yardstick.aovs.at("useful-evaluations").data);
                CHECK(frame.aovs.at("light-fingerprint").data == yardstick.aovs.at("light-fingerprint").data);
            }
        }
    }
}

TEST_CASE("light-indexed: every value passes every target of every packing, and a factor that is a little off is found out") {
    SilentValidation validation;
    const gpu::Context context(validation.options());
    gpu::Pipelines pipelines(context, gpu::shaderCode);
    for (const Row& row : allRows()) {
        if (row.packing == LidrPacking::list) continue;
        INFO(nameOf(row));
        const render::IndexLayout layout = render::indexLayout(settingsOf(row), 1);
        const float shift = render::blendShift(layout.packing);
        CHECK(render::wrongValues(context, pipelines, layout, shift) == 0);
        if (layout.packing.kind == shared::kPackedBits && shift > 0) CHECK(render::wrongValues(context, pipelines, layout, shift * 1.04f) > 0);
    }
}

TEST_CASE("light-indexed: the outcome of a self-test is kept for the next start, and a damaged file is as good as none") {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("luciole-self-test-" + std::to_string(std::random_device{}()));
    SilentValidation validation;
    const gpu::Context context(validation.options());
    gpu::Pipelines pipelines(context, gpu::shaderCode);
    const render::IndexLayout layout = render::indexLayout(settingsOf({LidrPacking::bitShift, 4, LidrIndices::n255}), 1);
    CHECK(render::LightIndexSelfTest(context, pipelines, folder.string()).of(layout).ms > 0);
    CHECK(render::LightIndexSelfTest(context, pipelines, folder.string()).of(layout).ms == 0);
    for (const auto& entry : std::filesystem::directory_iterator(folder)) std::ofstream(entry.path()) << "bits\t\n\t\nbits 2 R8G8B8A8Unorm\tnone\n";
    render::LightIndexSelfTest again(context, pipelines, folder.string());
    CHECK(again.of(layout).ms > 0);
    CHECK(again.of(layout).wrong == 0);
    std::filesystem::remove_all(folder);
    CHECK(render::LightIndexSelfTest(context, pipelines, "/dev/null/nowhere").of(layout).wrong == 0);
}
