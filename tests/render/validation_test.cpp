#include "device.hpp"
#include "gpu/resources.hpp"

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
