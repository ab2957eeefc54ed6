#include "render/shadow/shadow_plan.hpp"

#include <doctest/doctest.h>
#include <luciole/error.hpp>
#include <set>

#include "random_scenes.hpp"
#include "render/shadow/mesh_edges.hpp"
#include "scene_building.hpp"

using namespace luciole;
using namespace luciole::test;
using render::Page;
using render::PageAllocator;
using render::ShadowPlan;

namespace {

/// Boxes in a room of 20 m, and what a plan is asked with.
struct Room {
    std::vector<Light> lights;
    std::vector<render::ShadowCaster> casters;
    RenderSettings settings{.shadows = Shadows::maps};
    View view{.camera = frontCamera(12), .extent = {640, 480}};
    uint64_t version = 0;
    uint32_t largestSide = 16384;

    explicit Room(uint32_t boxes = 40, uint64_t seed = 1) {
        Dice dice(seed);
        for (uint32_t i = 0; i < boxes; ++i) {
            const vec3 at = dice.place(9);
            casters.push_back({{at - vec3(0.4f), at + vec3(0.4f)}, i, true});
        }
    }
    void addPoints(uint32_t count, float range, uint64_t seed = 2) {
        Dice dice(seed);
        for (uint32_t i = 0; i < count; ++i) lights.push_back(pointLight(dice.place(9), vec3(1), range));
    }
    ShadowPlan::Inputs inputs() const {
        return {.view = view,
                .settings = settings,
                .lights = lights,
                .casters = casters,
                .boundsWorld = {vec3(-10), vec3(10)},
                .castsFor = [](uint32_t, uint32_t) { return true; },
                .largestSide = largestSide,
                .version = version};
    }
    void turn(float angle) { view.camera.worldFromView = glm::rotate(mat4(1), angle, vec3(0, 1, 0)) * frontCamera(12).worldFromView; }
};

/// What the atlas holds, texel by texel in blocks of the smallest page: which light's map, and what was drawn into it.
class PaintedAtlas {
public:
    /// Draws what is dirty and checks that every map finds what was drawn for it.
    void checkFrame(const ShadowPlan& plan) {
        if (plan.extent() != extent_) blocks_.clear(), still_.clear();
        if (!plan.needsStill()) still_.clear();
        extent_ = plan.extent();
        size_t overwritten = 0, outside = 0, stale = 0, notStill = 0;
        for (const uint32_t i : plan.dirty()) {
            const render::PlannedMap& map = plan.maps()[i];
            paint(map, ++drawings_);
            if (!map.overStill) continue;
            CHECK(plan.needsStill());
            uint64_t& drawing = lastStill_[{map.light, map.face}];
            if (map.stillDirty) drawing = drawings_;
            forEachBlock(map.page, [&](uvec2 block) {
                if (map.stillDirty) still_[{block.x, block.y}] = drawing;
                notStill += still_[{block.x, block.y}] != drawing || drawing == 0;
            });
        }
        CHECK(notStill == 0);
        for (const render::PlannedMap& map : plan.maps()) {
            if (map.page.side == 0) continue;
            outside += glm::any(glm::greaterThan(map.page.first + map.page.side, extent_));
            if (!map.drawn) continue;
            const auto& last = last_.at({map.light, map.face});
            stale += !(last.page == map.page && last.origin == map.frustum.origin && last.forward == map.frustum.forward);
            forEachBlock(map.page, [&](uvec2 block) { overwritten += blocks_[{block.x, block.y}] != last.drawing; });
        }
        CHECK(outside == 0);
        CHECK(overwritten == 0);
        CHECK(stale == 0);
    }

private:
    struct Drawn {
        Page page;
        dvec3 origin, forward;
        uint64_t drawing;
    };
    static void forEachBlock(Page page, const auto& use) {
        for (uint32_t y = 0; y < page.side; y += 16)
            for (uint32_t x = 0; x < page.side; x += 16) use(page.first + uvec2(x, y));
    }
    void paint(const render::PlannedMap& map, uint64_t drawing) {
        last_[{map.light, map.face}] = {map.page, map.frustum.origin, map.frustum.forward, drawing};
        forEachBlock(map.page, [&](uvec2 block) { blocks_[{block.x, block.y}] = drawing; });
    }

    uvec2 extent_{0};
    uint64_t drawings_ = 0;
    std::map<std::pair<uint32_t, uint32_t>, uint64_t> blocks_, still_, lastStill_;
    std::map<std::pair<uint32_t, uint32_t>, Drawn> last_;
};

}  // namespace

TEST_CASE("shadow plan: pages never overlap, and freed ones are whole again") {
    Dice dice(3);
    PageAllocator pages({512, 256});
    std::vector<Page> held;
    uint64_t texels = 0;
    for (int step = 0; step < 20000; ++step) {
        if (dice.below(5) < 3) {
            const auto page = pages.allocate(1u << dice.below(9));
            if (!page) continue;
            CHECK(page->first % page->side == uvec2(0));
            CHECK(glm::all(glm::lessThanEqual(page->first + page->side, uvec2(512, 256))));
            for (const Page& other : held) {
                const bool apart = glm::any(glm::lessThanEqual(page->first + page->side, other.first)) || glm::any(glm::lessThanEqual(other.first + other.side, page->first));
                if (!apart) FAIL_CHECK("two pages overlap");
            }
            held.push_back(*page);
            texels += uint64_t(page->side) * page->side;
        } else if (!held.empty()) {
            std::swap(held[dice.below(uint32_t(held.size()))], held.back());
            pages.free(held.back());
            held.pop_back();
        }
    }
    CHECK(texels > 512 * 256);
    for (const Page& page : held) pages.free(page);
    CHECK(pages.allocate(256));
    CHECK(pages.allocate(256));
    CHECK_FALSE(pages.allocate(1));
}

TEST_CASE("shadow plan: with nothing moving nothing is drawn again, nor are local lights' maps when the camera turns") {
    Room room;
    room.addPoints(8, 6);
    room.lights.push_back(spotLight(vec3(0, 8, 0), vec3(0, -1, 0), 0.2f, 0.6f));
    ShadowPlan plan;
    plan.update(room.inputs());
    CHECK(plan.stats().lights == 9);
    CHECK(plan.stats().drawn == plan.stats().maps);
    CHECK(plan.stats().maps > 9);
    plan.update(room.inputs());
    CHECK(plan.stats().drawn == 0);
    CHECK(plan.dirty().empty());
    // Where a light was seen before, its maps are there; faces that come into view are drawn once.
    std::set<std::pair<uint32_t, uint32_t>> drawn;
    for (int step = 0; step <= 40; ++step) {
        room.turn(0.02f * float(step % 20));
        plan.update(room.inputs());
        for (const uint32_t i : plan.dirty()) CHECK(drawn.insert({plan.maps()[i].light, plan.maps()[i].face}).second);
    }
}

TEST_CASE("shadow plan: a light that moved has its own maps drawn, an object those that it casts into, before and after") {
    Room room(60);
    room.addPoints(12, 4);
    ShadowPlan plan;
    plan.update(room.inputs());
    room.lights[5].positionWorld += vec3(0.1f);
    ++room.version;
    plan.update(room.inputs());
    CHECK(plan.stats().drawn > 0);
    for (const uint32_t i : plan.dirty()) CHECK(plan.maps()[i].light == 5);

    size_t drawn = 0, maps = 0;
    for (uint32_t object = 0; object < 60; ++object) {
        const Bounds before = room.casters[object].boundsWorld;
        room.casters[object].boundsWorld = {before.low + vec3(0.3f), before.high + vec3(0.3f)};
        ++room.casters[object].version;
        ++room.version;
        plan.update(room.inputs());
        std::set<std::pair<uint32_t, uint32_t>> dirty, expected;
        for (const uint32_t i : plan.dirty()) dirty.insert({plan.maps()[i].light, plan.maps()[i].face});
        // By brute force: a light whose sphere holds some of the box, before or after, and only those.
        for (const render::PlannedMap& map : plan.maps()) {
            const auto reaches = [&](const Bounds& bounds) {
                const vec3 p = room.lights[map.light].positionWorld;
                return glm::distance(glm::clamp(p, bounds.low, bounds.high), p) < 4;
            };
            if (dirty.contains({map.light, map.face})) CHECK((reaches(before) || reaches(room.casters[object].boundsWorld)));
            // The middle of the box within the face's own quarter: it is sure to be seen.
            const dvec3 to = dvec3(room.casters[object].boundsWorld.low + vec3(0.4f)) - map.frustum.origin;
            const double along = dot(to, map.frustum.forward);
            if (along > std::max(std::abs(dot(to, map.frustum.right)), std::abs(dot(to, map.frustum.down))) && length(to) < 4) expected.insert({map.light, map.face});
        }
        CHECK(std::ranges::includes(dirty, expected));
        drawn += dirty.size(), maps += plan.maps().size();
    }
    CHECK(drawn > 0);
    CHECK(double(drawn) < 0.2 * double(maps));  // far from all
}

TEST_CASE("shadow plan: of what moves again only that is drawn, over what stands still") {
    Room room(60);
    room.addPoints(12, 8);
    ShadowPlan plan;
    plan.update(room.inputs());
    CHECK_FALSE(plan.needsStill());
    const auto move = [&] {
        room.casters[7].boundsWorld = {room.casters[7].boundsWorld.low + vec3(0.01f), room.casters[7].boundsWorld.high + vec3(0.01f)};
        ++room.casters[7].version, ++room.version;
        plan.update(room.inputs());
    };
    move();
    REQUIRE(plan.stats().drawn > 0);
    CHECK(plan.needsStill());
    for (const uint32_t i : plan.dirty()) CHECK(plan.maps()[i].stillDirty);
    move();
    REQUIRE(plan.stats().drawn > 0);
    for (const uint32_t i : plan.dirty()) {
        CHECK_FALSE(plan.maps()[i].stillDirty);
        CHECK(plan.maps()[i].overStill);
        CHECK(plan.maps()[i].casters == std::vector<uint32_t>{7});
    }
}

TEST_CASE("shadow plan: 1,024 point lights have shadows within 256 MiB") {
    Room room(200);
    room.addPoints(1024, 10);
    ShadowPlan plan;
    plan.update(room.inputs());
    CHECK(plan.stats().lost.empty());
    CHECK(plan.stats().waiting.empty());
    CHECK(plan.stats().texels <= 64u << 20);
    CHECK(uint64_t(plan.extent().x) * plan.extent().y <= 64u << 20);
    CHECK(plan.stats().texels * 8 >= uint64_t(plan.extent().x) * plan.extent().y);
    CHECK(plan.stats().lights > 700);  // the others are not in view
    PaintedAtlas().checkFrame(plan);
}

TEST_CASE("shadow plan: what does not fit is named, the least visible first, and refused if asked") {
    Room room(200);
    room.addPoints(1024, 10);
    room.lights[17].name = "the lamp";
    room.settings.shadowMemory = 1;
    ShadowPlan plan;
    plan.update(room.inputs());
    CHECK(plan.stats().texels <= 1u << 18);
    CHECK(plan.stats().lost.size() > 100);
    CHECK(plan.stats().lost[0].reason == "the maps of all lights do not fit into 1 MiB (shadow-memory), not at 16 texels a side");
    std::set<uint32_t> lost, kept;
    for (const auto& without : plan.stats().lost) CHECK(lost.insert(without.light).second);
    double least = HUGE_VAL;
    for (const render::PlannedMap& map : plan.maps()) {
        CHECK_FALSE(lost.contains(map.light));
        kept.insert(map.light);
        least = std::min(least, map.pixels);
    }
    CHECK(lost.size() + kept.size() > 700);
    CHECK(least > 0);
    PaintedAtlas().checkFrame(plan);
    room.settings.onOverflow = OnOverflow::fail;
    CHECK_THROWS_WITH_AS(plan.update(room.inputs()), doctest::Contains("(shadow-memory), not at 16 texels a side"), Error);
    room.settings.onOverflow = OnOverflow::exact;
    room.settings.shadowMemory = 4096;
    Room small = room;
    small.largestSide = 512;
    ShadowPlan ofSmall;
    ofSmall.update(small.inputs());
    REQUIRE(!ofSmall.stats().lost.empty());
    CHECK(ofSmall.stats().lost[0].reason == "the maps of all lights do not fit into an image of 512 x 512 texels, the device's largest, not at 16 texels a side");
    plan.update(room.inputs());
    CHECK(plan.stats().lost.empty());
}

TEST_CASE("shadow plan: a budget of redraws draws the most visible first, says who waits, and gets done") {
    Room room;
    room.addPoints(10, 6);
    room.settings.shadowRedraws = 7;
    ShadowPlan plan;
    PaintedAtlas atlas;
    uint32_t drawn = 0, frames = 0;
    double before = HUGE_VAL;
    do {
        plan.update(room.inputs());
        atlas.checkFrame(plan);
        CHECK(plan.stats().drawn <= 7);
        for (const uint32_t i : plan.dirty()) {
            CHECK(plan.maps()[i].pixels <= before);
            before = plan.maps()[i].pixels;
        }
        if (!plan.stats().waiting.empty()) CHECK(plan.stats().waiting[0].reason == "its map waits to be drawn, as 7 a frame are (shadow-redraws)");
        drawn += plan.stats().drawn;
        ++frames;
    } while (!plan.stats().waiting.empty() && frames < 100);
    CHECK(frames == (plan.stats().maps + 6) / 7);
    CHECK(drawn == plan.stats().maps);
    // A map that waits is what it was, where it was: the light where it shone from, the page as large.
    std::map<std::pair<uint32_t, uint32_t>, Page> pages;
    for (const render::PlannedMap& map : plan.maps()) pages[{map.light, map.face}] = map.page;
    for (Light& light : room.lights) light.positionWorld.z += 3;
    ++room.version;
    plan.update(room.inputs());
    atlas.checkFrame(plan);
    CHECK(plan.stats().waiting.size() > 2);
    const auto kept = [&](const render::PlannedMap& map) { return pages[{map.light, map.face}].side != 0 && map.side != 0; };
    CHECK(std::ranges::any_of(plan.maps(), [&](const auto& map) { return kept(map) && map.side > map.page.side; }));
    CHECK(std::ranges::none_of(plan.maps(), [&](const auto& map) { return kept(map) && !map.drawn; }));
    room.settings.onOverflow = OnOverflow::fail;
    CHECK_THROWS_WITH_AS(plan.update(room.inputs()), doctest::Contains("as 7 a frame are (shadow-redraws)"), Error);
}

TEST_CASE("shadow plan: where all lights always move, no map waits for ever") {
    Room room;
    room.addPoints(10, 6);
    room.settings.shadowRedraws = 3;
    ShadowPlan plan;
    PaintedAtlas atlas;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> drawn;
    double most = 0, least = HUGE_VAL;
    constexpr uint32_t kFrames = 400;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
        for (Light& light : room.lights) light.positionWorld.x += frame & 1 ? 0.01f : -0.01f;
        ++room.version;
        plan.update(room.inputs());
        atlas.checkFrame(plan);
        CHECK(plan.stats().drawn == 3);
        for (const uint32_t i : plan.dirty()) ++drawn[{plan.maps()[i].light, plan.maps()[i].face}];
    }
    for (const render::PlannedMap& map : plan.maps()) {
        if (map.side == 0) continue;
        most = std::max(most, map.pixels);
        least = std::min(least, map.pixels);
        CHECK(drawn[{map.light, map.face}] >= 1);
    }
    // As often as they are large: of two maps the larger is drawn more often by about that factor.
    CHECK(most / least > 1.5);
    uint32_t oftenest = 0, seldomest = kFrames;
    for (const auto& [map, times] : drawn) oftenest = std::max(oftenest, times), seldomest = std::min(seldomest, times);
    CHECK(double(oftenest) / seldomest == doctest::Approx(most / least).epsilon(0.25));
}

TEST_CASE("shadow plan: whatever moves, each map finds in its page what was drawn for it") {
    for (uint64_t seed = 1; seed <= 20; ++seed) {
        Dice dice(seed);
        Room room(30, seed);
        const vec3 eye = dice.place(5);
        for (int i = 0; i < 40; ++i) room.lights.push_back(randomLight(dice, eye, dice.direction()));
        room.settings.shadowMemory = 1 + dice.below(3);
        ShadowPlan plan;
        PaintedAtlas atlas;
        for (int frame = 0; frame < 30; ++frame) {
            const uint32_t kind = dice.below(6);
            if (kind == 0) room.lights[dice.below(40)] = randomLight(dice, eye, dice.direction()), ++room.version;
            if (kind == 1) {
                render::ShadowCaster& caster = room.casters[dice.below(30)];
                const vec3 step = dice.place(1);
                caster.boundsWorld = {caster.boundsWorld.low + step, caster.boundsWorld.high + step};
                ++caster.version, ++room.version;
            }
            if (kind == 2) room.view.camera = randomCamera(dice);
            if (kind == 3) room.view.extent = {1 + dice.below(2000), 1 + dice.below(2000)};
            if (kind == 4) room.settings.shadowMemory = 1 + dice.below(8);
            if (kind == 5) room.settings.shadowRedraws = dice.below(30);
            plan.update(room.inputs());
            atlas.checkFrame(plan);
        }
    }
}

TEST_CASE("shadow plan: degenerate lights and views give maps of finite numbers, or none") {
    Room room;
    const float tiny = std::numeric_limits<float>::denorm_min();
    for (const float range : {tiny, 1e-3f, 1e-2f, 1.0f, 1e30f, std::numeric_limits<float>::infinity()})
        for (const float cone : {1e-7f, 1e-3f, 0.5f, 1.0f, 1.5707964f, 3.1415925f}) {
            room.lights.push_back(spotLight(vec3(0), vec3(0, -1, 0), 0, cone, vec3(1), range));
            room.lights.push_back(spotLight(room.view.camera.worldFromView[3], vec3(0, 0, -1), 0, cone, vec3(1), range));
            room.lights.push_back(spotLight(vec3(1e6f), vec3(-1), 0, cone, vec3(1), range));
        }
    for (const vec3 axis : {vec3(0, 1, 0), vec3(0, -1, 0), vec3(1, 1e-6f, 0)}) room.lights.push_back(directionalLight(axis));
    for (const uvec2 extent : {uvec2(1, 1), uvec2(1, 4096), uvec2(4096, 1), uvec2(97, 89)})
        for (const bool orthographic : {false, true}) {
            room.view = {.camera = orthographic ? frontOrthographicCamera(12, 5) : frontCamera(12), .extent = extent};
            ShadowPlan plan;
            plan.update(room.inputs());
            CHECK(plan.stats().maps > 0);
            for (const render::PlannedMap& map : plan.maps()) {
                const auto constants = ShadowPlan::constants(map, 1, room.view.camera.worldFromView[3]);
                CHECK(std::isfinite(constants.scale));
                for (const vec3 row : {constants.right, constants.down, constants.forward, constants.origin})
                    for (int c = 0; c < 3; ++c) CHECK(std::isfinite(row[c]));
            }
        }
}

TEST_CASE("shadow plan: the cascades of a directional light hold all that is seen, the nearest the finest") {
    Room room(80);
    room.lights = {directionalLight(vec3(0.3f, -1, 0.2f))};
    for (const bool inside : {false, true}) {
        if (inside) room.view.camera.worldFromView = glm::translate(mat4(1), vec3(0, -8, 9));
        room.view.camera.zNear = 0.05f;
        ShadowPlan plan;
        plan.update(room.inputs());
        REQUIRE(!plan.maps().empty());
        Dice dice(5);
        const dvec3 eye(room.view.camera.worldFromView[3]);
        size_t seen = 0, missed = 0;
        std::vector<size_t> inCascade(plan.maps().size());
        double texel = 0;
        for (const render::PlannedMap& map : plan.maps()) {
            const auto constants = ShadowPlan::constants(map, 1, eye);
            CHECK(1 / double(constants.scale) > texel);
            texel = 1 / double(constants.scale);
        }
        for (int i = 0; i < 20000; ++i) {
            const dvec3 point = dice.place(10);
            const dvec3 v(inverse(dmat4(room.view.camera.worldFromView)) * dvec4(point, 1));
            const double slope = std::tan(0.5 * double(room.view.camera.yFov));
            if (-v.z < 0.05 || std::abs(v.y) > -v.z * slope || std::abs(v.x) > -v.z * slope * 4 / 3) continue;
            ++seen;
            bool held = false;
            for (size_t m = 0; m < plan.maps().size() && !held; ++m) {
                const auto constants = ShadowPlan::constants(plan.maps()[m], 1, eye);
                const vec3 Q = vec3(point - eye) - constants.origin;
                const vec2 at = constants.scale * vec2(glm::dot(constants.right, Q), glm::dot(constants.down, Q));
                const float depth = 1 - constants.fall * glm::dot(constants.forward, Q);
                held = glm::max(std::abs(at.x), std::abs(at.y)) < 0.5f * float(plan.maps()[m].page.side) - 0.5f && depth >= 0 && depth <= 1;
                inCascade[m] += held;
            }
            missed += !held;
        }
        CHECK(seen > 1000);
        CHECK(missed == 0);
        if (inside) CHECK(plan.maps().size() > 1);
    }
}

TEST_CASE("shadow plan: the faces of a cube lie as shaders take them to") {
    CHECK(luciole::shared::kShadowMapNear == kShadowNear);
    Room room(300);
    room.lights = {pointLight(vec3(0), vec3(1), 20)};
    room.view.camera.worldFromView = glm::translate(mat4(1), vec3(0, 0, 30));
    ShadowPlan plan;
    plan.update(room.inputs());
    REQUIRE(plan.maps().size() == 6);
    Dice dice(9);
    for (int i = 0; i < 1000; ++i) {
        const vec3 v = dice.place(1);
        const uint32_t face = luciole::shared::cubeFaceOf(v);
        const render::ShadowFrustum& frustum = plan.maps()[face].frustum;
        CHECK(plan.maps()[face].face == face);
        const vec3 found = luciole::shared::inCubeFace(face, v);
        CHECK(glm::distance(found, vec3(glm::dot(vec3(frustum.right), v), glm::dot(vec3(frustum.down), v), glm::dot(vec3(frustum.forward), v))) < 1e-6f);
        CHECK(found.z >= std::max(std::abs(found.x), std::abs(found.y)));
    }
}

TEST_CASE("mesh edges: a closed mesh has each edge once, with two triangles that run through it in opposite directions") {
    const std::vector<uint32_t> box{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    const std::vector<vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<uvec2> edges = render::edgesOf(corners, box);
    CHECK(edges.size() == 6);
    for (const uvec2 edge : edges) {
        CHECK(edge.y != kNone);
        CHECK(edge.y % 4 == 0);
        CHECK(edge.x / 4 != edge.y / 4);
    }
    // The same with vertices of its own for each triangle.
    std::vector<vec3> own;
    std::vector<uint32_t> order;
    for (const uint32_t i : box) order.push_back(uint32_t(own.size())), own.push_back(corners[i]);
    CHECK(render::edgesOf(own, order).size() == 6);
}

TEST_CASE("mesh edges: open, degenerate and crowded ones; whatever a triangle's side, what turns about an edge adds up") {
    CHECK(render::edgesOf({}, {}).empty());
    const std::vector<vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
    const std::vector<uint32_t> triangle{0, 1, 2}, line{0, 1, 1};
    CHECK(render::edgesOf(corners, triangle) == std::vector<uvec2>{{2, kNone}, {0, kNone}, {1, kNone}});
    CHECK(render::edgesOf(corners, line).size() == 1);
    Dice dice(4);
    for (int round = 0; round < 200; ++round) {
        std::vector<uint32_t> indices;
        for (uint32_t i = 0, count = 1 + dice.below(12); i < 3 * count; ++i) indices.push_back(dice.below(5));
        std::vector<int> side;
        for (size_t t = 0; t < indices.size() / 3; ++t) side.push_back(dice.below(2) == 0 ? -1 : 1);
        std::map<std::pair<uint32_t, uint32_t>, int> expected, found;  // by rising edge
        const auto add = [&](auto& turns, uint32_t a, uint32_t b, int by) {
            if (a != b) turns[std::minmax(a, b)] += a < b ? by : -by;
        };
        const auto run = [&](uint32_t from) { return std::pair(indices[3 * (from / 4) + from % 4], indices[3 * (from / 4) + (from % 4 + 1) % 3]); };
        for (uint32_t t = 0; t < indices.size() / 3; ++t)
            for (uint32_t c = 0; c < 3; ++c) add(expected, run(4 * t + c).first, run(4 * t + c).second, side[t]);
        for (const uvec2 edge : render::edgesOf(corners, indices)) {
            const auto [a, b] = run(edge.x);
            add(found, a, b, side[edge.x / 4] + (edge.y == kNone ? 0 : (edge.y % 4 == 1 ? 1 : -1) * side[edge.y / 4]));
        }
        CHECK(expected == found);
    }
}

TEST_CASE("shadow plan: a page survives being packed in a word") {
    for (const uint32_t log : {4u, 7u, 14u})
        for (const uvec2 first : {uvec2(0), uvec2(16, 32), uvec2(16368, 16368)})
            for (const float softness : {0.0f, 1.0f, 0.3f, 4.0f}) {
                const uint32_t packed = luciole::shared::packPage(first, log, softness);
                CHECK(packed != 0);
                const auto page = luciole::shared::unpackPage(packed);
                CHECK(page.side == float(1u << log));
                CHECK(page.center == vec2(first) + 0.5f * page.side);
                CHECK(std::abs(page.softness - softness) < 0.008f);
            }
}
