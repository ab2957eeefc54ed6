#include <luciole/error.hpp>

#include "device.hpp"
#include "scene_building.hpp"
#include "scenes.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

RenderSettings indexed(Shadows shadows, LidrShadows where) {
    RenderSettings settings{.lighting = "light-indexed", .overlap = 16, .indices = LidrIndices::n255, .shadows = shadows};
    settings.shadowFilter = ShadowFilter::point;
    settings.lidrShadows = where;
    return settings;
}

}  // namespace

TEST_CASE("light-indexed shadows: where they are met, as indices are written or at surfaces, makes no difference but at edges") {
    ValidatedRenderer renderer;
    const TestScene test = builtin("builtin:hall?lights=24", {160, 120});
    renderer->setScene(test.scene);
    const auto render = [&](const RenderSettings& settings) { return renderer->render(test.view, settings); };
    const Image lit = render({.lighting = "light-indexed", .overlap = 16, .indices = LidrIndices::n255}).radiance;
    CHECK(render(indexed(Shadows::maps, LidrShadows::none)).radiance.data == lit.data);
    // The stencil's shadows know no normal: the same to the bit, and no index is spent on what is hidden.
    const Frame marked = render(indexed(Shadows::volumes, LidrShadows::finalPass)), skipped = render(indexed(Shadows::volumes, LidrShadows::index));
    CHECK(skipped.radiance.data == marked.radiance.data);
    CHECK(skipped.stats.lightIndex->packing == "bit-shift 16x255");
    const Frame shared = render(indexed(Shadows::volumes, LidrShadows::indexSoft));
    CHECK(shared.stats.lightIndex->packing == "bit-shift 16x255");
    CHECK(difference(shared.radiance, marked.radiance).max < 1e-5);
    // Maps are offset along the normal, which the index pass guesses from the depth around: edges of surfaces differ.
    const std::vector<bool> mask = interior(renderer->render(test.view, {}, {"id", "material", "depth"}));
    const auto shareOff = [&](const Image& image, const Image& yardstick, double by) {
        const std::vector<double> shares = litShares(image, yardstick);
        double off = 0, compared = 0;
        for (size_t i = 0; i < mask.size(); ++i)
            if (mask[i]) ++compared, off += std::abs(shares[i] - 1) > by;
        CHECK(compared > 5000);
        return off / compared;
    };
    const Image whole = render(indexed(Shadows::maps, LidrShadows::finalPass)).radiance;
    CHECK(difference(whole, lit).mean > 0.03);
    const auto differing = [&](const RenderSettings& settings) {
        const Frame frame = render(settings);
        CHECK_FALSE(frame.stats.lightIndex->fellBack);
        return shareOff(frame.radiance, whole, 0.02);
    };
    for (const LidrShadows where : {LidrShadows::index, LidrShadows::indexSoft}) {
        INFO("lidr-shadows " << int(where));
        RenderSettings settings = indexed(Shadows::maps, where);
        CHECK(differing(settings) < 0.02);
        settings.lidrTables = LidrTables::textures;
        CHECK(differing(settings) < 0.02);
        settings.lidrPacking = LidrPacking::cpuSort;
        CHECK(differing(settings) < 0.02);
        if (where == LidrShadows::indexSoft) continue;
        settings.lidrTables = LidrTables::buffers;
        settings.lidrPacking = LidrPacking::list;
        CHECK(differing(settings) < 0.02);
    }
    // Soft ones, in steps of 254 of a light.
    RenderSettings soft = indexed(Shadows::maps, LidrShadows::finalPass);
    soft.shadowFilter = ShadowFilter::smooth;
    const Image smooth = render(soft).radiance;
    soft.lidrShadows = LidrShadows::indexSoft;
    CHECK(shareOff(render(soft).radiance, smooth, 0.05) < 0.03);
    // Packings too small for all lights fall back to lists, which meet shadows at surfaces.
    soft.overlap = 2;
    const Frame lists = render(soft);
    CHECK(lists.stats.lightIndex->fellBack);
    CHECK(difference(lists.radiance, smooth).max < 1e-5);
}

TEST_CASE("light-indexed shadows: what they can't do is refused") {
    ValidatedRenderer renderer;
    TestScene test = studio();
    renderer->setScene(test.scene);
    const auto refusal = [&](const RenderSettings& settings) {
        try {
            renderer->render(test.view, settings);
        } catch (const Error& error) {
            CHECK(error.kind() == ErrorKind::usage);
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    RenderSettings settings = indexed(Shadows::maps, LidrShadows::index);
    settings.lidrCover = LidrCover::frontFaces;
    CHECK(refusal(settings).starts_with("lidr-shadows: index and index-soft expect lidr-cover surface"));
    settings = indexed(Shadows::maps, LidrShadows::indexSoft);
    settings.lidrTypes = LidrTypes::targets;
    CHECK(refusal(settings).starts_with("lidr-shadows: index-soft expects lidr-packing bit-shift or cpu-sort"));
    settings = indexed(Shadows::maps, LidrShadows::indexSoft);
    settings.lidrPacking = LidrPacking::list;
    CHECK(refusal(settings).starts_with("lidr-shadows: index-soft expects"));
}
