#include <luciole/scene_io.hpp>

#include <algorithm>

#include "device.hpp"
#include "scenes.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + ptrdiff_t(values.size() / 2));
    return values[values.size() / 2];
}

double sumOf(const std::vector<PassStats>& passes) {
    double sum = 0;
    for (const PassStats& pass : passes) sum += pass.ms.value();
    return sum;
}

TestScene hall(int lights, uvec2 extent) {
    Scene scene = loadScene("builtin:hall?triangles=5000&lights=" + std::to_string(lights));
    const View view{scene.cameras.at(0), extent};
    return {"hall", std::move(scene), view};
}

/// A frame that costs the same each time, and so much that what the host does beside it is nothing.
TestScene fixedCost() { return hall(255, {320, 240}); }

}  // namespace

TEST_CASE("measuring: timestamps and the wall clock agree to 5 %") {
    const TestScene test = fixedCost();
    ValidatedRenderer renderer;
    renderer->setScene(test.scene);
    std::vector<double> ratios;
    for (int frame = 0; frame < 7; ++frame) {
        const FrameStats stats = renderer->render(test.view, {.measure = true}).stats;
        ratios.push_back(sumOf(stats.passes) / stats.wallMs);
    }
    CAPTURE(ratios);
    CHECK(median(ratios) == doctest::Approx(1).epsilon(0.05));
}

TEST_CASE("measuring: a pass costs the frame what its timestamps say") {
    const TestScene test = fixedCost();
    ValidatedRenderer renderer;
    renderer->setScene(test.scene);
    const auto lightingOf = [](const std::vector<PassStats>& passes) { return std::ranges::find(passes, "lighting.brute-force", &PassStats::name)->ms.value(); };
    std::vector<double> timed, ablated;
    for (int frame = 0; frame < 5; ++frame) {
        const std::vector<PassStats> passes = renderer->render(test.view, {.measure = true}).stats.passes, cut = renderer->ablate(test.view, {});
        CHECK(std::ranges::equal(passes, cut, {}, &PassStats::name, &PassStats::name));
        timed.push_back(lightingOf(passes));
        ablated.push_back(lightingOf(cut));
    }
    CHECK(median(ablated) == doctest::Approx(median(timed)).epsilon(0.1));
    // Frames that were cut off leave nothing behind that the next one would show.
    CHECK(renderer->render(test.view, {}).radiance.data == renderer.render(test.scene, test.view, {}).radiance.data);
}

TEST_CASE("measuring: frames of every technique can be cut off behind each pass") {
    const TestScene test = hall(64, {61, 47});
    ValidatedRenderer renderer;
    renderer->setScene(test.scene);
    for (const LightingTechniqueInfo& technique : lightingTechniques()) {
        if (technique.name == "reference") continue;
        CAPTURE(technique.name);
        const RenderSettings settings{.lighting = std::string(technique.name)};
        const Frame before = renderer->render(test.view, settings);
        renderer->ablate(test.view, settings);
        CHECK(before.radiance.data == renderer->render(test.view, settings).radiance.data);
    }
}
