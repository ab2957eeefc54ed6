#include <luciole/error.hpp>
#include <luciole/reference.hpp>
#include <luciole/scene_io.hpp>

#include "device.hpp"
#include "random_scenes.hpp"
#include "scenes.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

const std::vector<std::string> kCounts{"evaluations", "useful-evaluations", "light-fingerprint"};
constexpr const char* kListed[] = {"tiled", "tiled-points", "clustered", "clustered-forward"};

/// A pane that lets light through, before some of its walls.
void addGlass(Scene& scene) {
    Material glass = scene.materials[0];
    glass.alphaMode = AlphaMode::blend;
    glass.baseColor.a = 0.5f;
    addObject(scene, quad(1), glass, glm::translate(mat4(1), vec3(0.5f, 0, 1)));
}

}  // namespace

TEST_CASE("light lists: of 20,000 lights the techniques give the reference's picture") {
    Scene scene = whiteRoom();
    Dice dice(20000);
    addManyLights(scene, dice, 20000, 1);
    const Frame reference = renderReference(scene, kRoomView, {}, {"id", "material", "depth"});
    const std::vector<bool> mask = interior(reference);
    ValidatedRenderer renderer;
    renderer->setScene(scene);
    for (const char* technique : kListed) {
        INFO(std::string(technique));
        const Frame frame = renderer->render(kRoomView, {.lighting = technique});
        const ErrorSummary radiance = difference(frame.radiance, reference.radiance, &mask);
        CHECK(radiance.share > 0.5);
        // Normals turn by 2.2e-5 in a G-buffer, half a step of 2 / 65535 in each coordinate, and light by that times the tangent of its angle.
        CHECK(radiance.max <= 1e-4);
        CHECK(frame.stats.lightLists->entries > 20000);
    }
}

namespace {

/// Checks that the techniques light what brute force and the loop light, and by the same lights. \return the pages of their lists
uint32_t checkAgainstYardsticks(ValidatedRenderer& renderer, const Scene& scene, const View& view, const RenderSettings& settings = {}) {
    renderer->setScene(scene);
    Yardsticks yardsticks(renderer, view, settings, kCounts);
    uint32_t pages = 0;
    for (const char* name : kListed) {
        INFO(std::string(name));
        const render::LightingTechnique& technique = render::techniqueNamed(name);
        if (settings.msaa != Msaa::x1 && !technique.samples) continue;
        RenderSettings own = settings;
        own.lighting = name;
        const Frame frame = renderer->render(view, own, kCounts);
        const Frame& yardstick = yardsticks.of(technique);
        size_t wrong = 0;
        const std::vector<float>& useful = yardstick.aovs.at("useful-evaluations").data;
        for (size_t i = 0; i < useful.size(); ++i) {
            wrong += frame.aovs.at("useful-evaluations").data[i] != useful[i];
            if (useful[i] <= 4096) wrong += frame.aovs.at("light-fingerprint").data[i] != yardstick.aovs.at("light-fingerprint").data[i];
        }
        CHECK(wrong == 0);
        // Sums of n positive terms in any order differ by at most 2 n units of roundoff; those of lights that do not reach are zero.
        const double terms = *std::ranges::max_element(useful) + 1;
        const ErrorSummary radiance = difference(frame.radiance, yardstick.radiance);
        CHECK(radiance.max <= std::min(1e-4, 2 * terms * std::exp2(-24)));
        pages = std::max(pages, frame.stats.lightLists->pages);
    }
    return pages;
}

}  // namespace

TEST_CASE("light lists: of 70,000 lights, more than a loop goes through, none is lost") {
    Scene scene = whiteRoom();
    Dice dice(70000);
    addManyLights(scene, dice, 70000, 0.5f);
    ValidatedRenderer renderer;
    checkAgainstYardsticks(renderer, scene, {kRoomView.camera, {24, 18}});
}

TEST_CASE("light lists: 40,000 lights that cover every pixel are used in several pages, on surfaces that blend, too") {
    Scene scene = whiteRoom();
    addGlass(scene);
    Dice dice(40000);
    for (int i = 0; i < 40000; ++i) scene.lights.push_back(pointLight(dice.place(1.9f), vec3(1), i % 2 == 0 ? 20.0f : std::numeric_limits<float>::infinity()));
    ValidatedRenderer renderer;
    CHECK(checkAgainstYardsticks(renderer, scene, {kRoomView.camera, {16, 12}}) == 2);
}

TEST_CASE("light lists: lights that large meshes bound are more work than one loop does, and none is lost") {
    Scene scene = whiteRoom();
    Dice dice(200);
    scene.lightVolumes = {torus(1.5f, 1.2f, 20, 10, mat4(1))};  // 400 triangles
    for (int i = 0; i < 200; ++i) {
        scene.lights.push_back(pointLight(dice.place(1.9f), vec3(1), 10));
        scene.lights.back().volume = 0;
    }
    ValidatedRenderer renderer;
    CHECK(checkAgainstYardsticks(renderer, scene, {kRoomView.camera, {16, 12}}) > 1);
}

TEST_CASE("light lists: with every size of tile, at odd sizes, in perspective and not, the techniques equal their yardsticks") {
    ValidatedRenderer renderer;
    Scene scene = whiteRoom();
    addGlass(scene);
    Dice dice(60);
    addManyLights(scene, dice, 60, 3);
    for (const auto tileSize : {TileSize::n8, TileSize::n16, TileSize::n32})
        for (const Camera& camera : {kRoomView.camera, frontOrthographicCamera(6, 1.5f)})
            for (const uvec2 extent : {uvec2(1, 1), uvec2(1, 67), uvec2(61, 43)}) {
                INFO("tile size " << int(tileSize) << ", " << extent.x << "x" << extent.y << (camera.orthographic ? ", orthographic" : ""));
                checkAgainstYardsticks(renderer, scene, {camera, extent}, {.tileSize = tileSize});
            }
}

TEST_CASE("light lists: over random views surfaces that blend and four samples a pixel get the lights that they get in a loop") {
    ValidatedRenderer renderer;
    for (int s = 0; s < 12; ++s) {
        Dice dice(uint64_t(s) + 5000);
        Scene scene = randomRoom(dice);
        for (size_t i = 0; i < scene.materials.size(); i += 2) {
            scene.materials[i].alphaMode = AlphaMode::blend;
            scene.materials[i].baseColor.a = 0.5f;
        }
        const uvec2 extent(1 + dice.below(60), 1 + dice.below(60));
        std::vector<View> views;
        for (int v = 0; v < 10; ++v) views.push_back({randomCamera(dice), extent});
        for (size_t i = 0; i < 40; ++i) {
            const mat4& place = views[i % views.size()].camera.worldFromView;
            scene.lights.push_back(randomLight(dice, vec3(place[3]), -vec3(place[2])));
        }
        renderer->setScene(scene);
        for (const Msaa msaa : {Msaa::x1, Msaa::x4})
            for (size_t v = 0; v < views.size(); ++v) {
                INFO("scene " << s << ", view " << v << ", msaa " << int(msaa));
                const auto render = [&](const char* technique) {
                    return renderer->render(views[v], {.lighting = technique, .msaa = msaa, .tileSize = TileSize(1 + s % 3)}, kCounts);
                };
                const Frame loop = render("forward-loop"), listed = render("clustered-forward");
                for (const char* count : {"useful-evaluations", "light-fingerprint"}) CHECK(listed.aovs.at(count).data == loop.aovs.at(count).data);
            }
    }
}

TEST_CASE("light lists: ten runs give the same picture, bit for bit") {
    ValidatedRenderer renderer;
    const Scene scene = loadScene("builtin:hall?lights=1000");
    renderer->setScene(scene);
    const View view{scene.cameras.at(0), {160, 120}};
    for (const char* technique : kListed) {
        INFO(std::string(technique));
        const Frame first = renderer->render(view, {.lighting = technique});
        for (int run = 0; run < 9; ++run) CHECK(renderer->render(view, {.lighting = technique}).radiance.data == first.radiance.data);
    }
}

TEST_CASE("light lists: without lights there is ambience, and a light at the eye lights all that it reaches") {
    ValidatedRenderer renderer;
    Scene scene = whiteRoom();
    scene.ambience = {vec3(0.5f), vec3(0.5f)};
    for (Material& material : scene.materials) material.shaped.kAmbient = vec3(1);
    for (const char* technique : kListed) {
        INFO(std::string(technique));
        const Frame frame = renderer.render(scene, {kRoomView.camera, {20, 15}}, {.lighting = technique});
        CHECK(frame.radiance.at(10, 7, 0) == doctest::Approx(0.5));
        CHECK(frame.stats.lightLists->entries == 0);
        CHECK(frame.stats.lightLists->longest == 0);
    }
    scene.lights = {pointLight(vec3(kRoomView.camera.worldFromView[3]), vec3(10), 7)};
    checkAgainstYardsticks(renderer, scene, {kRoomView.camera, {20, 15}});
}

TEST_CASE("light lists: the layers list-length and list-slice tell of the lists that the pixels use") {
    ValidatedRenderer renderer;
    const Scene scene = loadScene("builtin:hall?lights=255");
    renderer->setScene(scene);
    const View view{scene.cameras.at(0), {80, 60}};
    for (const char* technique : kListed)
        for (const Msaa msaa : {Msaa::x1, Msaa::x4}) {
            if (msaa != Msaa::x1 && !render::techniqueNamed(technique).samples) continue;
            INFO(technique << ", msaa " << int(msaa));
            const bool clustered = std::string(technique).starts_with("clustered");
            const Frame frame = renderer->render(view, {.lighting = technique, .msaa = msaa}, {"list-length", "list-slice", "evaluations", "depth"});
            const Image &lengths = frame.aovs.at("list-length"), &slices = frame.aovs.at("list-slice"), &depth = frame.aovs.at("depth");
            // tiled-points fills up batches; several samples of a pixel are evaluated one by one.
            if (msaa == Msaa::x1 && !render::techniqueNamed(technique).points) CHECK(lengths.data == frame.aovs.at("evaluations").data);
            // A first sample need not lie in the cluster of the longest list.
            if (msaa != Msaa::x1) {
                CHECK(*std::ranges::max_element(lengths.data) > 0);
                CHECK(*std::ranges::max_element(lengths.data) <= float(frame.stats.lightLists->longest));
                continue;
            }
            CHECK(*std::ranges::max_element(lengths.data) == float(frame.stats.lightLists->longest));
            size_t wrong = 0;
            for (size_t i = 0; i < slices.data.size(); ++i) {
                // From the near plane on, four slices an octave, as the straight lines between powers of two of near / distance have it.
                const double ratio = depth.data[i] > 0 ? double(view.camera.zNear) / depth.data[i] : 0;
                int exponent = 0;
                const double mantissa = 2 * std::frexp(ratio, &exponent);
                const double expected = ratio == 0 ? -1 : clustered ? 4 * (1 - exponent) - std::floor(4 * (mantissa - 1)) : 0;
                const double nearby = 4 * (mantissa - 1) - std::round(4 * (mantissa - 1));
                wrong += slices.data[i] != expected && std::abs(nearby) > 1e-4;
            }
            CHECK(wrong == 0);
        }
    CHECK_THROWS_WITH_AS(renderer->render(view, {.lighting = "quad"}, {"list-length"}),
                         doctest::Contains("aov: list-length and list-slice expect a technique that makes lists of lights (tiled, tiled-points, clustered, clustered-forward), got \"quad\""), Error);
    CHECK_THROWS_WITH_AS(renderReference(scene, view, {}, {"list-slice"}), doctest::Contains("the reference makes no lists"), Error);
}

TEST_CASE("light lists: their layers add up the pages") {
    ValidatedRenderer renderer;
    Scene scene = whiteRoom();
    Dice dice(2);
    for (int i = 0; i < 40000; ++i) scene.lights.push_back(pointLight(dice.place(1.9f), vec3(1), 20));
    const Frame frame = renderer.render(scene, {kRoomView.camera, {16, 12}}, {.lighting = "clustered"}, {"list-length", "list-slice"});
    REQUIRE(frame.stats.lightLists->pages == 2);
    for (size_t i = 0; i < frame.aovs.at("list-length").data.size(); ++i) CHECK(frame.aovs.at("list-length").data[i] == (frame.aovs.at("list-slice").data[i] < 0 ? 0 : 40000));
}
