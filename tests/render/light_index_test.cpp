#include <filesystem>
#include <fstream>
#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>
#include <random>

#include "device.hpp"
#include "gpu/shaders.hpp"
#include "image_difference.hpp"
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
    return {.lighting = "light-indexed",
            .lidrPacking = row.packing,
            .overlap = row.overlap,
            .indices = row.indices,
            .onOverflow = onOverflow};
}

/// The thirteen rows of Table 2.9.1.
const std::vector<Row> kTable = [] {
    std::vector<Row> rows;
    for (const auto& [indices, overlaps] : {std::pair(LidrIndices::n15, std::vector{2u, 4u, 8u, 16u}),
                                            std::pair(LidrIndices::n255, std::vector{1u, 2u, 4u, 8u, 16u}),
                                            std::pair(LidrIndices::n65535, std::vector{1u, 2u, 4u, 8u})})
        for (const uint32_t overlap : overlaps) rows.push_back({LidrPacking::bitShift, overlap, indices});
    return rows;
}();

/// Every packing at every capacity.
std::vector<Row> allRows() {
    std::vector<Row> rows = kTable;
    for (const uint32_t overlap : {2u, 4u})
        for (const auto indices : {LidrIndices::n255, LidrIndices::n65535})
            rows.push_back({LidrPacking::maxBlend, overlap, indices});
    rows.push_back({LidrPacking::maxBlendSorted, 4, LidrIndices::n255});
    for (uint32_t overlap = 1; overlap <= 16; ++overlap)
        rows.push_back({LidrPacking::cpuSort, overlap, overlap % 3 ? LidrIndices::n255 : LidrIndices::n65535});
    rows.push_back({LidrPacking::list, 4, LidrIndices::automatic});
    return rows;
}

std::string nameOf(const Row& row) {
    const RenderSettings settings = settingsOf(row);
    return getSetting(settings, "lidr-packing") + " " + std::to_string(row.overlap) + "x" +
           getSetting(settings, "indices");
}

/// Lights that hit each pixel, whatever they are linked to: as brute force counts them.
std::vector<uint32_t> hitsOf(ValidatedRenderer& renderer, Scene scene, const View& view) {
    for (Light& light : scene.lights) light.linkGroup = kNone;
    const Frame frame = renderer.render(scene, view, {}, {"light-count"});
    return {frame.aovs.at("light-count").data.begin(), frame.aovs.at("light-count").data.end()};
}

}  // namespace

namespace {

/// Scenes of all kinds; those of many materials and no other lights are left out, as each material is a pipeline more.
std::vector<TestScene> sevenScenes() {
    std::vector<TestScene> scenes = testScenes();
    std::erase_if(scenes, [](const TestScene& test) {
        return test.name == "texture corners" || test.name == "builtin:materials";
    });
    REQUIRE(scenes.size() == 7);
    return scenes;
}

/// Sums of n positive terms in any order differ by at most 2 n units of roundoff (2^-24).
double roundoff(const Scene& scene) { return 2.0 * double(scene.lights.size() + 1) * std::exp2(-24); }

}  // namespace

TEST_CASE(
    "light-indexed: on seven scenes each packing by blending equals the loop over all lights at every pixel within "
    "capacity, and pixels over capacity are exactly those reported") {
    ValidatedRenderer renderer;
    std::vector<Row> rows = kTable;
    for (const uint32_t overlap : {2u, 4u})
        for (const auto indices : {LidrIndices::n255, LidrIndices::n65535})
            rows.push_back({LidrPacking::maxBlend, overlap, indices});
    size_t saturated = 0, held = 0;
    for (TestScene& test : sevenScenes())
        for (const bool few : {false, true}) {  // 15 lights, or all of them
            if (few) test.scene.lights.resize(std::min<size_t>(15, test.scene.lights.size()));
            const View view{test.view.camera, {96, 72}};
            const std::vector<uint32_t> hits = hitsOf(renderer, test.scene, view);
            renderer->setScene(test.scene);
            const Frame yardstick = renderer->render(view, {.lighting = "forward-loop"});
            for (const Row& row : rows) {
                if (few != (row.indices == LidrIndices::n15)) continue;
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
                CHECK(difference(frame.radiance, yardstick.radiance, &within).max <= roundoff(test.scene));
                settings.onOverflow = OnOverflow::exact;
                const Frame exact = renderer->render(view, settings);
                CHECK(exact.stats.lightIndex->fellBack == (pixels > 0));
                CHECK(exact.stats.lightIndex->pixelsOver == pixels);
                CHECK(exact.stats.lightIndex->pairsOver == pairs);
                CHECK(difference(exact.radiance, yardstick.radiance).max <= roundoff(test.scene));
                ++(pixels > 0 ? saturated : held);
                if (pixels == 0) continue;
                CHECK(difference(frame.radiance, yardstick.radiance).max > 1e-3);
                settings.onOverflow = OnOverflow::fail;
                CHECK_THROWS_AS(renderer->render(view, settings), Error);
            }
        }
    CHECK(saturated > 20);
    CHECK(held > 20);
}

TEST_CASE(
    "light-indexed: sorted by the host, at every capacity, and in lists no light is lost, and none is evaluated that "
    "does not reach its surface") {
    ValidatedRenderer renderer;
    for (const TestScene& test : sevenScenes()) {
        renderer->setScene(test.scene);
        const View view{test.view.camera, {96, 72}};
        const Frame yardstick = renderer->render(view, {.lighting = "forward-loop"}, kCounts);
        std::vector<Row> rows{{LidrPacking::list, 4, LidrIndices::automatic},
                              {LidrPacking::maxBlendSorted, 4, LidrIndices::n255}};
        for (uint32_t overlap = 1; overlap <= 16; ++overlap)
            if (test.name == "studio" || overlap == 3 ||
                overlap == 16)  // each capacity is a pipeline for each material
                rows.push_back({LidrPacking::cpuSort, overlap, overlap % 3 ? LidrIndices::n255 : LidrIndices::n65535});
        for (const Row& row : rows) {
            INFO("scene " << test.name << ", " << nameOf(row));
            const bool counts = row.packing == LidrPacking::list;
            const Frame frame = renderer->render(view, settingsOf(row), counts ? kCounts : std::vector<std::string>{});
            CHECK(difference(frame.radiance, yardstick.radiance).max <= roundoff(test.scene));
            if (!counts) continue;
            const auto equal = [&](const char* a, const char* b) {
                return frame.aovs.at(a).data == yardstick.aovs.at(b).data;
            };
            CHECK(equal("useful-evaluations", "useful-evaluations"));
            CHECK(equal("light-fingerprint", "light-fingerprint"));
            // Links show only when surfaces are drawn, and surfaces that blend have all lights on the way.
            if (test.scene.linkGroups.empty()) CHECK(equal("evaluations", "useful-evaluations"));
        }
    }
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

TEST_CASE(
    "light-indexed: tables of either kind, types of lights, covers and samples give the picture of the loop over all "
    "lights") {
    ValidatedRenderer renderer;
    for (const TestScene& test : sevenScenes()) {
        if (test.name == "textured floor") continue;  // no links, no spots
        renderer->setScene(test.scene);
        const View view{test.view.camera, {48, 36}};
        for (const auto msaa : {Msaa::x1, Msaa::x4}) {
            const Frame yardstick = renderer->render(view, {.lighting = "forward-loop", .msaa = msaa}, kCounts);
            for (RenderSettings settings : variants()) {
                settings.msaa = msaa;
                INFO("scene " << test.name << ", msaa " << getSetting(settings, "msaa") << ", "
                              << getSetting(settings, "lidr-packing") << " x" << settings.overlap << ", tables "
                              << getSetting(settings, "lidr-tables") << ", types " << getSetting(settings, "lidr-types")
                              << ", cover " << getSetting(settings, "lidr-cover"));
                const Frame frame = renderer->render(view, settings, kCounts);
                CHECK(difference(frame.radiance, yardstick.radiance).max <=
                      2.0 * double(test.scene.lights.size() + 1) * std::exp2(-24));
                CHECK(frame.aovs.at("useful-evaluations").data == yardstick.aovs.at("useful-evaluations").data);
                CHECK(frame.aovs.at("light-fingerprint").data == yardstick.aovs.at("light-fingerprint").data);
            }
        }
    }
}

TEST_CASE(
    "light-indexed: every value passes every target of every packing, and a factor that is a little off is found out") {
    SilentValidation validation;
    const gpu::Context context(validation.options());
    gpu::Pipelines pipelines(context, gpu::shaderCode);
    for (const Row& row : allRows()) {
        if (row.packing == LidrPacking::list) continue;
        INFO(nameOf(row));
        const render::IndexLayout layout = render::indexLayout(settingsOf(row), 1);
        const float shift = render::blendShift(layout.packing);
        CHECK(render::wrongValues(context, pipelines, layout, shift) == 0);
        if (layout.packing.kind == shared::kPackedBits && shift > 0)
            CHECK(render::wrongValues(context, pipelines, layout, shift * 1.04f) > 0);
    }
}

TEST_CASE(
    "light-indexed: the outcome of a self-test is kept for the next start, and a damaged file is as good as none") {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("luciole-self-test-" + std::to_string(std::random_device{}()));
    SilentValidation validation;
    const gpu::Context context(validation.options());
    gpu::Pipelines pipelines(context, gpu::shaderCode);
    const render::IndexLayout layout =
        render::indexLayout(settingsOf({LidrPacking::bitShift, 4, LidrIndices::n255}), 1);
    CHECK(render::LightIndexSelfTest(context, pipelines, folder.string()).of(layout).ms > 0);
    CHECK(render::LightIndexSelfTest(context, pipelines, folder.string()).of(layout).ms == 0);
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        std::ofstream(entry.path()) << "bits\t\n\t\nbits 2 R8G8B8A8Unorm\tnone\n";
    render::LightIndexSelfTest again(context, pipelines, folder.string());
    CHECK(again.of(layout).ms > 0);
    CHECK(again.of(layout).wrong == 0);
    std::filesystem::remove_all(folder);
    CHECK(render::LightIndexSelfTest(context, pipelines, "/dev/null/nowhere").of(layout).wrong == 0);
}

TEST_CASE("light-indexed: the light buffer serves as index image, and what it can't hold is refused by name") {
    ValidatedRenderer renderer;
    for (const TestScene& test : {studio(), testScenes().back()}) {
        renderer->setScene(test.scene);
        const View view{test.view.camera, {96, 72}};
        const Frame yardstick = renderer->render(view, {.lighting = "forward-loop"});
        for (const auto& [overlap, indices] : {std::pair(4u, LidrIndices::n255), std::pair(2u, LidrIndices::n65535)}) {
            RenderSettings settings = settingsOf({LidrPacking::bitShift, overlap, indices});
            settings.lidrShare = true;
            const Frame frame = renderer->render(view, settings);
            CHECK(difference(frame.radiance, yardstick.radiance).max <=
                  2.0 * double(test.scene.lights.size() + 1) * std::exp2(-24));
            settings.onOverflow = OnOverflow::priority;
            CHECK(renderer->render(view, settings).stats.lightIndex->imageBytes == 0);
        }
        RenderSettings eight = settingsOf({LidrPacking::bitShift, 8, LidrIndices::n255});
        eight.lidrShare = true;
        CHECK_THROWS_WITH_AS(renderer->render(view, eight),
                             doctest::Contains("lidr-share: expected a packing of four channels"), Error);
    }
    SilentValidation validation;
    const gpu::Context context(validation.options());
    gpu::Pipelines pipelines(context, gpu::shaderCode);
    for (const auto format : {LightBufferFormat::rgba32f, LightBufferFormat::rgba16f})
        for (const auto& [overlap, indices] :
             {std::pair(8u, LidrIndices::n15), std::pair(4u, LidrIndices::n255), std::pair(2u, LidrIndices::n65535)}) {
            const render::IndexLayout layout = render::indexLayout(
                {.lightBuffer = format, .overlap = overlap, .indices = indices, .lidrShare = true}, 1);
            CHECK(render::wrongValues(context, pipelines, layout, render::blendShift(layout.packing)) == 0);
        }
}

TEST_CASE("light-indexed: an overlap that no packing has is refused with those that there are") {
    ValidatedRenderer renderer;
    renderer->setScene(studio().scene);
    const View view{studio().view.camera, {8, 8}};
    CHECK_THROWS_WITH_AS(renderer->render(view, settingsOf({LidrPacking::bitShift, 3, LidrIndices::n255})),
                         "lidr-packing: expected an overlap and indices out of 2x15 4x15 8x15 16x15 1x255 2x255 4x255 "
                         "8x255 16x255 1x65535 2x65535 4x65535 8x65535, got 3x255",
                         Error);
    CHECK_THROWS_WITH_AS(renderer->render(view, settingsOf({LidrPacking::maxBlend, 3, LidrIndices::automatic})),
                         doctest::Contains("2x255 4x255"), Error);
}

TEST_CASE("light-indexed: bytes of index images and light tables are what the table of the text says") {
    ValidatedRenderer renderer;
    Scene scene;
    addObject(scene, quad(1), lambertMaterial(scene));
    for (int i = 0; i < 15; ++i) scene.lights.push_back(pointLight(vec3(0.1f * float(i), 0, 1), vec3(1), 0.5f));
    renderer->setScene(scene);
    // Channels of 8 bits, by row of Table 2.9.1.
    constexpr uint32_t kBytes[] = {1, 2, 4, 8, 1, 2, 4, 8, 16, 2, 4, 8, 16};
    for (size_t i = 0; i < kTable.size(); ++i) {
        INFO(nameOf(kTable[i]));
        RenderSettings settings = settingsOf(kTable[i], OnOverflow::priority);
        settings.lidrTables = LidrTables::textures;
        const LightIndexStats stats = *renderer->render({frontCamera(), {20, 10}}, settings).stats.lightIndex;
        CHECK(stats.imageBytes == 200 * kBytes[i]);
        CHECK(stats.tableBytes ==
              2 * 256 * 16);  // positions with 1 / range, colours; the text has 8 bits of colour and so 5 KiB
    }
}

TEST_CASE("light-indexed: lists come out alike every time, and grow as they need") {
    ValidatedRenderer renderer;
    Scene scene = studio().scene;
    scene.lights.assign(300, pointLight(vec3(0, 1, 0), vec3(0.1f), 9));
    renderer->setScene(scene);
    const View view{studio().view.camera, {64, 48}};
    const RenderSettings settings = settingsOf({LidrPacking::list, 4, LidrIndices::automatic});
    const Frame first = renderer->render(view, settings);
    CHECK(first.stats.lightIndex->mostAtOnce == 300);
    CHECK(first.stats.lightIndex->listEntries > 64 * 48 * 8);  // more than there is room for at first
    for (int i = 0; i < 3; ++i) CHECK(renderer->render(view, settings).radiance.data == first.radiance.data);
}

TEST_CASE(
    "light-indexed: where there are more lights than indices, the important ones are kept and the others are "
    "reported") {
    ValidatedRenderer renderer;
    Scene scene;
    addObject(scene, quad(1), lambertMaterial(scene));
    for (int i = 0; i < 20; ++i) scene.lights.push_back(pointLight(vec3(0, 0, 1), vec3(1 + float(i)), 4));
    renderer->setScene(scene);
    const Frame frame = renderer->render(
        {frontCamera(), {16, 16}}, settingsOf({LidrPacking::bitShift, 16, LidrIndices::n15}, OnOverflow::priority));
    const LightIndexStats& stats = *frame.stats.lightIndex;
    REQUIRE(stats.lost.size() == 5);
    uint64_t covered = 0;
    for (const float value : frame.radiance.data) covered += value > 0;
    for (uint32_t i = 0; i < 5; ++i) {
        CHECK(stats.lost[i].light == i);  // the weakest
        CHECK(stats.lost[i].pairs == covered / 3);
        CHECK(stats.lost[i].radiance > 0);
    }
    // In front of the light: E / pi with the range window, 1 m away.
    const double radiance = stats.lost[4].radiance / double(stats.lost[4].pairs);
    CHECK(radiance < 5 / kPi);
    CHECK(radiance > 0.3 * 5 / kPi);
}

TEST_CASE("light-indexed: arrays sorted by the host hold no two lights that overlap, or no three") {
    const auto check = [](bool pairsMayOverlap) {
        // A ring of twelve, each overlapping its four nearest, and one light that overlaps all.
        constexpr uint32_t kCount = 13;
        std::vector<std::vector<uint32_t>> overlaps(kCount);
        for (uint32_t i = 0; i < 12; ++i) overlaps[i] = {(i + 1) % 12, (i + 2) % 12, (i + 10) % 12, (i + 11) % 12, 12};
        for (uint32_t i = 0; i < 12; ++i) overlaps[12].push_back(i);
        std::vector<uint32_t> lights(kCount);
        for (uint32_t i = 0; i < kCount; ++i) lights[i] = i;
        const std::vector<uint32_t> arrays = render::sortIntoArrays(lights, overlaps, pairsMayOverlap);
        const auto meet = [&](uint32_t a, uint32_t b) {
            return arrays[a] == arrays[b] && std::ranges::find(overlaps[a], b) != overlaps[a].end();
        };
        size_t pairs = 0, triples = 0;
        for (uint32_t a = 0; a < kCount; ++a)
            for (uint32_t b = a + 1; b < kCount; ++b) {
                pairs += meet(a, b);
                for (uint32_t c = b + 1; c < kCount; ++c) triples += meet(a, b) && meet(b, c) && meet(a, c);
            }
        CHECK(arrays[0] == 0);  // the first light, the most important one, comes first
        CHECK(triples == 0);
        CHECK((pairs > 0) == pairsMayOverlap);
        return 1 + *std::ranges::max_element(arrays);
    };
    CHECK(check(false) == 4);  // the ring takes three
    CHECK(check(true) < 4);
}

TEST_CASE("light-indexed: what fits no array goes to a second round, or is dropped and reported to the pixel") {
    ValidatedRenderer renderer;
    Scene scene;
    addObject(scene, quad(4), lambertMaterial(scene));
    // Two that overlap, the second one weaker, and one apart.
    scene.lights = {pointLight(vec3(-0.2f, 0, 0.3f), vec3(4), 0.6f), pointLight(vec3(0.2f, 0, 0.3f), vec3(2), 0.6f),
                    pointLight(vec3(1.4f, 0, 0.3f), vec3(1), 0.4f)};
    const View view{frontCamera(3), {64, 48}};
    Scene weaker = scene;
    weaker.lights = {scene.lights[1]};
    uint64_t reached = 0;
    for (const uint32_t count : hitsOf(renderer, weaker, view)) reached += count;
    REQUIRE(reached > 0);

    renderer->setScene(scene);
    const Row row{LidrPacking::cpuSort, 1, LidrIndices::n255};
    const Frame yardstick = renderer->render(view, {.lighting = "forward-loop"});
    const Frame exact = renderer->render(view, settingsOf(row));
    CHECK(exact.stats.lightIndex->rounds == 2);
    CHECK(difference(exact.radiance, yardstick.radiance).max <= roundoff(scene));
    const LightIndexStats stats = *renderer->render(view, settingsOf(row, OnOverflow::priority)).stats.lightIndex;
    REQUIRE(stats.lost.size() == 1);
    CHECK(stats.lost[0].light == 1);
    CHECK(stats.lost[0].pairs == reached);
    CHECK(stats.pixelsOver == reached);
    CHECK_THROWS_WITH_AS(renderer->render(view, settingsOf(row, OnOverflow::fail)),
                         doctest::Contains("pairs of a light and a pixel do not fit"), Error);
}
