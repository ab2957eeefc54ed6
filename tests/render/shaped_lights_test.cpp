#include <map>

#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>

#include "device.hpp"
#include "image_difference.hpp"
#include "random_scenes.hpp"
#include "render/lighting/techniques.hpp"
#include "scene_building.hpp"
#include "scenes.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

const std::vector<std::string> kCounts{"evaluations", "useful-evaluations", "light-fingerprint"};

double distanceToTriangle(dvec3 p, dvec3 a, dvec3 b, dvec3 c) {
    const dvec3 n = cross(b - a, c - a);
    const auto side = [&](dvec3 u, dvec3 v) { return dot(cross(v - u, p - u), n) >= 0; };
    if (side(a, b) && side(b, c) && side(c, a)) return std::abs(dot(p - a, n)) / length(n);
    double best = INFINITY;
    for (const auto& [u, v] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        const double t = std::clamp(dot(p - u, v - u) / dot(v - u, v - u), 0.0, 1.0);
        best = std::min(best, length(p - (u + t * (v - u))));
    }
    return best;
}

/// Pixels whose surface lies so close to the face of a light's mesh that the rasterizer's sub-pixel grid decides on which
/// side: on Vulkan's least grid, 16 a pixel, and with what 32 bits of depth leave of its position.
std::vector<bool> nearVolumes(const Scene& scene, const View& view, const Image& depth) {
    const Camera& camera = view.camera;
    std::vector<bool> near(size_t(depth.width) * depth.height);
    const double top = camera.orthographic ? camera.halfHeight : std::tan(0.5 * camera.yFov);
    const double pixel = 2 * top / depth.height;
    for (uint32_t y = 0; y < depth.height; ++y)
        for (uint32_t x = 0; x < depth.width; ++x) {
            const double z = depth.at(x, y, 0);
            if (z <= 0) continue;
            const double scale = camera.orthographic ? 1 : z;
            const dvec2 p = dvec2(x + 0.5 - 0.5 * depth.width, 0.5 * depth.height - y - 0.5) * pixel * scale;
            const dvec3 world(dmat4(camera.worldFromView) * dvec4(p, -z, 1));
            const double rounding = camera.orthographic ? 1e-6 * camera.zFar : 1e-6 * z * z / camera.zNear;
            const double unsure = pixel * scale / 16 + rounding + 1e-5 * (z + length(dvec3(camera.worldFromView[3])));
            for (const LightVolume& volume : scene.lightVolumes)
                for (size_t i = 0; i < volume.indices.size() && !near[y * depth.width + x]; i += 3) {
                    const auto corner = [&](size_t k) { return dvec3(volume.positionsWorld[volume.indices[i + k]]); };
                    near[y * depth.width + x] = distanceToTriangle(world, corner(0), corner(1), corner(2)) < unsure;
                }
        }
    return near;
}

bool drawsShapes(const render::LightingTechnique& technique) {
    return technique.info.name != "brute-force" && technique.info.name != "fullscreen" && technique.info.name != "forward-loop";
}

}  // namespace

TEST_CASE("shaped lights: over 2,000 random views no technique misses or doubles a light at a pixel") {
    constexpr int kScenes = 50, kViews = 40;
    ValidatedRenderer renderer;
    uint64_t pairs = 0, compared = 0, unsure = 0;
    for (int s = 0; s < kScenes; ++s) {
        Dice dice(uint64_t(s) + 1);
        Scene scene = randomRoom(dice);
        // A mesh's faces are hard edges, and two layouts put the surface elsewhere than the depth buffer that the stencil goes by.
        const auto layout = GBufferLayout(s % 3);
        if (layout == GBufferLayout::compact) addRandomVolumes(scene, dice);
        const uvec2 extent(1 + dice.below(40), 1 + dice.below(40));
        std::vector<View> views;
        for (int v = 0; v < kViews; ++v) views.push_back({randomCamera(dice), extent});
        for (int i = 0; i < 40; ++i) {
            const mat4& place = views[size_t(i) % kViews].camera.worldFromView;
            scene.lights.push_back(randomLight(dice, vec3(place[3]), -vec3(place[2])));
            if (i % 8 == 0 && !scene.lightVolumes.empty()) scene.lights.back().volume = dice.below(3);
        }
        scene.linkGroups = {{"some", {true, false, true, true, false}, {}}};
        for (int i = 0; i < 6; ++i) scene.lights[dice.below(40)].linkGroup = 0;
        validate(scene);
        renderer->setScene(scene);
        const auto render = [&](std::string_view technique, const View& view) {
            RenderSettings settings{.lighting = std::string(technique), .gbuffer = layout, .overlap = 16};
            // Light indices: what the packings share is how lights are drawn, to the surface or on the way to it.
            constexpr LidrPacking kPackings[] = {LidrPacking::list, LidrPacking::cpuSort, LidrPacking::bitShift};
            settings.lidrPacking = kPackings[s / 3 % 3];
            settings.lidrCover = s / 9 % 2 == 0 ? LidrCover::surface : LidrCover::frontFaces;
            return renderer->render(view, settings, kCounts);
        };
        std::map<std::string, std::vector<Frame>> yardsticks;
        std::vector<std::vector<bool>> skipped;
        for (const View& view : views) {
            for (const char* name : {"brute-force", "forward-loop"}) yardsticks[name].push_back(render(name, view));
            skipped.push_back(nearVolumes(scene, view, renderer->render(view, {.gbuffer = layout}, {"depth"}).aovs.at("depth")));
        }
        for (const auto& technique : render::techniques()) {
            if (!drawsShapes(technique)) continue;
            if (technique.forward && layout != GBufferLayout::compact) continue;  // they have no layout
            const std::vector<Frame>& expected = yardsticks.at(render::yardstickOf(technique));
            for (size_t v = 0; v < views.size(); ++v) {
                INFO("scene " << s << ", view " << v << ", technique " << technique.info.name);
                const Frame frame = render(technique.info.name, views[v]);
                size_t wrong = 0, excess = 0;
                for (size_t i = 0; i < skipped[v].size(); ++i) {
                    const auto at = [&](const Frame& f, const char* name) { return f.aovs.at(name).data[i]; };
                    excess += at(frame, "evaluations") < at(frame, "useful-evaluations") || at(frame, "evaluations") > 40;
                    // Where surfaces coincide, forward techniques count all of them.
                    const bool skip = skipped[v][i] || at(expected[v], "evaluations") > 40;
                    unsure += skip;
                    if (skip) continue;
                    wrong += at(frame, "useful-evaluations") != at(expected[v], "useful-evaluations") ||
                             at(frame, "light-fingerprint") != at(expected[v], "light-fingerprint");
                    pairs += uint64_t(at(frame, "useful-evaluations"));
                    ++compared;
                }
                CHECK(wrong == 0);
                CHECK(excess == 0);
            }
        }
    }
    MESSAGE(pairs << " pairs of a light and a pixel at " << compared << " pixels; " << unsure << " pixels left out");
    CHECK(pairs > 1000000);
    CHECK(double(unsure) < 0.02 * double(compared));
}

TEST_CASE("shaped lights: each technique equals brute force at 1, 16, 255 and 4,096 lights") {
    ValidatedRenderer renderer;
    std::vector<TestScene> scenes = testScenes();
    scenes.push_back({"dense hall", loadScene("builtin:hall?lights=1&triangles=4000&overlap=16"), {}});
    scenes.back().view.camera = scenes.back().scene.cameras.at(0);
    REQUIRE(scenes.size() >= 8);
    for (TestScene& test : scenes) {
        const View view{test.view.camera, {32, 24}};
        const Bounds bounds = boundsOf(test.scene);
        const float size = glm::length(bounds.high - bounds.low);
        Dice dice(4096);
        std::vector<Light> many = test.scene.lights;  // with their functions, links and contributions
        while (many.size() < 4096) {
            const vec3 at = bounds.low + (bounds.high - bounds.low) * vec3(dice.between(0, 1), dice.between(0, 1), dice.between(0, 1));
            many.push_back(randomLight(dice, at, dice.direction()));
            many.back().range = std::min(many.back().range, dice.scale(0.02f, 0.3f) * size);
            if (many.back().type == LightType::directional) many.back().type = LightType::point;
        }
        for (const size_t count : {1, 16, 255, 4096}) {
            test.scene.lights.assign(many.begin(), many.begin() + ptrdiff_t(count));
            renderer->setScene(test.scene);
            Yardsticks yardsticks(renderer, view, {}, kCounts);
            for (const auto& technique : render::techniques()) {
                const Frame& yardstick = yardsticks.of(technique);
                INFO("scene " << test.name << ", " << count << " lights, technique " << technique.info.name);
                const Frame frame = renderer->render(view, {.lighting = std::string(technique.info.name)}, kCounts);
                const std::vector<bool> mask = yardsticks.comparable(technique, test.scene);
                checkAlike(technique, frame.radiance, yardstick.radiance, mask, count);
                size_t wrong = 0;
                for (size_t i = 0; i < mask.size(); ++i)
                    for (const char* name : {"useful-evaluations", "light-fingerprint"})
                        wrong += mask[i] && frame.aovs.at(name).data[i] != yardstick.aovs.at(name).data[i];
                CHECK(wrong == 0);
            }
        }
    }
}

TEST_CASE("shaped lights: what each technique evaluates and draws in the hall is what docs/techniques says") {
    ValidatedRenderer renderer;
    const Scene scene = loadScene("builtin:hall?lights=255");
    renderer->setScene(scene);
    const View view{scene.cameras.at(0), {400, 300}};
    struct Row {
        const char* technique;
        double evaluations;
        uint32_t draws, stencilDraws;
    };
    for (const Row& row : {Row{"brute-force", 255, 1, 0}, Row{"fullscreen", 255, 255, 0}, Row{"quad", 23.88, 1, 0}, Row{"volume", 12.23, 241, 0},
                           Row{"volume-stencil", 4.35, 468, 227}, Row{"volume-stencil-reference", 4.35, 468, 227},
                           Row{"volume-instanced", 12.23, 12, 0}, Row{"forward-multipass", 11.77, 3166, 0}, Row{"light-prepass", 12.23, 12, 0}}) {
        INFO(std::string(row.technique));
        const Frame frame = renderer->render(view, {.lighting = row.technique}, kCounts);
        const auto mean = [&](const char* name) {
            double sum = 0;
            for (const float value : frame.aovs.at(name).data) sum += value;
            return sum / double(frame.aovs.at(name).data.size());
        };
        // Rasterizers may disagree about pixels on edges: 0.2 % of them.
        CHECK(mean("evaluations") == doctest::Approx(row.evaluations).epsilon(0.002));
        CHECK(mean("useful-evaluations") == doctest::Approx(4.0).epsilon(0.002));
        for (const PassStats& pass : frame.stats.passes) {
            if (pass.name != std::string("lighting.") + row.technique) continue;
            CHECK(pass.draws == row.draws);
            CHECK(pass.stencilDraws == row.stencilDraws);
        }
    }
}

TEST_CASE("forward-multipass: draws for a light only the objects that it can touch, neighbours in one draw") {
    Scene scene;
    const Material material = lambertMaterial(scene);
    const uint32_t first = addObject(scene, quad(0.5f), material, glm::translate(mat4(1), vec3(-2, 0, 0)));
    for (int i = 0; i < 2; ++i) {
        scene.objects.push_back(scene.objects[first]);
        scene.objects.back().worldFromObject = glm::translate(mat4(1), vec3(2 * i, 0, 0));
    }
    for (uint32_t i = 0; i < 3; ++i) scene.objects[i].objectId = i + 1;
    scene.linkGroups = {{"the outer ones", {false, true, false, true}, {}}};
    Light outer = pointLight(vec3(0, 0, 1), vec3(1), 10);
    outer.linkGroup = 0;
    struct Row {
        const char* what;
        Light light;
        uint32_t draws;
        double objects;  ///< of the three
    };
    ValidatedRenderer renderer;
    const View view{frontCamera(), {60, 20}};
    const auto drawn = [&] {
        const Frame frame = renderer->render(view, {.lighting = "forward-multipass"}, kCounts);
        double sum = 0;
        for (const float value : frame.aovs.at("evaluations").data) sum += value;
        uint32_t draws = 0;
        for (const PassStats& pass : frame.stats.passes)
            if (pass.name == "lighting.forward-multipass") draws = pass.draws;
        return std::pair(draws, sum);
    };
    scene.lights = {directionalLight(vec3(0, 0, -1))};
    renderer->setScene(scene);
    const double all = drawn().second;
    REQUIRE(all > 0);
    const vec3 white(1);
    for (const Row& row : {Row{"everything", directionalLight(vec3(0, 0, -1)), 1, 3},
                           Row{"a ball around all", pointLight(vec3(0, 0, 1), white, 10), 1, 3},
                           Row{"a ball before the middle one", pointLight(vec3(0, 0, 1), white, 1.2f), 1, 1},
                           Row{"a link group", outer, 2, 2},
                           Row{"a ball behind the eye", pointLight(vec3(0, 0, 100), white, 10), 0, 0},
                           Row{"a ball that reaches nothing", pointLight(vec3(-1, 0, 0), white, 0.3f), 0, 0},
                           Row{"a cone on the left one", spotLight(vec3(-2, 0, 2), vec3(0, 0, -1), 0.1f, 0.2f, white, 10), 1, 1},
                           Row{"a cone that looks away", spotLight(vec3(0, 0, 1), vec3(0, 0, 1), 0.5f, 1, white, 10), 0, 0}}) {
        INFO(std::string(row.what));
        scene.lights = {row.light};
        renderer->setScene(scene);
        const auto [draws, evaluations] = drawn();
        CHECK(draws == row.draws);
        CHECK(evaluations <= all * row.objects / 3);
    }
}

TEST_CASE("light links: the last of 4,096 groups and the last of 65,536 objects are told apart by every technique") {
    Scene scene;
    const Material material = lambertMaterial(scene);
    addObject(scene, quad(1), material, glm::translate(mat4(1), vec3(-1, 0, 0)));
    addObject(scene, quad(1), material, glm::translate(mat4(1), vec3(1, 0, 0)));
    scene.objects[0].objectId = kMaxObjectId - 1;
    scene.objects[1].objectId = kMaxObjectId;
    scene.linkGroups.resize(kMaxLinkGroups);
    scene.linkGroups.back().litObjects.resize(kMaxObjectId + 1);
    scene.linkGroups.back().litObjects[kMaxObjectId] = true;
    scene.lights = {pointLight(vec3(0, 0, 1), vec3(5), 4), directionalLight(vec3(0, 0, -1))};
    for (Light& light : scene.lights) light.linkGroup = kMaxLinkGroups - 1;
    validate(scene);
    ValidatedRenderer renderer;
    renderer->setScene(scene);
    for (const auto& technique : render::techniques()) {
        INFO(technique.info.name);
        const Frame frame = renderer->render({frontCamera(), {20, 10}}, {.lighting = std::string(technique.info.name)}, kCounts);
        CHECK(frame.radiance.at(6, 5, 0) == 0);
        CHECK(frame.aovs.at("useful-evaluations").at(6, 5, 0) == 0);
        CHECK(frame.radiance.at(13, 5, 0) > 0.3f);
        CHECK(frame.aovs.at("useful-evaluations").at(13, 5, 0) == 2);
    }
}

TEST_CASE("volume-instanced: what the host records does not depend on the number of lights") {
    ValidatedRenderer renderer;
    Scene scene = studio().scene;
    uint32_t draws = 0;
    for (const size_t count : {10, 1000}) {
        scene.lights.assign(count, pointLight(vec3(0, 1, 0), vec3(1), 2));
        renderer->setScene(scene);
        const Frame frame = renderer->render({studio().view.camera, {16, 12}}, {.lighting = "volume-instanced"});
        uint32_t sum = 0;
        for (const PassStats& pass : frame.stats.passes) sum += pass.draws;
        if (draws != 0) CHECK(sum == draws);
        draws = sum;
    }
}
