#include <fmt/format.h>
#include <luciole/error.hpp>
#include <luciole/reference.hpp>
#include <luciole/scene_io.hpp>

#include "device.hpp"
#include "random_scenes.hpp"
#include "reference/camera_rays.hpp"
#include "render/shadow/shadow_plan.hpp"
#include "scene/visibility.hpp"
#include "scene_building.hpp"
#include "scenes.hpp"
#include "support.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

constexpr RenderSettings kMaps{.shadows = Shadows::maps};

RenderSettings with(ShadowFilter filter, std::string lighting = "brute-force") {
    RenderSettings settings{.lighting = std::move(lighting), .shadows = Shadows::maps};
    settings.shadowFilter = filter;
    return settings;
}

/// The maps that a frame gets.
class PlannedShadows {
public:
    PlannedShadows(const Scene& scene, const View& view, const RenderSettings& settings) : eye_(view.camera.worldFromView[3]) {
        std::vector<render::ShadowCaster> casters;
        for (const Object& object : scene.objects) {
            const Material& material = scene.materials[object.material];
            if (!isDrawn(object) || material.alphaMode == AlphaMode::blend) continue;
            Bounds bounds{vec3(HUGE_VALF), vec3(-HUGE_VALF)};
            for (const Vertex& vertex : scene.meshes[object.mesh].vertices) {
                const vec3 p(object.worldFromObject * vec4(vertex.position, 1));
                bounds = {glm::min(bounds.low, p), glm::max(bounds.high, p)};
            }
            casters.push_back({bounds, object.objectId, material.castsShadows});
        }
        plan_.update({.view = view,
                      .settings = settings,
                      .lights = scene.lights,
                      .casters = casters,
                      .boundsWorld = boundsOf(scene),
                      .castsFor = [](uint32_t, uint32_t) { return true; },
                      .largestSide = 16384,
                      .version = 0});
    }

    const std::vector<render::PlannedMap>& maps() const { return plan_.maps(); }

    /// How large a texel of a map is where a position is, metres; 0 where the map does not reach.
    double texelOf(const render::PlannedMap& map, dvec3 P) const {
        const auto constants = render::ShadowPlan::constants(map, 1, eye_);
        const render::ShadowFrustum& f = map.frustum;
        const double w = f.orthographic ? 1 : dot(f.forward, P - f.origin);
        const dvec2 at = double(constants.scale) / w * dvec2(dot(f.right, P - f.origin), dot(f.down, P - f.origin));
        if (constants.page == 0 || w <= 0 || std::max(std::abs(at.x), std::abs(at.y)) > 0.5 * map.page.side - 0.5) return 0;
        return w / double(constants.scale);
    }

    /// That of the largest of a light's maps that reach there.
    double texelAt(uint32_t light, dvec3 P) const {
        double texel = 0;
        for (const render::PlannedMap& map : maps())
            if (map.light == light) texel = std::max(texel, texelOf(map, P));
        return texel;
    }

private:
    dvec3 eye_;
    render::ShadowPlan plan_;
};

/// Says of pixels whether a shadow's edge passes within two texels of where they are, by rays from the places around.
class EdgeBand {
public:
    EdgeBand(const Scene& scene, const View& view, const RenderSettings& settings)
        : scene_(scene), rays_(view), visibility_(scene), shadows_(scene, view, settings) {}

    bool holds(uint32_t x, uint32_t y) const {
        const reference::Ray ray = rays_.through(x, y);
        const auto seen = [&](const Hit& hit) { return material(hit).alphaMode != AlphaMode::blend; };
        const auto hit = visibility_.closest(ray.origin, ray.direction, rays_.nearest(), seen);
        if (!hit) return false;
        const dvec3 P = ray.origin + hit->t * ray.direction;
        return std::ranges::any_of(shadows_.maps(), [&](const render::PlannedMap& map) { return hasEdge(map, *hit, P); });
    }

private:
    const Material& material(const Hit& hit) const { return scene_.materials[scene_.objects[hit.object].material]; }

    dvec3 normalOf(const Hit& hit) const {
        const auto corners = visibility_.triangleWorld(hit.object, hit.triangle);
        return normalize(cross(corners[1] - corners[0], corners[2] - corners[0]));
    }

    /// As the reference does, but that masks are whole.
    bool isShadowed(const Hit& receiver, dvec3 P, dvec3 L, const Light& light) const {
        const dvec3 N = normalOf(receiver), up = dot(N, L) < 0 ? -N : N;
        const auto casts = [&](const Hit& hit) {
            if (!material(hit).castsShadows || material(hit).alphaMode == AlphaMode::blend || (hit.object == receiver.object && hit.triangle == receiver.triangle)) return false;
            return std::ranges::any_of(visibility_.triangleWorld(hit.object, hit.triangle), [&](dvec3 corner) { return dot(up, corner - P) > 1e-6 * length(P); });
        };
        if (light.type == LightType::directional) return visibility_.isBlocked(P, -dvec3(light.directionWorld), HUGE_VAL, casts);
        return visibility_.isBlocked(P, dvec3(light.positionWorld) - P, 1, casts);
    }

    bool hasEdge(const render::PlannedMap& map, const Hit& receiver, dvec3 P) const {
        const Light& light = scene_.lights[map.light];
        const bool directional = light.type == LightType::directional;
        const double texel = shadows_.texelOf(map, P);
        if (texel == 0) return false;
        if (!directional && distance(P, dvec3(light.positionWorld)) > double(light.range)) return false;
        const dvec3 L = directional ? -dvec3(light.directionWorld) : normalize(dvec3(light.positionWorld) - P);
        const double cosine = dot(L, normalOf(receiver));
        const bool here = isShadowed(receiver, P, L, light);
        for (const double reach : {1.0, 2.0})
            for (int i = 0; i < 8; ++i) {
                const double angle = i * kPi / 4;
                const dvec3 aside = reach * texel * (std::cos(angle) * map.frustum.right + std::sin(angle) * map.frustum.down);
                // Where the same surface is there, as the light sees it; if it is not, its own edge is near.
                const double height = 4 * texel / std::max(std::abs(cosine), 0.05);
                const auto there = visibility_.closest(P + aside + height * L, -L, 0, [&](const Hit& hit) { return hit.object == receiver.object; });
                if (!there || there->t > 2 * height) {
                    if (cosine > 0) return true;
                    continue;
                }
                if (isShadowed(*there, P + aside + (height - there->t) * L, L, light) != here) return true;
            }
        return false;
    }

    const Scene& scene_;
    reference::CameraRays rays_;
    Visibility visibility_;
    PlannedShadows shadows_;
};

/// Checks hard shadows against the reference's: how much light they leave differs by 5 % of it at no more than a thousandth of the pixels
/// that lie farther than two texels from a shadow's edge.
void checkHardShadows(ValidatedRenderer& renderer, const TestScene& test, const std::string& lighting) {
    INFO("scene: " << test.name << ", technique: " << lighting);
    const Frame reference = renderReference(test.scene, test.view, kMaps, {"id", "material", "depth"});
    const std::vector<double> expected = litShares(reference.radiance, renderReference(test.scene, test.view, {}).radiance);
    renderer->setScene(test.scene);
    const RenderSettings settings = with(ShadowFilter::point, lighting);
    const std::vector<double> found =
        litShares(renderer->render(test.view, settings).radiance, renderer->render(test.view, {.lighting = lighting}).radiance);
    const auto mask = interior(reference);
    const EdgeBand band(test.scene, test.view, settings);
    size_t compared = 0, shadowed = 0, differ = 0, wrong = 0, sampled = 0, inBand = 0;
    std::string where;
    for (uint32_t y = 0; y < test.view.extent.y; ++y)
        for (uint32_t x = 0; x < test.view.extent.x; ++x) {
            const size_t i = size_t(y) * test.view.extent.x + x;
            if (!mask[i]) continue;
            ++compared;
            shadowed += expected[i] < 0.95;
            if (i % 29 == 0) ++sampled, inBand += band.holds(x, y);
            if (std::abs(found[i] - expected[i]) <= 0.05) continue;
            ++differ;
            if (band.holds(x, y)) continue;
            ++wrong;
            if (wrong <= 8) where += fmt::format(" ({}, {}): {:.2f}, not {:.2f}", x, y, found[i], expected[i]);
        }
    INFO("compared " << compared << ", shadowed " << shadowed << ", differ " << differ << ", of them away from edges " << wrong << where << "; of " << sampled << " pixels by an edge " << inBand);
    CHECK(compared > 1000);
    CHECK(shadowed > compared / 20);
    CHECK(double(inBand) < 0.7 * double(sampled));  // or nothing was tested
    CHECK(double(wrong) <= 1e-3 * (1 - double(inBand) / double(sampled)) * double(compared));
}

}  // namespace

TEST_CASE("shadow maps: hard shadows are the reference's but for two texels at their edges, on scenes with every type of light") {
    ValidatedRenderer renderer;
    for (const char* uri : {"builtin:hall?lights=16", "builtin:materials", "builtin:fireflies?lights=20"})
        for (const char* lighting : {"brute-force", "forward-loop"}) checkHardShadows(renderer, builtin(uri, {320, 240}), lighting);
}

TEST_CASE("shadow maps: hard shadows are the reference's on real assets, too") {
    LUCIOLE_ASSETS_OR_SKIP(folder);
    const std::filesystem::path rigs = std::filesystem::path(LUCIOLE_SOURCE_DIR) / "examples" / "rigs";
    ValidatedRenderer renderer;
    struct Asset {
        const char *file, *rig;
    };
    for (const Asset& asset : {Asset{"Sponza/Sponza.gltf", "sponza.json"}, Asset{"CastlePunctualLights/test_lights.glb", nullptr}}) {
        Scene scene = loadScene((folder / asset.file).string());
        if (asset.rig) applyRig(scene, rigs / asset.rig);
        const Camera camera = scene.cameras.empty() ? autoCamera(scene) : scene.cameras.back();
        for (const char* lighting : {"brute-force", "forward-loop"}) checkHardShadows(renderer, {asset.file, scene, {camera, {320, 240}}}, lighting);
    }
}

TEST_CASE("shadow maps: each technique gives the shadows of its yardstick, with every filter") {
    ValidatedRenderer renderer;
    const std::map<std::string, ShadowFilter> chosen{
        {"studio", ShadowFilter::smooth}, {"glass", ShadowFilter::jittered}, {"bounded lights", ShadowFilter::point}};
    for (const TestScene& test : testScenes()) {
        if (!chosen.contains(test.name)) continue;
        const ShadowFilter filter = chosen.at(test.name);
        INFO("scene: " << test.name << ", filter: " << int(filter));
        renderer->setScene(test.scene);
        const View view{test.view.camera, {96, 72}};
        const Image dark = renderer->render(view, with(filter)).radiance, lit = renderer->render(view, {}).radiance;
        CHECK(difference(dark, lit).mean > 0.002);  // there are shadows
        Yardsticks yardsticks(renderer, view, with(filter));
        for (const auto& technique : render::techniques()) {
            INFO("technique: " << technique.info.name);
            const Frame& yardstick = yardsticks.of(technique);
            const Frame frame = renderer->render(view, with(filter, std::string(technique.info.name)));
            checkAlike(technique, frame.radiance, yardstick.radiance, yardsticks.comparable(technique, test.scene), test.scene.lights.size());
        }
    }
}

TEST_CASE("shadows: among more lights than a uniform buffer holds each has its own") {
    Scene few = whiteRoom();
    addObject(few, quad(1), lambertMaterial(few));
    Dice dice(1300);
    addManyLights(few, dice, 60, 4);
    Scene many = few;
    many.lights.clear();
    addManyLights(many, dice, shared::kUniformLights, 4);
    for (Light& light : many.lights) light.color = vec3(0);
    many.lights.insert(many.lights.end(), few.lights.begin(), few.lights.end());
    ValidatedRenderer renderer;
    for (const Shadows kind : {Shadows::maps, Shadows::volumes}) {
        INFO("shadows " << int(kind));
        const RenderSettings settings{.lighting = "clustered", .shadows = kind};
        const Frame expected = renderer.render(few, kRoomView, settings), found = renderer.render(many, kRoomView, settings);
        CHECK(found.stats.shadows->lights == expected.stats.shadows->lights);
        CHECK(difference(found.radiance, expected.radiance).max < 1e-5);
        CHECK(difference(found.radiance, renderer.render(few, kRoomView, {.lighting = "clustered"}).radiance).mean > 0.02);
    }
}

TEST_CASE("shadow maps: planes at grazing angles are lit to the last pixel, whatever the light, the filter and the technique") {
    for (const float degrees : {0.5f, 2.0f, 5.0f, 20.0f, 45.0f, 80.0f}) {
        INFO("angle to the plane: " << degrees << " degrees");
        const TestScene test = tiledFloor(degrees);
        ValidatedRenderer renderer;
        renderer->setScene(test.scene);
        for (const auto filter : {ShadowFilter::point, ShadowFilter::jittered, ShadowFilter::smooth})
            for (const char* lighting : {"brute-force", "forward-loop", "clustered"}) {
                INFO("filter " << int(filter) << ", " << lighting);
                const std::vector<double> shares =
                    litShares(renderer->render(test.view, with(filter, lighting)).radiance, renderer->render(test.view, {.lighting = lighting}).radiance);
                CHECK(std::ranges::count_if(shares, [](double share) { return share < 0.999; }) == 0);
            }
    }
}

// A wall of no thickness on a floor hides a strip behind it from a light; where it meets the floor, bias and filter let light leak.
TEST_CASE("shadow maps: light leaks under what stands on a floor no farther than is stated") {
    ValidatedRenderer renderer;
    for (const float degrees : {15.0f, 30.0f, 50.0f, 70.0f})
        for (const LightType type : {LightType::directional, LightType::spot, LightType::point}) {
            INFO("light type " << int(type) << ", " << degrees << " degrees high");
            const float angle = glm::radians(degrees);
            const vec3 towards(0, -std::cos(angle), std::sin(angle));
            Scene scene;
            const Material white = lambertMaterial(scene);
            addObject(scene, quad(4), white);
            addObject(scene, quad(1), white, glm::translate(mat4(1), vec3(0, 0, 1)) * glm::rotate(mat4(1), float(kPi / 2), vec3(1, 0, 0)));
            scene.lights = {type == LightType::directional ? directionalLight(-towards)
                            : type == LightType::spot      ? spotLight(6.0f * towards, -towards, 0.4f, 0.6f, vec3(30), 12)
                                                           : pointLight(6.0f * towards, vec3(30), 12)};
            const View view{frontOrthographicCamera(4, 1), {200, 200}};  // a pixel is a centimetre
            renderer->setScene(scene);
            const Image lit = renderer->render(view, {.lighting = "forward-loop"}).radiance;
            for (const auto& [filter, stated] : {std::pair{ShadowFilter::point, 2.0}, {ShadowFilter::jittered, 2.0}, {ShadowFilter::smooth, 3.5}}) {
                const RenderSettings settings = with(filter, "forward-loop");
                const std::vector<double> shares = litShares(renderer->render(view, settings).radiance, lit);
                const double texel = PlannedShadows(scene, view, settings).texelAt(0, dvec3(0));
                // The strip is wider than what is looked at; beside it lies the shadow's own edge.
                double farthest = 0;
                size_t hidden = 0;
                for (uint32_t y = 0; y < 100; ++y)
                    for (uint32_t x = 60; x < 140; ++x) {
                        const double behind = 0.01 * (99.5 - y);
                        if (behind > 0.8 / std::tan(double(angle))) continue;
                        ++hidden;
                        if (shares[200 * y + x] > 0.001) farthest = std::max(farthest, behind);
                    }
                INFO("filter " << int(filter) << ": light leaks " << farthest << " m, " << farthest / texel << " texels");
                CHECK(hidden > 2000);
                CHECK(farthest <= stated * texel);
            }
        }
}

TEST_CASE("shadow maps: with nothing moving the second frame draws none; what moved has its own drawn anew") {
    ValidatedRenderer renderer;
    TestScene test = builtin("builtin:hall?lights=24", {160, 120});
    renderer->setScene(test.scene);
    const RenderSettings settings{.lighting = "clustered", .shadows = Shadows::maps};
    const Frame first = renderer->render(test.view, settings);
    REQUIRE(first.stats.shadows);
    CHECK(first.stats.shadows->lights > 10);
    CHECK(first.stats.shadows->drawn == first.stats.shadows->maps);
    CHECK(first.stats.shadows->casterDraws > first.stats.shadows->maps / 2);
    CHECK(first.stats.shadows->bytes >= 4 * first.stats.shadows->texels);
    CHECK(first.stats.shadows->waiting.empty());
    CHECK(first.stats.shadows->lost.empty());
    const Frame second = renderer->render(test.view, settings);
    CHECK(second.stats.shadows->drawn == 0);
    CHECK(second.stats.shadows->casterDraws == 0);
    CHECK(second.stats.shadows->maps == first.stats.shadows->maps);
    CHECK(second.radiance.data == first.radiance.data);

    const uint32_t moved = 0;
    test.scene.lights[moved].positionWorld += vec3(0.1f, 0, 0.05f);
    renderer->setLights(test.scene.lights);
    const Frame third = renderer->render(test.view, settings);
    CHECK(third.stats.shadows->drawn >= 1);
    CHECK(third.stats.shadows->drawn <= 6);
    ValidatedRenderer fresh;
    CHECK(third.radiance.data == fresh.render(test.scene, test.view, settings).radiance.data);
    // Other techniques, filters and sizes of the picture that leave the maps as they are find them there.
    for (const char* lighting : {"brute-force", "light-indexed", "tiled"})
        for (const auto filter : {ShadowFilter::point, ShadowFilter::smooth}) CHECK(renderer->render(test.view, with(filter, lighting)).stats.shadows->drawn == 0);
    CHECK_FALSE(renderer->render(test.view, {.lighting = "brute-force"}).stats.shadows);
    CHECK(renderer->render(test.view, settings).stats.shadows->drawn == 0);
}

TEST_CASE("shadow maps: a budget of redraws comes to the same picture in the end, and says who waits until then") {
    ValidatedRenderer renderer, fresh;
    const TestScene test = builtin("builtin:hall?lights=12", {96, 72});
    RenderSettings settings = kMaps;
    const Frame whole = fresh.render(test.scene, test.view, settings);
    settings.shadowRedraws = 10;
    renderer->setScene(test.scene);
    uint32_t frames = 0;
    Frame frame;
    do {
        frame = renderer->render(test.view, settings);
        CHECK(frame.stats.shadows->drawn <= 10);
    } while (!frame.stats.shadows->waiting.empty() && ++frames < 50);
    CHECK(frames == (whole.stats.shadows->maps - 1) / 10);
    CHECK(frame.radiance.data == whole.radiance.data);
}

TEST_CASE("shadow maps: what waits keeps the shadow that it had") {
    ValidatedRenderer renderer;
    Scene scene;
    const Material white = lambertMaterial(scene);
    for (const float x : {-3.0f, 3.0f}) {
        addObject(scene, quad(2), white, glm::translate(mat4(1), vec3(x, 0, 0)));
        addObject(scene, quad(0.5f), white, glm::translate(mat4(1), vec3(x, 0, 1)) * glm::rotate(mat4(1), float(kPi), vec3(1, 0, 0)));
    }
    const vec3 nearby(0, 0, 0.6f);
    const auto check = [&](const Light& light) {
        scene.lights = {light};
        renderer->setScene(scene);
        // The square on the right is nearer: its maps come first, and those on the left wait.
        scene.lights.push_back(light);
        scene.lights[1].positionWorld.x = 3;
        renderer->setLights(scene.lights);
        Camera camera;
        camera.worldFromView = lookAt(vec3(2, -7, 5), vec3(0, 0, 0));
        const View view{camera, {96, 72}};
        RenderSettings settings = with(ShadowFilter::point);
        const auto shares = [&](const Frame& frame, const RenderSettings& lit) { return litShares(frame.radiance, renderer->render(view, lit).radiance); };
        const std::vector<double> before = shares(renderer->render(view, settings), {});
        for (Light& moved : scene.lights) moved.positionWorld += nearby;
        renderer->setLights(scene.lights);
        settings.shadowRedraws = light.type == LightType::spot ? 1 : 6;
        const Frame frame = renderer->render(view, settings);
        CHECK(frame.stats.shadows->waiting.size() == 1);
        CHECK(frame.stats.shadows->waiting[0].light == 0);
        const std::vector<double> after = shares(frame, {});
        size_t left = 0, differ = 0;
        for (size_t i = 0; i < after.size(); ++i) {
            if (i % 96 >= 40) continue;  // the left half
            ++left;
            differ += std::abs(after[i] - before[i]) > 0.01;
        }
        INFO("of " << left << " pixels " << differ << " differ");
        CHECK(differ < left / 100);
    };
    check(spotLight(vec3(-3, 0, 2), vec3(0, 0, -1), 0.5f, 0.9f, vec3(5)));
    check(pointLight(vec3(-3, 0, 2), vec3(5), 3.9f));
}

TEST_CASE("shadow maps: too little memory makes them coarser, then leaves lights without, by name, or is refused") {
    ValidatedRenderer renderer;
    TestScene test = builtin("builtin:hall?lights=400", {320, 240});
    renderer->setScene(test.scene);
    RenderSettings settings{.lighting = "clustered", .shadows = Shadows::maps, .shadowMemory = 1};
    const Frame frame = renderer->render(test.view, settings);
    CHECK(frame.stats.shadows->coarser > 0);
    CHECK(frame.stats.shadows->bytes <= 1u << 20);
    REQUIRE(!frame.stats.shadows->lost.empty());
    // A light that is lost shines as if nothing kept it off.
    for (const auto& without : frame.stats.shadows->lost) test.scene.lights[without.light].castsShadows = false;
    ValidatedRenderer fresh;
    settings.onOverflow = OnOverflow::fail;
    CHECK(fresh.render(test.scene, test.view, settings).radiance.data == frame.radiance.data);
    CHECK_THROWS_WITH_AS(renderer->render(test.view, settings), doctest::Contains("\"lamp "), Error);
    settings.shadowMemory = 256;
    CHECK(renderer->render(test.view, settings).stats.shadows->lost.empty());
}

TEST_CASE("shadow maps: degenerate lights, views and scenes give finite pictures") {
    ValidatedRenderer renderer;
    const auto checkFinite = [&](const Scene& scene, const View& view) {
        renderer->setScene(scene);
        for (const auto filter : {ShadowFilter::point, ShadowFilter::smooth}) {
            const Frame frame = renderer->render(view, with(filter));
            CHECK(std::ranges::all_of(frame.radiance.data, [](float value) { return std::isfinite(value); }));
        }
    };
    Scene scene;
    const Material white = lambertMaterial(scene);
    addObject(scene, quad(2), white);
    addObject(scene, sphere(0.3f), white, glm::translate(mat4(1), vec3(0, 0, 0.5f)));
    const View view{frontCamera(3), {40, 30}};
    const float tiny = std::numeric_limits<float>::denorm_min();
    const vec3 eye(0, 0, 3);
    scene.lights = {pointLight(vec3(0, 0, 1), vec3(1), tiny), pointLight(vec3(0, 0, 0)),  // in the wall
                    pointLight(vec3(0, 0, 0.5f)), pointLight(eye), pointLight(vec3(0, 0, 0.2f), vec3(1), 1e30f),
                    spotLight(vec3(1, 0, 2), vec3(0, 0, -1), 0, 1e-6f), spotLight(vec3(1, 0, 2), vec3(0, 0, -1), 0, float(kPi)),
                    spotLight(eye, vec3(0, 0, -1), 0, float(kPi / 2)), directionalLight(vec3(0, 1, 0)), directionalLight(vec3(0, 0, 1)),
                    pointLight(vec3(0, 0, 1), vec3(0))};
    scene.lights.front().shadowSoftness = 0, scene.lights.back().shadowSoftness = 4;
    checkFinite(scene, view);
    for (const uvec2 extent : {uvec2(1, 1), uvec2(1, 4096), uvec2(4096, 1), uvec2(97, 89)}) checkFinite(scene, {frontCamera(3), extent});
    checkFinite(scene, {frontOrthographicCamera(3, 2), {40, 30}});
    Scene dark = scene;
    dark.lights.clear();
    checkFinite(dark, view);
    Scene bare;
    bare.lights = scene.lights;
    checkFinite(bare, view);
}

TEST_CASE("shadow maps: masks cut them out; materials, lights and link groups say who casts") {
    ValidatedRenderer renderer;
    // As in the reference's test: a square over a floor, which shows the camera its back.
    Scene scene;
    addObject(scene, quad(1), lambertMaterial(scene));
    addObject(scene, quad(0.25f), {}, glm::translate(mat4(1), vec3(0, 0, 1)) * glm::rotate(mat4(1), float(kPi), vec3(1, 0, 0)));
    scene.lights = {pointLight(vec3(0, 0, 2), vec3(5))};
    const View view{frontOrthographicCamera(3, 1), {64, 64}};
    const auto darkShare = [&](const Scene& changed) {
        const Frame frame = renderer.render(changed, view, with(ShadowFilter::point, "forward-loop"));
        return double(std::ranges::count(frame.radiance.data, 0.0f)) / double(frame.radiance.data.size());
    };
    const double edge = 4 * 32.0 / (64 * 64);  // as many pixels as the shadow's edge is long
    CHECK(std::abs(darkShare(scene) - 0.25) < 2 * edge);
    Scene masked = scene;
    masked.materials[1].alphaMode = AlphaMode::mask;
    masked.materials[1].baseColorTexture =
        addTexture(masked, 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}, {.magFilter = Filter::nearest, .minFilter = Filter::nearest, .mipFilter = MipFilter::none});
    CHECK(std::abs(darkShare(masked) - 0.125) < 2 * edge);
    Scene other = scene;
    other.lights[0].castsShadows = false;
    CHECK(darkShare(other) == 0);
    other = scene;
    other.materials[1].castsShadows = false;
    CHECK(darkShare(other) == 0);
    other = scene;
    other.linkGroups = {{"floor only", {true, true}, {true}}};
    other.lights[0].linkGroup = 0;
    CHECK(darkShare(other) == 0);
    // Front faces alone cast, or back faces: the square shows the light its back, too.
    RenderSettings settings = with(ShadowFilter::point, "forward-loop");
    settings.shadowCasters = ShadowCasters::backFaces;
    CHECK(renderer.render(scene, view, settings).radiance.data == renderer.render(scene, view, with(ShadowFilter::point, "forward-loop")).radiance.data);
    settings.shadowCasters = ShadowCasters::frontFaces;
    CHECK(renderer.render(scene, view, settings).radiance.data == renderer.render(scene, view, {.lighting = "forward-loop"}).radiance.data);
}

TEST_CASE("shadow maps: objects that move have redrawn only the maps that they cast into, and of these only themselves") {
    ValidatedRenderer renderer, fresh;
    TestScene test = builtin("builtin:hall?lights=24", {160, 120});
    const RenderSettings settings{.lighting = "clustered", .shadows = Shadows::maps};
    renderer->setScene(test.scene);
    const Frame before = renderer->render(test.view, settings);
    // A column, which few lamps reach.
    const auto named = [&](const std::string& part) {
        return uint32_t(std::ranges::find_if(test.scene.objects, [&](const Object& object) { return object.name.find(part) != std::string::npos; }) - test.scene.objects.begin());
    };
    const uint32_t column = named("column left 1");
    REQUIRE(column < test.scene.objects.size());
    uint32_t draws = 0;
    for (int step = 0; step < 3; ++step) {
        mat4& place = test.scene.objects[column].worldFromObject;
        place = glm::translate(mat4(1), vec3(0.15f, 0, 0.1f)) * place;
        const MovedObject moved{column, place};
        renderer->moveObjects(std::span(&moved, 1));
        const Frame frame = renderer->render(test.view, settings);
        CHECK(frame.stats.shadows->drawn > 0);
        CHECK(frame.stats.shadows->drawn < frame.stats.shadows->maps / 2);
        if (step == 0) draws = frame.stats.shadows->casterDraws;
        else CHECK(frame.stats.shadows->casterDraws <= 4 * frame.stats.shadows->drawn);  // a column is of few parts
        CHECK(frame.radiance.data == fresh.render(test.scene, test.view, settings).radiance.data);
        CHECK(frame.radiance.data != before.radiance.data);
        CHECK(renderer->render(test.view, settings).stats.shadows->drawn == 0);
    }
    CHECK(draws > 0);
}
