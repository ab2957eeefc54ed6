#include "render/lighting/light_index_self_test.hpp"

#include <fmt/format.h>

#include <charconv>
#include <chrono>

#include "frame/executor.hpp"
#include "frame/pass_context.hpp"

namespace luciole::render {

using frame::Access;

float blendShift(const shared::IndexPacking& packing) {
    return packing.entryBits >= 8 ? 0.0f : 1.0f / float(1u << packing.entryBits);
}

uint32_t wrongValues(const gpu::Context& context, gpu::Pipelines& pipelines, const IndexLayout& layout, float shift) {
    const shared::IndexPacking& packing = layout.packing;
    const gpu::Blend blend = packing.kind == shared::kPackedBits       ? gpu::Blend::shift
                             : packing.kind == shared::kPackedExtremes ? gpu::Blend::max
                                                                       : gpu::Blend::replace;
    const std::vector<uint32_t> constants{packing.kind, packing.indexBits, packing.entryBits, packing.unit};
    const std::string fragment = "render/lighting/light_index_self_test.frag";
    const auto draw = [constants](frame::PassContext& pass, const std::string& shader, gpu::Blend how) {
        pass.bind(
            {.vertex = "render/shaders/full_screen.vert", .fragment = shader, .blend = how, .constants = constants});
        pass.drawFullScreen();
    };
    frame::FrameGraph graph;
    const frame::ImageId image = graph.createImage("self-test", {layout.format, {256, 256}});
    const frame::ImageId seen = graph.createImage("self-test.seen", {vk::Format::eR8Unorm, {256, 256}});
    const frame::BufferId wrong = graph.createBuffer("self-test.wrong", 4);
    graph.addPass("zero").write(wrong, Access::transferWrite).record([wrong](frame::PassContext& pass) {
        pass.commands.fillBuffer(pass.buffer(wrong), 0, VK_WHOLE_SIZE, 0);
    });
    graph.addPass("first").write(image, Access::colorWrite).record([=](frame::PassContext& pass) {
        draw(pass, fragment + "+FIRST", gpu::Blend::replace);
    });
    graph.addPass("second").update(image, Access::colorBlend).record([=](frame::PassContext& pass) {
        pass.commands.setBlendConstants(std::array{shift, shift, shift, shift}.data());
        draw(pass, fragment + "+SECOND", blend);
    });
    graph.addPass("check")
        .read(image, Access::fragmentSampled, shared::kIndexImages)
        .update(wrong, Access::fragmentStorageWrite, shared::kIndexCounters)
        .clear(seen, Access::colorWrite, vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f))  // a pass draws into something
        .record([=](frame::PassContext& pass) { draw(pass, fragment, gpu::Blend::replace); });
    graph.output(wrong);
    frame::Executor executor(context, pipelines, std::move(graph));
    executor.run({}, false);
    return executor.read<uint32_t>(wrong)[0];
}

LightIndexSelfTest::LightIndexSelfTest(const gpu::Context& context, gpu::Pipelines& pipelines,
                                       const std::string& cacheFolder)
    : context_(context), pipelines_(pipelines), cache_(cacheFolder, "light-index", 1, context.info()) {}

LightIndexSelfTest::Outcome LightIndexSelfTest::of(const IndexLayout& layout) {
    const shared::IndexPacking& p = layout.packing;
    const std::string name = fmt::format("{} {} {}",
                                         p.kind == shared::kPackedBits       ? "bits"
                                         : p.kind == shared::kPackedChannels ? "channels"
                                                                             : "extremes",
                                         p.entryBits, vk::to_string(layout.format));
    uint32_t wrong = 0;
    if (const std::string* known = cache_.find(name)) {
        const auto [end, error] = std::from_chars(known->data(), known->data() + known->size(), wrong);
        if (error == std::errc() && end == known->data() + known->size()) return {wrong, 0};
    }
    const auto start = std::chrono::steady_clock::now();
    wrong = wrongValues(context_, pipelines_, layout, blendShift(p));
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    cache_.keep(name, std::to_string(wrong));
    return {wrong, took.count()};
}

}  // namespace luciole::render
