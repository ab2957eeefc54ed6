#include "device.hpp"
#include "frame/executor.hpp"
#include "frame/pass_context.hpp"
#include "gpu/resources.hpp"
#include "gpu/shaders.hpp"

using namespace luciole;

namespace {

std::vector<std::string> messagesOf(const std::function<void(const gpu::Context&)>& work) {
    std::vector<std::string> messages;
    {
        const gpu::Context context({.validation = true, .onMessage = [&](std::string_view text) { messages.emplace_back(text); }});
        work(context);
    }
    return messages;
}

}  // namespace

// The canaries: if the layers ever stop reporting, the silence that other tests rely on means nothing.
TEST_CASE("validation: a command that breaks a rule is reported") {
    const auto messages = messagesOf([](const gpu::Context& context) {
        const auto buffer = gpu::makeBuffer(context, "no transfer destination", 64, vk::BufferUsageFlagBits::eStorageBuffer);
        context.runOnce([&](const vk::raii::CommandBuffer& commands) { commands.fillBuffer(*buffer.handle, 0, 64, 0); });
    });
    REQUIRE(!messages.empty());
    CHECK(messages.front().find("VUID-vkCmdFillBuffer-dstBuffer-00029") != std::string::npos);
}

TEST_CASE("validation: a missing barrier between two transfers is reported") {
    const auto messages = messagesOf([](const gpu::Context& context) {
        using Usage = vk::BufferUsageFlagBits;
        const auto a = gpu::makeBuffer(context, "a", 64, Usage::eTransferDst | Usage::eTransferSrc);
        const auto b = gpu::makeBuffer(context, "b", 64, Usage::eTransferDst);
        context.runOnce([&](const vk::raii::CommandBuffer& commands) {
            commands.fillBuffer(*a.handle, 0, 64, 0);
            commands.copyBuffer(*a.handle, *b.handle, vk::BufferCopy{.size = 64});
        });
    });
    REQUIRE(!messages.empty());
    CHECK(messages.front().find("SYNC-HAZARD-READ-AFTER-WRITE") != std::string::npos);
}

TEST_CASE("validation: a pass that breaks a rule fails the test that runs it" * doctest::should_fail()) {
    test::SilentValidation validation;
    const gpu::Context context(validation.options());
    gpu::Pipelines pipelines(context, gpu::shaderCode);
    frame::FrameGraph graph;
    const frame::BufferId result = graph.createBuffer("result", 64);
    graph.addPass("wrong").write(result, frame::Access::transferWrite).record([result](frame::PassContext& pass) {
        pass.commands.fillBuffer(pass.buffer(result), 0, 6, 0);  // no multiple of 4
    });
    graph.output(result);
    frame::Executor(context, pipelines, std::move(graph)).run({}, false);
}

TEST_CASE("executor: a pass that uses what it did not declare throws, and the next run starts afresh") {
    test::SilentValidation validation;
    const gpu::Context context(validation.options());
    gpu::Pipelines pipelines(context, gpu::shaderCode);
    frame::FrameGraph graph;
    const frame::BufferId declared = graph.createBuffer("declared", 64), other = graph.createBuffer("other", 64);
    bool wrong = true;
    graph.addPass("fill").write(declared, frame::Access::transferWrite).record([&](frame::PassContext& pass) {
        pass.commands.fillBuffer(pass.buffer(wrong ? other : declared), 0, 64, 7);
    });
    graph.addPass("other").write(other, frame::Access::transferWrite).record([&](frame::PassContext& pass) {
        pass.commands.fillBuffer(pass.buffer(other), 0, 64, 8);
    });
    graph.output(declared);
    graph.output(other);
    frame::Executor executor(context, pipelines, std::move(graph));
    CHECK_THROWS_WITH(executor.run({}, false), doctest::Contains("pass fill uses a resource that it did not declare"));
    wrong = false;
    executor.run({}, false);
    CHECK(executor.read<uint32_t>(declared)[3] == 7);
    CHECK(executor.read<uint32_t>(other)[3] == 8);
}
