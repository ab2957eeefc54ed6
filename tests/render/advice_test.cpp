#include "render/advice/advice.hpp"

#include <luciole/error.hpp>
#include <numeric>

#include "device.hpp"
#include "io/temporary_folder.hpp"
#include "render/advice/calibration.hpp"
#include "render/advice/counts.hpp"
#include "render/driver_cache.hpp"
#include "scene_building.hpp"
#include "scenes.hpp"

using namespace luciole;
using namespace luciole::test;
using namespace luciole::render;

namespace {

/// Counts that differ from `i` to `i`, none of them a multiple of another.
SceneCounts someCounts(uint32_t i) {
    const auto vary = [&](uint32_t salt) { return double((i * 7919 + salt * 104729) % 97 + 3) / 20; };
    SceneCounts counts{.pixels = 50'000 * vary(1), .triangles = 20'000 * vary(2), .lights = std::floor(100 * vary(3))};
    counts.covered = counts.pixels * (0.2 + 0.16 * vary(4));
    counts.fragments = counts.covered * (1 + 0.3 * vary(5));
    counts.blended = i % 3 == 0 ? counts.pixels * 0.2 * vary(6) : 0;
    counts.visible = counts.lights * 0.2 * vary(7);
    counts.shapeTriangles = counts.visible * 100 * vary(8);
    counts.inRectangle = counts.pixels * 8 * vary(9);
    counts.behindNearest = counts.pixels * 6 * vary(10);
    counts.onShape = counts.pixels * 7 * vary(11);
    counts.behindFront = counts.pixels * 5 * vary(12);
    counts.beforeBack = counts.pixels * 5 * vary(13);
    counts.behindFace = counts.pixels * 4 * vary(14);
    counts.blendedBehindFront = counts.blended * 4 * vary(17);
    counts.surfaceBehindFront = counts.pixels * 3 * vary(15);
    counts.reaching = counts.pixels * 2 * vary(16);
    counts.inTile = counts.pixels * 4 * vary(18);
    counts.inCluster = counts.pixels * 3 * vary(19);
    counts.mostReaching = counts.mostBefore = i % 2 == 0 ? 3 : 30;
    return counts;
}

/// A coefficient for each that there is; all different.
Coefficients someCoefficients() {
    Coefficients coefficients;
    for (const CostModel& model : costModels())
        for (const CostTerm& term : model.terms)
            coefficients.emplace(term.coefficient, (1 + 0.1 * double(coefficients.size() % 11)) / std::max(1.0, term.count(someCounts(5), {}) + term.count(someCounts(6), {})));
    return coefficients;
}

std::vector<CostSample> samplesOf(const Coefficients& coefficients) {
    std::vector<CostSample> samples;
    for (uint32_t i = 0; i < 80; ++i)
        for (const CostModel& model : costModels())
            samples.push_back({std::string(model.technique), someCounts(i), *predictedMs(model.technique, someCounts(i), {}, coefficients)});
    return samples;
}

/// How far the predictions are from those of the coefficients, at counts that no sample has.
double worstError(const Coefficients& found, const Coefficients& known) {
    double worst = 0;
    for (uint32_t i = 1000; i < 1040; ++i)
        for (const CostModel& model : costModels())
            worst = std::max(worst, std::abs(*predictedMs(model.technique, someCounts(i), {}, found) / *predictedMs(model.technique, someCounts(i), {}, known) - 1));
    return worst;
}

const TechniqueAdvice& rowOf(const LightingAdvice& advice, std::string_view technique) {
    return *std::ranges::find(advice.techniques, technique, &TechniqueAdvice::technique);
}

std::string whyNotOf(const char* technique, const RenderSettings& settings, const Circumstances& circumstances = {.lights = 100}) {
    return whyNot(techniqueNamed(technique), settings, circumstances);
}

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("advice: the fit finds the coefficients that made the times") {
    const Coefficients known = someCoefficients();
    const Coefficients found = fit(samplesOf(known), {});
    for (const auto& [name, value] : known) {
        INFO(name);
        REQUIRE(found.contains(name));
        CHECK(found.at(name) >= 0);
        CHECK(found.at(name) == doctest::Approx(value).epsilon(0.02));
    }
    CHECK(worstError(found, known) < 1e-3);
}

TEST_CASE("advice: the fit bears with samples that something disturbed, and never makes work cost less than nothing") {
    const Coefficients known = someCoefficients();
    std::vector<CostSample> samples = samplesOf(known);
    for (size_t i = 0; i < samples.size(); i += 11) samples[i].ms *= 4;  // in turn those of each technique
    const Coefficients found = fit(samples, {});
    CHECK(worstError(found, known) < 0.02);
    // Times that fall with the number of lights.
    std::vector<CostSample> falling;
    for (uint32_t i = 1; i < 20; ++i) {
        SceneCounts counts{.pixels = 1000, .covered = 1000, .fragments = 1000, .triangles = 10, .lights = double(i)};
        falling.push_back({"brute-force", counts, 40 - double(i)});
    }
    for (const auto& [name, value] : fit(falling, {})) CHECK(value >= 0);
    CHECK(fit({}, {}).empty());
}

TEST_CASE("advice: coefficients come back from their line, and no other line passes") {
    const Coefficients known = someCoefficients();
    const auto back = coefficientsFrom(textOf(known));
    REQUIRE(back);
    CHECK(*back == known);
    for (const char* line : {"", "a", "a=", "=1", "a=1 b", "a=-1", "a=nan", "a=inf", "a=1e999", "a=1x", "a=1  b=2", "a=1 a=2"}) {
        INFO(line);
        CHECK_FALSE(coefficientsFrom(line));
    }
}

TEST_CASE("advice: each technique that may not be exact, or refuses the settings, says why") {
    CHECK(whyNotOf("light-prepass", {}) == "rounds normals to 16 bits");
    CHECK(whyNotOf("forward-multipass", {}) == "adds up surfaces that coincide");
    for (const auto& technique : techniques()) {
        const std::string name(technique.info.name);
        INFO(name);
        if (name == "light-prepass" || name == "forward-multipass") continue;
        CHECK(whyNotOf(name.c_str(), {}).empty());
        CHECK(has(whyNotOf(name.c_str(), {.msaa = Msaa::x4}), "one surface a pixel") == !technique.samples);
        CHECK(has(whyNotOf(name.c_str(), {.lightBuffer = LightBufferFormat::rgba16f}), "rgba16f") == technique.blendsLights);
        CHECK(has(whyNotOf(name.c_str(), {}, {.lights = 100, .bounce = true}), "the host looks at each light") == technique.onHost);
    }
    CHECK(has(whyNotOf("forward-loop", {.msaa = Msaa::x4}, {.samples = false}), "shades no samples"));
    CHECK(has(whyNotOf("tiled-points", {}, {.points = false}), "no points as large as a tile"));
    const char* indexed = "light-indexed";
    CHECK(has(whyNotOf(indexed, {.onOverflow = OnOverflow::priority}), "may lose lights"));
    CHECK(has(whyNotOf(indexed, {.onOverflow = OnOverflow::fail}), "may lose lights, or fail"));
    CHECK(whyNotOf(indexed, {.lidrPacking = LidrPacking::list, .onOverflow = OnOverflow::priority}).empty());
    CHECK(has(whyNotOf(indexed, {.overlap = 3}), "expected an overlap and indices out of"));
    CHECK(has(whyNotOf(indexed, {.lidrPacking = LidrPacking::cpuSort}, {.lights = 100, .bounce = true}), "the host sorts lights"));
    CHECK(whyNotOf(indexed, {.lidrPacking = LidrPacking::cpuSort}).empty());
    CHECK(has(whyNotOf(indexed, {.lidrShare = true}), "surfaces that coincide"));
    CHECK(has(whyNotOf(indexed, {.lidrShare = true}, {.lights = 100, .feedback = false}), "can't sample"));
}

TEST_CASE("advice: the fastest of those that may be chosen is, and all others are listed with their reason") {
    Coefficients costs = someCoefficients();
    for (auto& [name, value] : costs) value *= name.starts_with("quad.") ? 0 : 1;
    for (const char* better : {"deferred.frame", "deferred.pixel", "deferred.covered", "deferred.fragment", "deferred.triangle", "deferred.edge",
                               "deferred.blended", "deferred.blended-light"})
        costs[better] = 1e-9;
    const LightingAdvice advice = advise(someCounts(1), {}, {.lights = 100}, costs);
    CHECK(advice.technique == "quad");
    CHECK(advice.techniques.size() == techniques().size());
    CHECK(advice.techniques.front().technique == "quad");
    CHECK(has(advice.reason, "lighting auto: quad, "));
    CHECK(has(advice.reason, ", next "));
    CHECK(advice.reason.find('\n') == std::string::npos);
    for (size_t i = 1; i < advice.techniques.size(); ++i) {
        const TechniqueAdvice &row = advice.techniques[i], &before = advice.techniques[i - 1];
        CHECK(row.predictedMs.has_value() == row.whyNot.empty());
        if (row.predictedMs) CHECK(*row.predictedMs >= *before.predictedMs);
        if (!before.predictedMs) CHECK_FALSE(row.predictedMs);
    }
    // It blends.
    const LightingAdvice half = advise(someCounts(1), {.lightBuffer = LightBufferFormat::rgba16f}, {.lights = 100}, costs);
    CHECK(half.technique != "quad");
    CHECK(has(rowOf(half, "quad").whyNot, "rgba16f"));
    const LightingAdvice samples = advise(someCounts(1), {.msaa = Msaa::x4}, {.lights = 100}, costs);
    CHECK(techniqueNamed(samples.technique).samples);
}

TEST_CASE("advice: where nothing is known of the device, a technique without bounds is taken") {
    CHECK(advise(someCounts(1), {}, {.lights = 100}, {}).technique == "brute-force");
    CHECK(advise(someCounts(1), {.msaa = Msaa::x4}, {.lights = 100}, {}).technique == "forward-loop");
    const LightingAdvice advice = advise(someCounts(1), {}, {.lights = 100}, {});
    CHECK(rowOf(advice, "quad").whyNot == "its cost is not known");
    CHECK_THROWS_WITH_AS(advise(someCounts(1), {.msaa = Msaa::x4}, {.lights = 100, .samples = false}, {}), doctest::Contains("finds no technique"), Error);
}

TEST_CASE("advice: coefficients of fewer techniques than there are do not do") {
    Coefficients costs = someCoefficients();
    CHECK(coversModels(costs, {}));
    costs.erase("deferred.pixel");
    CHECK_FALSE(coversModels(costs, {}));
    CHECK(coversModels(costs, {.msaa = Msaa::x4}));  // deferred techniques have no part in it
}

TEST_CASE("advice: variants have keys of their own, and what is data none") {
    const auto key = [](const RenderSettings& settings, uint32_t equations = 3, bool uniform = true) { return CostVariant{settings, equations, uniform}.key(); };
    CHECK(key({}) == key({.lighting = "auto"}));
    for (const std::string& other : {key({}, 1), key({}, 3, false), key({.gbuffer = GBufferLayout::calver}), key({.msaa = Msaa::x4}), key({.overlap = 8})})
        CHECK(key({}) != other);
}

namespace {

/// A wall across the whole picture, `wall` metres before an orthographic eye that sees 4 x 4 m; 0: none.
SceneCounts countsOf(const std::vector<Light>& lights, double wall, double blended = 0) {
    const Camera camera{.orthographic = true, .halfHeight = 2, .zNear = 0, .zFar = 100};
    const shared::ViewConstants view = viewConstants({camera, {512, 512}}, {});
    const SortedLights sorted = sortLights(lights, 0);
    std::vector<shared::LightConstants> inView;  // the eye is the world's origin
    for (uint32_t i = 0; i < sorted.sources.size(); ++i) inView.push_back(sorted.at(i));
    const std::vector<float> depth(128 * 128, wall > 0 ? float((100 - wall) / 100) : 0.0f), fragments(128 * 128, wall > 0 ? 1.5f : 0.0f),
        blends(128 * 128, float(blended));
    return countPairs({{128, 128}, depth, fragments, blends, inView}, view, sorted, {});
}

Light ball(float z, float range = 1) { return {.type = LightType::point, .positionWorld = vec3(0, 0, z), .range = range}; }

constexpr double kPixelArea = 16.0 / (512 * 512);  // square metres

}  // namespace

TEST_CASE("advice: pairs of lights and pixels are areas of the shapes that they count") {
    const auto pixels = [](double area) { return doctest::Approx(area / kPixelArea).epsilon(0.02); };
    SUBCASE("half a metre before the wall") {
        const SceneCounts counts = countsOf({ball(-9.5f)}, 10);
        CHECK(counts.inRectangle == pixels(4));
        CHECK(counts.behindNearest == pixels(4));
        CHECK(counts.onShape == pixels(kPi));
        CHECK(counts.behindFront == pixels(kPi));
        CHECK(counts.beforeBack == pixels(0.75 * kPi));
        CHECK(counts.reaching == pixels(0.75 * kPi));
        CHECK(counts.mostReaching == 1);
        CHECK(counts.visible == 1);
        CHECK(counts.meanDistance == doctest::Approx(10).epsilon(1e-3));
        CHECK(counts.inTile >= counts.reaching);
        CHECK(counts.inTile == pixels(0.75 * kPi).epsilon(0.2));  // tiles of an eighth of a metre
        CHECK(counts.inCluster == counts.inTile);
    }
    SUBCASE("before the wall, and not reaching it") {
        const SceneCounts counts = countsOf({ball(-5)}, 10);
        CHECK(counts.behindNearest == pixels(4));
        CHECK(counts.behindFront == pixels(kPi));
        CHECK(counts.beforeBack == 0);
        CHECK(counts.reaching == 0);
        CHECK(counts.inTile == 0);
    }
    SUBCASE("behind the wall") {
        const SceneCounts counts = countsOf({ball(-12)}, 10);
        CHECK(counts.inRectangle == pixels(4));
        CHECK(counts.behindNearest == 0);
        CHECK(counts.behindFront == 0);
        CHECK(counts.beforeBack == pixels(kPi));
        CHECK(counts.reaching == 0);
    }
    SUBCASE("nothing to see but a pane") {
        const SceneCounts counts = countsOf({ball(-5)}, 0, 1);
        CHECK(counts.covered == 0);
        CHECK(counts.fragments == 0);
        CHECK(counts.blended == counts.pixels);
        CHECK(counts.behindFront == pixels(kPi));
        CHECK(counts.surfaceBehindFront == 0);
        CHECK(counts.blendedBehindFront == pixels(kPi));
        CHECK(counts.reaching == 0);
    }
    SUBCASE("beside the picture") {
        Light beside = ball(-9.5f);
        beside.positionWorld.x = 10;
        const SceneCounts counts = countsOf({beside}, 10);
        CHECK(counts.lights == 1);
        CHECK(counts.visible == 0);
        CHECK(counts.inRectangle == 0);
    }
    SUBCASE("a spot that looks at the wall") {
        const Light spot{.type = LightType::spot, .positionWorld = vec3(0, 0, -8), .range = 10, .innerConeAngle = 0.1f, .outerConeAngle = 0.4f};
        const SceneCounts counts = countsOf({spot}, 10);
        const double radius = 2 * std::tan(0.4);
        CHECK(counts.reaching == pixels(kPi * radius * radius).epsilon(0.03));
    }
    SUBCASE("a light without bounds, and one inside another") {
        const Light sun{.type = LightType::directional};
        const SceneCounts counts = countsOf({ball(-9.5f), sun, ball(-10, 0.5f)}, 10);
        CHECK(counts.lights == 3);
        CHECK(counts.unbounded == 1);
        CHECK(counts.mostReaching == 2);
        CHECK(counts.reaching == pixels(kPi));
    }
}

namespace {

/// A folder in which the device's costs stand, as for the variants of the scene: so that `cheap` is the choice wherever it may be.
void keepCosts(const TemporaryFolder& folder, const DeviceInfo& device, const std::vector<CostVariant>& variants, std::string_view cheap) {
    DriverCache cache(folder.path().string(), "lighting-costs", kCostModelVersion, device);
    Coefficients costs;
    for (const CostModel& model : costModels())
        for (const CostTerm& term : model.terms) costs[std::string(term.coefficient)] = term.coefficient.starts_with(cheap) ? 0 : 1e-3;
    for (const CostVariant& variant : variants) cache.keep(variant.key(), textOf(costs));
}

/// All materials are Lambert's, and so few lights that they fit into a uniform buffer.
Scene room() {
    Scene scene;
    addObject(scene, quad(4), lambertMaterial(scene));
    for (int i = 0; i < 6; ++i) scene.lights.push_back({.positionWorld = vec3(float(i) - 2.5f, 0, 0.5f), .color = vec3(2), .range = 1.5f});
    return scene;
}
constexpr uint32_t kShapedOnly = 1u << uint32_t(LightEquation::shaped);
View roomView(uvec2 extent = {64, 48}) { return {{.worldFromView = lookAt(vec3(0, 0, 6), vec3(0)), .zNear = 0.1f}, extent}; }

std::vector<CostVariant> variantsOf(const std::vector<RenderSettings>& settings) {
    std::vector<CostVariant> variants;
    for (RenderSettings each : settings) {
        each.lighting = "auto";
        variants.push_back({each, kShapedOnly, true});
    }
    return variants;
}

}  // namespace

TEST_CASE("auto: makes the picture of the technique that it chose, and that is the yardstick's") {
    const TemporaryFolder folder;
    for (const char* cheap : {"quad", "volume-stencil.", "light-indexed", "forward-loop"}) {
        INFO(cheap);
        SilentValidation validation;
        RendererOptions options = validation.options();
        options.cacheFolder = folder.path().string();
        Renderer renderer(options);
        keepCosts(folder, renderer.device(), variantsOf({{}}), cheap);
        Renderer again(options);  // which reads them
        const Scene scene = room();
        again.setScene(scene);
        const Frame frame = again.render(roomView(), {.lighting = "auto"});
        REQUIRE(frame.stats.choice);
        const auto& choice = *frame.stats.choice;
        CHECK(std::string_view(cheap).starts_with(choice.technique));
        CHECK(choice.calibrationFrames == 0);
        CHECK(choice.countingFrames == 1);
        CHECK(has(choice.reason, "6 lights"));
        const Frame yardstick = again.render(roomView(), {.lighting = yardstickOf(techniqueNamed(choice.technique))});
        CHECK_FALSE(yardstick.stats.choice);
        CHECK(difference(frame.radiance, yardstick.radiance).max <= 2.0 * double(scene.lights.size() + 1) * std::exp2(-24));
    }
}

TEST_CASE("auto: never takes a technique that is not exact for the settings, however fast") {
    const TemporaryFolder folder;
    SilentValidation validation;
    RendererOptions options = validation.options();
    options.cacheFolder = folder.path().string();
    const DeviceInfo device = Renderer(options).device();
    const std::vector<RenderSettings> cases{{.lightBuffer = LightBufferFormat::rgba16f}, {.msaa = Msaa::x4}};
    for (const RenderSettings& settings : cases) {
        keepCosts(folder, device, variantsOf(cases), "quad");
        Renderer renderer(options);
        renderer.setScene(room());
        RenderSettings automatic = settings;
        automatic.lighting = "auto";
        const Frame frame = renderer.render(roomView(), automatic);
        CHECK(frame.stats.choice->calibrationFrames == 0);
        CHECK(whyNot(techniqueNamed(frame.stats.choice->technique), settings, {.lights = 6}).empty());
        CHECK(frame.stats.choice->technique != "quad");
    }
    // Only lists of lights have layers of them.
    keepCosts(folder, device, variantsOf({{}}), "quad");
    Renderer listing(options);
    listing.setScene(room());
    CHECK(listing.render(roomView(), {.lighting = "auto"}).stats.choice->technique == "quad");
    const Frame lists = listing.render(roomView(), {.lighting = "auto"}, {"list-length"});
    CHECK(techniqueNamed(lists.stats.choice->technique).info.lists);
    CHECK(lists.aovs.contains("list-length"));
    // The packing as asked for would lose lights, so that light-indexed, the fastest, has no part in it.
    const RenderSettings priority{.onOverflow = OnOverflow::priority};
    keepCosts(folder, device, variantsOf({priority}), "light-indexed");
    Renderer renderer(options);
    renderer.setScene(room());
    const LightingAdvice advice = renderer.advise(roomView(), priority);
    CHECK(has(rowOf(advice, "light-indexed").whyNot, "may lose lights"));
    CHECK(advice.technique != "light-indexed");
}

TEST_CASE("auto: counts again when scene, size, settings or what the camera sees have changed, and only then") {
    const TemporaryFolder folder;
    SilentValidation validation;
    RendererOptions options = validation.options();
    options.cacheFolder = folder.path().string();
    keepCosts(folder, Renderer(options).device(), variantsOf({{}, {.gbuffer = GBufferLayout::calver}}), "quad");
    Renderer renderer(options);
    Scene scene = room();
    renderer.setScene(scene);
    View view = roomView();
    RenderSettings settings{.lighting = "auto"};
    const auto countings = [&] { return renderer.render(view, settings).stats.choice->countingFrames; };
    CHECK(countings() == 1);
    CHECK(countings() == 0);
    settings.exposureEv = 1;  // data
    CHECK(countings() == 0);
    view.camera.worldFromView = lookAt(vec3(0.1f, 0, 6), vec3(0.1f, 0, 0));
    CHECK(countings() == 0);
    view.camera.worldFromView = lookAt(vec3(1, 0, 6), vec3(1, 0, 0));  // a sixth of the way to the wall
    CHECK(countings() == 1);
    view.camera.worldFromView = lookAt(vec3(1, 0, 6), vec3(2, 0, 0));  // turned by a fifth of the field of view
    CHECK(countings() == 1);
    view.camera.yFov = 0.5f;
    CHECK(countings() == 1);
    view.extent = {96, 72};
    CHECK(countings() == 1);
    settings.gbuffer = GBufferLayout::calver;
    CHECK(countings() == 1);
    CHECK(countings() == 0);
    const SceneCounts before = renderer.advise(view, settings).counts;
    CHECK(before.lights == 6);
    scene.lights.resize(2);
    renderer.setScene(scene);
    CHECK(countings() == 1);
    for (Light& light : scene.lights) light.positionWorld.y += 0.1f;
    renderer.setLights(scene.lights);
    CHECK(countings() == 0);  // that they move is no reason
    for (int i = 0; i < 60; ++i) renderer.setLights(scene.lights);
    CHECK(countings() == 1);  // or none at once
    scene.lights.resize(1);
    renderer.setLights(scene.lights);
    CHECK(countings() == 1);
    const SceneCounts after = renderer.advise(view, settings).counts;
    CHECK(after.lights == 1);
    CHECK(after.reaching < before.reaching);
    CHECK(after.covered == before.covered);
}

TEST_CASE("auto: the counts are those of the technique's own counting") {
    const TemporaryFolder folder;
    SilentValidation validation;
    RendererOptions options = validation.options();
    options.cacheFolder = folder.path().string();
    keepCosts(folder, Renderer(options).device(), variantsOf({{}}), "quad");
    Renderer renderer(options);
    renderer.setScene(room());
    const View view = roomView({256, 192});
    const auto sumOf = [&](const char* technique, const char* layer) {
        const Frame frame = renderer.render(view, {.lighting = technique}, {layer});
        const std::vector<float>& values = frame.aovs.at(layer).data;
        return std::accumulate(values.begin(), values.end(), 0.0);
    };
    const SceneCounts counts = renderer.advise(view, {}).counts;
    CHECK(counts.reaching == doctest::Approx(sumOf("brute-force", "useful-evaluations")).epsilon(0.03));
    CHECK(counts.covered * counts.lights == doctest::Approx(sumOf("brute-force", "evaluations")).epsilon(0.03));
    CHECK(counts.behindNearest == doctest::Approx(sumOf("quad", "evaluations")).epsilon(0.05));
    CHECK(counts.triangles == 2);
}

TEST_CASE("auto: the device is measured once, and what the caller sees meanwhile does not change") {
    const TemporaryFolder folder;
    Renderer first({.cacheFolder = folder.path().string()});
    const Scene scene = room();
    first.setScene(scene);
    const View view = roomView();
    const Frame before = first.render(view, {.lighting = "brute-force"});
    const Frame chosen = first.render(view, {.lighting = "auto"});
    CHECK(chosen.stats.choice->calibrationFrames > 0);
    CHECK(chosen.stats.choice->calibrationMs > 0);
    CHECK(chosen.stats.lights == scene.lights.size());
    CHECK(first.render(view, {.lighting = "brute-force"}).radiance.data == before.radiance.data);
    CHECK(first.render(view, {.lighting = "auto"}).stats.choice->calibrationFrames == 0);
    const auto calibrationFrames = [&] {
        Renderer next({.cacheFolder = folder.path().string()});
        next.setScene(scene);
        return next.render(view, {.lighting = "auto"}).stats.choice->calibrationFrames;
    };
    CHECK(calibrationFrames() == 0);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) std::filesystem::resize_file(entry.path(), 200);
    CHECK(calibrationFrames() > 0);  // what is damaged is measured anew
}
