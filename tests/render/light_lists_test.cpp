#include "render/lighting/light_lists.hpp"

#include <bit>
#include <glm/gtc/packing.hpp>
#include <luciole/error.hpp>
#include <luciole/reference.hpp>
#include <luciole/scene_io.hpp>

#include "device.hpp"
#include "gpu/shaders.hpp"
#include "image_difference.hpp"
#include "random_scenes.hpp"
#include "reference/volume.hpp"
#include "render/lighting/light_lists.shared.h"

using namespace luciole;
using namespace luciole::test;
using frame::Access;
using frame::BufferId;
using render::ListsOf;

namespace {

/// The lists of one page of the table of lights.
struct Page {
    uint32_t parts;
    std::vector<uint32_t> offsets, entries;
    std::span<const uint32_t> list(size_t i) const {
        return std::span(entries).subspan(offsets[i * parts], offsets[(i + 1) * parts] - offsets[i * parts]);
    }
    bool operator==(const Page&) const = default;
};

/// What a frame made, and the depths that it made it from.
struct Lists {
    bool clustered;
    uint32_t tileSize;
    uvec2 extent;
    std::vector<shared::Tile> tiles;
    std::vector<uint32_t> firstClusters;
    std::vector<Page> pages;
    std::vector<float> depth;
    LightListStats stats;
    uint32_t attempts = 0;

    size_t count() const { return clustered ? firstClusters[tiles.size()] : tiles.size(); }
    float depthAt(uvec2 pixel) const { return depth[pixel.y * extent.x + pixel.x]; }
    std::vector<uint32_t> list(size_t i) const {
        std::vector<uint32_t> all;
        for (const Page& page : pages) all.insert(all.end(), page.list(i).begin(), page.list(i).end());
        return all;
    }
    /// Of a pixel that holds a surface.
    size_t listOf(uvec2 pixel, bool orthographic) const {
        const uvec2 at = pixel / tileSize;
        const size_t tile = at.y * ((extent.x + tileSize - 1) / tileSize) + at.x;
        if (!clustered) return tile;
        // 4 slices an octave, as a float's bits tell; of an orthographic view's linear depth 31.
        const auto from0 = [&](float d) { return orthographic ? uint32_t(d * 31) : std::bit_cast<uint32_t>(d) >> 21; };
        const uint32_t slice = std::min(from0(depthAt(pixel)) - from0(tiles[tile].farthest), 31u);
        REQUIRE((tiles[tile].slices >> slice & 1) == 1);
        return firstClusters[tile] + uint32_t(std::popcount(tiles[tile].slices & ((1u << slice) - 1)));
    }
};

/// How lists are asked for.
struct Wanted {
    ListsOf which = ListsOf::clusters;
    TileSize tileSize = TileSize::n16;
    uint64_t largestBuffer = 1ull << 27;
    uint64_t entries = 0;  ///< that there is room for at first; 0: as usual
    bool operator==(const Wanted&) const = default;
};

/// Makes lists by the passes of a frame that draws depth and nothing else, and reads them back.
class ListMaker {
public:
    void setScene(const Scene& scene) {
        frame_.reset();
        scene_ = std::make_unique<render::GpuScene>(context_, pipelines_, scene);
    }
    const render::GpuScene& scene() const { return *scene_; }

    /// \param layout of the G-buffer that the lists are for
    Lists lists(const View& view, const Wanted& wanted, GBufferLayout layout = GBufferLayout::compact) {
        scene_->setView(view, {}, layout);
        FrameStats stats;
        uint32_t attempts = 0;
        if (!frame_ || frame_->extent != view.extent || frame_->wanted != wanted) build(view.extent, wanted, {.entries = wanted.entries});
        for (std::optional<render::LightingAttempt> again{std::in_place}; again; ++attempts) {
            frame_->executor.run(scene_->frameSet(), false);
            again = frame_->report.judge(read<uint32_t>(*frame_->report.counters), stats);
            if (again) build(view.extent, wanted, *again);
        }
        Lists result{.clustered = frame_->lists.clustered, .tileSize = frame_->lists.tileSize, .extent = view.extent, .tiles = read<shared::Tile>(frame_->lists.tiles),
                     .depth = read<float>(frame_->depth), .stats = *stats.lightLists, .attempts = attempts};
        if (result.clustered) result.firstClusters = read<uint32_t>(frame_->lists.firstClusters);
        for (const render::LightLists& page : frame_->pages) {
            result.pages.push_back({page.parts, read<uint32_t>(page.offsets), read<uint32_t>(page.entries)});
            Page& read = result.pages.back();
            read.offsets.resize(result.count() * page.parts + 1);
            REQUIRE(read.offsets.back() <= read.entries.size());
            read.entries.resize(read.offsets.back());
        }
        return result;
    }

    /// What is said of a frame that had counted so. \return the next attempt, and the statistics
    std::pair<std::optional<render::LightingAttempt>, FrameStats> judge(std::span<const uint32_t> counters) const {
        FrameStats stats;
        std::optional<render::LightingAttempt> again = frame_->report.judge(counters, stats);
        return {again, stats};
    }

private:
    struct Built {
        uvec2 extent;
        Wanted wanted;
        BufferId depth;
        render::LightLists lists;
        std::vector<render::LightLists> pages;
        render::LightingReport report;
        frame::Executor executor;
    };

    template <typename T>
    std::vector<T> read(BufferId buffer) const {
        const std::span<const T> span = frame_->executor.read<T>(buffer);
        return {span.begin(), span.end()};
    }

    void build(uvec2 size, const Wanted& wanted, const render::LightingAttempt& attempt) {
        frame_.reset();
        const vk::Extent2D extent{size.x, size.y};
        frame::FrameGraph graph;
        const render::GBuffer noGBuffer;
        const frame::ImageId depth = graph.createImage("depth", {vk::Format::eD32Sfloat, extent});
        graph.addPass("depth").clear(depth, Access::depthWrite, vk::ClearDepthStencilValue{0.0f, 0}).record([&scene = *scene_](frame::PassContext& pass) {
            pass.depth(vk::CompareOp::eGreaterOrEqual, true);
            scene.drawDepth(pass);
        });
        const BufferId depths = graph.createBuffer("depths", size.x * size.y * 4ull);
        graph.addPass("read depth").read(depth, Access::transferRead).write(depths, Access::transferWrite).record([=](frame::PassContext& pass) {
            pass.commands.copyImageToBuffer(pass.image(depth), vk::ImageLayout::eTransferSrcOptimal, pass.buffer(depths),
                                            vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eDepth, 0, 0, 1}, .imageExtent = {extent.width, extent.height, 1}});
        });
        graph.output(depths);
        render::LightingReport report;
        const render::LightingInputs in{.gbuffer = noGBuffer,
                                        .scene = *scene_,
                                        .constants = {uint32_t(GBufferLayout::compact), scene_->equations(), scene_->lightFeatures()},
                                        .lights = graph.importBuffer("lights", scene_->lightTableBytes(), scene_->lightTable()),
                                        .depth = depth,
                                        .settings = {.lighting = "lists", .tileSize = wanted.tileSize},
                                        .attempt = attempt,
                                        .largestBuffer = wanted.largestBuffer,
                                        .report = &report};
        std::vector<render::LightLists> pages;
        render::addLightLists(graph, in, wanted.which, [&](const render::LightLists& lists, bool first, bool) {
            if (first) graph.output(lists.tiles);
            if (first && lists.clustered) graph.output(lists.firstClusters);
            graph.output(lists.offsets);
            graph.output(lists.entries);
            for (const BufferId buffer : {lists.offsets, lists.entries}) CHECK(graph.resources()[buffer.index].bytes() <= wanted.largestBuffer);
            pages.push_back(lists);
        });
        frame_.reset(new Built{size, wanted, depths, pages.front(), pages, report, frame::Executor(context_, pipelines_, std::move(graph))});
    }

    SilentValidation validation_;  // outlives the context that reports to it
    gpu::Context context_{validation_.options()};
    gpu::Pipelines pipelines_{context_, gpu::shaderCode};
    std::unique_ptr<render::GpuScene> scene_;
    std::unique_ptr<Built> frame_;
};

/// Where a surface is whose depth the rasterizer found at the centre of a pixel (docs/conventions.md, "Spaces").
dvec3 positionOf(const View& view, dvec2 at, double depth) {
    const Camera& camera = view.camera;
    const double z = camera.orthographic ? camera.zFar - depth * (double(camera.zFar) - camera.zNear) : camera.zNear / depth;
    const double half = camera.orthographic ? camera.halfHeight : z * std::tan(0.5 * camera.yFov);
    const dvec2 ndc = 2.0 * at / dvec2(view.extent) - 1.0;
    return {ndc.x * half * view.extent.x / view.extent.y, -ndc.y * half, -z};
}

/// Where the G-buffer says it is (docs/gbuffer.md).
dvec3 storedPosition(const View& view, uvec2 pixel, double depth, GBufferLayout layout) {
    const dvec2 at = dvec2(pixel) + 0.5;
    const auto by16Bits = [](double value) { return std::round(value * 65535) / 65535; };
    if (layout == GBufferLayout::calver) {
        const dvec2 stored(by16Bits(at.x / view.extent.x), by16Bits(at.y / view.extent.y));
        return positionOf(view, stored * dvec2(view.extent), by16Bits(std::max(depth, 1 / 65535.0)));
    }
    dvec3 position = positionOf(view, at, depth);
    if (layout == GBufferLayout::floatPosition)
        for (int i = 0; i < 3; ++i) position[i] = glm::unpackHalf1x16(glm::packHalf1x16(float(position[i])));
    return position;
}

/// Whether a light's range, cone and volume hold a point, in double precision.
bool holds(const Light& light, const std::vector<reference::Volume>& volumes, dvec3 positionWorld) {
    if (light.type != LightType::directional) {
        const dvec3 away = positionWorld - dvec3(light.positionWorld);
        const double distance = length(away);
        if (distance >= light.range) return false;
        if (light.type == LightType::spot && dot(away, normalize(dvec3(light.directionWorld))) <= std::cos(double(light.outerConeAngle)) * distance) return false;
    }
    return light.volume == kNone || volumes[light.volume].contains(positionWorld);
}

/// By list, and by the lights' places in the table: those that hold the surface of one of its pixels, as rasterized or as stored.
std::vector<std::vector<bool>> needed(const Lists& lists, const Scene& scene, const render::GpuScene& gpuScene, const View& view, GBufferLayout layout) {
    const std::vector<reference::Volume> volumes = reference::volumesOf(scene);
    const auto& table = gpuScene.lights().sources;
    std::vector<std::vector<bool>> result(lists.count(), std::vector<bool>(table.size()));
    const dmat4 worldFromView(view.camera.worldFromView);
    struct Point {
        size_t list;
        dvec3 world;
    };
    std::vector<Point> points;
    dvec3 low(INFINITY), high(-INFINITY);
    for (uint32_t y = 0; y < view.extent.y; ++y)
        for (uint32_t x = 0; x < view.extent.x; ++x) {
            const float depth = lists.depthAt({x, y});
            if (depth <= 0) continue;
            for (const dvec3 place : {positionOf(view, dvec2(x, y) + 0.5, depth), storedPosition(view, {x, y}, depth, layout)}) {
                points.push_back({lists.listOf({x, y}, view.camera.orthographic), dvec3(worldFromView * dvec4(place, 1))});
                low = min(low, points.back().world);
                high = max(high, points.back().world);
            }
        }
    for (size_t i = 0; i < table.size(); ++i) {
        const Light& light = scene.lights[table[i].sceneIndex];
        const dvec3 at(light.positionWorld);
        if (light.type != LightType::directional && distance(at, clamp(at, low, high)) >= light.range) continue;  // of no surface
        for (const Point& point : points)
            if (!result[point.list][i]) result[point.list][i] = holds(light, volumes, point.world);
    }
    return result;
}

/// What is so of all lists: in order, nothing twice, nothing that is no light; and what the statistics say of them.
void checkOrder(const Lists& lists, uint32_t lightCount) {
    uint64_t entries = 0;
    size_t longest = 0, disorder = 0;
    for (const Page& page : lists.pages) {
        disorder += !std::ranges::is_sorted(page.offsets);
        entries += page.entries.size();
        for (size_t i = 0; i < lists.count(); ++i) longest = std::max(longest, page.list(i).size());
    }
    for (size_t i = 0; i < lists.count(); ++i) {
        const std::vector<uint32_t> list = lists.list(i);
        disorder += std::ranges::adjacent_find(list, std::greater_equal<>{}) != list.end();
        disorder += !list.empty() && list.back() >= lightCount;
    }
    CHECK(disorder == 0);
    CHECK(lists.stats.entries == entries);
    CHECK(lists.stats.longest == longest);
    CHECK(lists.stats.lists == lists.count());
    CHECK(lists.stats.pages == lists.pages.size());
    CHECK(lists.stats.tileSize == lists.tileSize);
}

}  // namespace

TEST_CASE("light lists: over 2,000 random set-ups no light that reaches a pixel is missing in its list, and all lists are in order") {
    constexpr int kScenes = 100, kViews = 20, kLights = 40;
    constexpr uvec2 kExtents[] = {{1, 1}, {1, 4096}, {4096, 1}, {31, 37}, {97, 61}, {64, 32}, {33, 17}, {127, 3}};
    ListMaker maker;
    uint64_t entries = 0, reached = 0, missing = 0;
    for (int s = 0; s < kScenes; ++s) {
        Dice dice(uint64_t(s) + 1000);
        Scene scene = randomRoom(dice);
        addRandomVolumes(scene, dice);
        const uvec2 extent = size_t(s) < std::size(kExtents) ? kExtents[s] : uvec2(1 + dice.below(70), 1 + dice.below(70));
        std::vector<View> views;
        for (int v = 0; v < kViews; ++v) {
            views.push_back({randomCamera(dice), extent});
            // A floor close below the eye, so that a tile spans many octaves of depth.
            const mat4 floor = glm::rotate(glm::translate(mat4(1), vec3(0, -dice.scale(0.001f, 0.3f), 0)), -0.5f * float(kPi), vec3(1, 0, 0));
            if (v % 4 == 0) addObject(scene, quad(4), scene.materials[0], views.back().camera.worldFromView * floor);
        }
        // One of each kind, so that all scenes have the same features and with them the same pipelines.
        scene.lights = {directionalLight(dice.direction()), pointLight(dice.place(5), vec3(1), 1), spotLight(dice.place(5), dice.direction(), 0.1f, 0.5f, vec3(1), 3)};
        for (int i = 0; i < kLights; ++i) {
            const mat4& place = views[size_t(i) % kViews].camera.worldFromView;
            scene.lights.push_back(randomLight(dice, vec3(place[3]), -vec3(place[2])));
            if (i % 8 == 0) scene.lights.back().volume = dice.below(3);
        }
        validate(scene);
        maker.setScene(scene);
        const auto layout = GBufferLayout(s % 3);
        for (const ListsOf which : {ListsOf::tiles, ListsOf::clusters})
            for (size_t v = 0; v < views.size(); ++v) {
                INFO("scene " << s << ", view " << v << ", " << (which == ListsOf::tiles ? "tiles" : "clusters"));
                const Lists lists = maker.lists(views[v], {.which = which, .tileSize = TileSize(1 + s / 3 % 3)}, layout);
                checkOrder(lists, maker.scene().lightCount());
                const auto expected = needed(lists, scene, maker.scene(), views[v], layout);
                uint64_t absent = 0;
                for (size_t i = 0; i < lists.count(); ++i) {
                    std::vector<bool> listed(maker.scene().lightCount());
                    for (const uint32_t light : lists.list(i)) listed[light] = true;
                    entries += lists.list(i).size();
                    for (size_t light = 0; light < listed.size(); ++light) {
                        reached += expected[i][light];
                        absent += expected[i][light] && !listed[light];
                    }
                }
                CHECK(absent == 0);
                missing += absent;
            }
    }
    MESSAGE(reached << " pairs of a list and a light that reaches a pixel of it, " << missing << " missing, among " << entries << " entries");
    CHECK(reached > 100000);
}

TEST_CASE("light lists: lights no larger than what a G-buffer rounds, where it puts a surface, are in the lists of that surface") {
    ListMaker maker;
    uint64_t lights = 0;
    for (int s = 0; s < 30; ++s) {
        Dice dice(uint64_t(s) + 7000);
        Scene scene = randomRoom(dice);
        const auto layout = GBufferLayout(s % 3);
        const uvec2 extent(1 + dice.below(90), 1 + dice.below(90));
        for (int v = 0; v < 6; ++v) {
            View view{randomCamera(dice), extent};
            if (s % 6 == 3) view.camera.zNear = 1e-5f;  // 16 bits of depth end before the first surface
            const dmat4 worldFromView(view.camera.worldFromView);
            const Wanted wanted{.which = v % 2 == 0 ? ListsOf::tiles : ListsOf::clusters, .tileSize = TileSize::n8};
            scene.lights = {pointLight(vec3(0), vec3(1), 1)};
            maker.setScene(scene);
            const Lists surfaces = maker.lists(view, wanted, layout);
            scene.lights.clear();
            std::vector<uvec2> pixels;
            for (int tries = 0; tries < 200; ++tries) {
                const uvec2 pixel(dice.below(extent.x), dice.below(extent.y));
                const float depth = surfaces.depthAt(pixel);
                if (depth <= 0) continue;
                const dvec3 stored = storedPosition(view, pixel, depth, layout);
                // Floats can't tell places apart that are closer.
                const double rounding = 1e-6 * (length(stored) + length(dvec3(worldFromView[3])));
                scene.lights.push_back(pointLight(vec3(dvec3(worldFromView * dvec4(stored, 1))), vec3(1), float(rounding)));
                pixels.push_back(pixel);
            }
            if (pixels.empty()) continue;
            maker.setScene(scene);
            const Lists lists = maker.lists(view, wanted, layout);
            size_t missing = 0;
            for (uint32_t light = 0; light < pixels.size(); ++light) {
                const uint32_t place = uint32_t(std::ranges::find(maker.scene().lights().sources, light, &shared::PackedLight::sceneIndex) - maker.scene().lights().sources.begin());
                missing += !std::ranges::binary_search(lists.list(lists.listOf(pixels[light], view.camera.orthographic)), place);
            }
            INFO("scene " << s << ", view " << v);
            CHECK(missing == 0);
            lights += pixels.size();
        }
    }
    CHECK(lights > 10000);
}

TEST_CASE("light lists: in the hall they are not much longer than what their pixels need") {
    ListMaker maker;
    const Scene scene = loadScene("builtin:hall?lights=255");
    maker.setScene(scene);
    const View view{scene.cameras.at(0), {320, 240}};
    for (const auto which : {ListsOf::tiles, ListsOf::clusters})
        for (const auto tileSize : {TileSize::n8, TileSize::n16, TileSize::n32}) {
            const Lists lists = maker.lists(view, {.which = which, .tileSize = tileSize});
            checkOrder(lists, 255);
            uint64_t reached = 0;
            for (const std::vector<bool>& list : needed(lists, scene, maker.scene(), view, GBufferLayout::compact)) reached += uint64_t(std::ranges::count(list, true));
            INFO(lists.tileSize << (lists.clustered ? ", clusters" : ", tiles"));
            REQUIRE(reached > 0);
            CHECK(double(lists.stats.entries) < 2 * double(reached));
            CHECK(double(lists.count()) * 255 > 15 * double(reached));  // what lists of all lights would have
        }
}

TEST_CASE("light lists: in pages that fit a small buffer they are the lists of one page, and a frame that has no room for them runs again") {
    ListMaker maker;
    const Scene scene = loadScene("builtin:hall?lights=1000");
    maker.setScene(scene);
    const View view{scene.cameras.at(0), {160, 120}};
    // Little more than the places of the lists of 80 tiles, or 32 clusters each, need.
    for (const auto& [which, largestBuffer] : {std::pair(ListsOf::tiles, 80 * 8ull), std::pair(ListsOf::clusters, 80 * 32 * 4 + 100ull)}) {
        const Lists usual = maker.lists(view, {.which = which});
        REQUIRE(usual.pages.size() == 1);
        const Lists again = maker.lists(view, {.which = which, .entries = 100});
        CHECK(again.attempts == 2);
        CHECK(again.pages == usual.pages);
        CHECK(again.stats.entries == usual.stats.entries);
        const Lists paged = maker.lists(view, {.which = which, .largestBuffer = largestBuffer});
        CHECK(paged.pages.size() > usual.stats.entries * 4 / largestBuffer);
        CHECK(paged.tileSize == usual.tileSize);
        checkOrder(paged, 1000);
        CHECK(paged.stats.entries == usual.stats.entries);
        size_t different = paged.count() != usual.count();
        for (size_t i = 0; different == 0 && i < usual.count(); ++i) different += paged.list(i) != usual.list(i);
        CHECK(different == 0);
        for (int run = 0; run < 10; ++run) CHECK(maker.lists(view, {.which = which}).pages == usual.pages);
    }
}

TEST_CASE("light lists: where a buffer has no room for the places of all clusters, tiles are larger, and where none for those of all parts, pages are more") {
    constexpr uint32_t kMany = 33000;  // more than one part's
    ListMaker maker;
    Scene scene = whiteRoom();
    Dice dice(1);
    addManyLights(scene, dice, kMany, 0.05f);
    for (Light& light : scene.lights) light.positionWorld.x += 30;  // all but a few are elsewhere
    for (size_t i = 0; i < scene.lights.size(); i += 1000) scene.lights[i].positionWorld.x -= 30, scene.lights[i].range = 0.5f;
    maker.setScene(scene);
    const View view{kRoomView.camera, {64, 48}};
    struct Row {
        uint64_t largestBuffer;
        uint32_t tileSize, parts;
    };
    for (const Row& row : {Row{1ull << 27, 16, 2}, Row{12 * 32 * 4 + 4, 16, 1}, Row{12 * 32 * 4, 32, 2}}) {
        INFO("buffers of " << row.largestBuffer);
        const Lists lists = maker.lists(view, {.which = ListsOf::clusters, .largestBuffer = row.largestBuffer});
        CHECK(lists.tileSize == row.tileSize);
        CHECK(lists.pages[0].parts == row.parts);
        checkOrder(lists, kMany);
        const auto expected = needed(lists, scene, maker.scene(), view, GBufferLayout::compact);
        size_t missing = 0, reached = 0;
        for (size_t i = 0; i < lists.count(); ++i) {
            std::vector<bool> absent = expected[i];
            reached += size_t(std::ranges::count(absent, true));
            for (const uint32_t light : lists.list(i)) absent[light] = false;
            missing += size_t(std::ranges::count(absent, true));
        }
        CHECK(missing == 0);
        CHECK(reached > 20);
    }
}

TEST_CASE("light lists: where the sum of their lengths may not fit 32 bits, they are made in more pages") {
    ListMaker maker;
    const Scene scene = loadScene("builtin:hall?lights=10");
    maker.setScene(scene);
    const View view{scene.cameras.at(0), {16, 12}};
    maker.lists(view, {});
    std::vector<uint32_t> counters(shared::kListCounters);
    counters[shared::kListLongest] = 30000;
    counters[shared::kListFound] = 143165;  // times 30,000 is below 2^32
    counters[shared::kListAllEntries] = 7;
    counters[shared::kListAllEntriesHigh] = 2;
    const auto [enough, stats] = maker.judge(counters);
    CHECK(!enough);
    CHECK(stats.lightLists->entries == (2ull << 32) + 7);
    counters[shared::kListFound] = 143166;
    const auto [again, more] = maker.judge(counters);
    REQUIRE(again);
    CHECK(again->slices == 2);
}
