#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>

#include "device.hpp"
#include "image_difference.hpp"
#include "render/lighting/light_index_plan.hpp"
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

TEST_CASE("light-indexed: every packing at every capacity equals the loop over all lights, on six scenes") {
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
            const Frame frame = renderer->render(view, settingsOf(row, OnOverflow::priority));
            const LightIndexStats& stats = *frame.stats.lightIndex;
            CHECK(stats.pixelsOver == pixels);
            CHECK(stats.pairsOver == pairs);
            CHECK(difference(frame.radiance, yardstick.radiance, &within).max <= 2.0 * double(test.scene.lights.size() + 1) * std::exp2(-24));
            if (pixels > 0) {
                ++saturated;
                CHECK(difference(frame.radiance, yardstick.radiance).max > 1e-3);
                const Frame exact = renderer->render(view, settingsOf(row));
                CHECK(exact.stats.lightIndex->fellBack);
                CHECK(exact.stats.lightIndex->pixelsOver == pixels);
                CHECK(exact.stats.lightIndex->pairsOver == pairs);
                CHECK_THROWS_AS(renderer->render(view, settingsOf(row, OnOverflow::fail)), Error);
            }
        }
    }
    CHECK(saturated > 20);
}
