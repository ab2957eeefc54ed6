#include <doctest/doctest.h>

#include <cstddef>
#include <luciole/error.hpp>
#include <luciole/light_indexer.hpp>
#include <optional>

#include "../../examples/foreign_renderer/device.hpp"
#include "render/shaders/types.shared.h"

using namespace luciole;

namespace glsl {
using uint = uint32_t;
#include <luciole/light_index.glsl>
}  // namespace glsl

namespace {

// The light that hosts' shaders read is the light that is in the table.
#define SAME_PLACE(member) static_assert(offsetof(glsl::LucioleStoredLight, member) == offsetof(shared::LightConstants, member))
SAME_PLACE(position);
SAME_PLACE(range);
SAME_PLACE(direction);
SAME_PLACE(color);
SAME_PLACE(coneScale);
SAME_PLACE(cosOuter);
SAME_PLACE(type);
SAME_PLACE(flags);
SAME_PLACE(attenuation);
SAME_PLACE(falloff);
SAME_PLACE(linkGroup);
SAME_PLACE(volume);
SAME_PLACE(sceneIndex);
static_assert(sizeof(glsl::LucioleStoredLight) == sizeof(shared::LightConstants));
static_assert(glsl::kLucioleDirectional == shared::kLightDirectional && glsl::kLuciolePoint == shared::kLightPoint && glsl::kLucioleSpot == shared::kLightSpot);
static_assert(glsl::kLucioleDiffuse == shared::kLightDiffuse && glsl::kLucioleSpecular == shared::kLightSpecular);
static_assert(glsl::kLucioleNone == shared::kNoIndex && glsl::kLucioleSamples == shared::kFunctionSamples);

constexpr vk::Extent2D kExtent{64, 48};

/// The example's device under validation, and a wall across the view as its depth.
class Host {
public:
    HostDevice device() const { return device_->forLuciole(); }

    HostDepth makeDepth(vk::Format format, vk::ImageLayout layout) {
        aspects_ = vk::ImageAspectFlagBits::eDepth;
        if (format == vk::Format::eD32SfloatS8Uint) aspects_ |= vk::ImageAspectFlagBits::eStencil;
        layout_ = layout;
        using Usage = vk::ImageUsageFlagBits;
        depth_ = host::makeImage(*device_, format, kExtent, Usage::eDepthStencilAttachment | Usage::eSampled | Usage::eTransferDst, aspects_);
        return {*depth_->handle, VkFormat(format), VkImageLayout(layout), {kExtent.width, kExtent.height}};
    }

    /// \return the pixels that more lights reach than there is room for, at a wall of depth `depth`
    uint32_t run(LightIndexer& indexer, const Camera& camera, float depth) {
        const auto buffers = vk::raii::CommandBuffers(device_->device, {.commandPool = *device_->commandPool, .commandBufferCount = 1});
        const auto& commands = buffers.front();
        const vk::Image image = *depth_->handle;
        using Layout = vk::ImageLayout;
        commands.begin(vk::CommandBufferBeginInfo{});
        host::transition(commands, image, aspects_, Layout::eUndefined, Layout::eTransferDstOptimal);
        commands.clearDepthStencilImage(image, Layout::eTransferDstOptimal, vk::ClearDepthStencilValue{depth, 7}, vk::ImageSubresourceRange{aspects_, 0, 1, 0, 1});
        host::transition(commands, image, aspects_, Layout::eTransferDstOptimal, layout_);
        indexer.record(*commands, camera);
        commands.end();
        device_->queue.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &*commands});
        device_->queue.waitIdle();
        return indexer.pixelsOver();
    }

    ~Host() {
        depth_.reset();
        device_.reset();  // says what was left behind on it
        for (const std::string& message : messages_) FAIL_CHECK("validation: " << message);
    }

private:
    std::vector<std::string> messages_;
    std::optional<host::Device> device_{&messages_};
    std::optional<host::Image> depth_;
    vk::ImageAspectFlags aspects_;
    vk::ImageLayout layout_ = vk::ImageLayout::eUndefined;
};

/// Lights on the wall z = -4, in a row.
Scene wallLights() {
    Scene scene;
    for (int i = 0; i < 5; ++i) scene.lights.push_back({.positionWorld = {-1.6f + 0.81f * float(i), 0.1f, -4}, .range = 0.93f});
    return scene;
}

/// Pixels of the wall that more than `room` lights reach, one by one.
uint32_t expectedOver(const Scene& scene, const Camera& camera, uint32_t room) {
    uint32_t over = 0;
    const dmat4 viewFromClip = inverse(dmat4(clipFromView(camera, {kExtent.width, kExtent.height})));
    for (uint32_t y = 0; y < kExtent.height; ++y)
        for (uint32_t x = 0; x < kExtent.width; ++x) {
            const dvec4 p = viewFromClip * dvec4(2 * (x + 0.5) / kExtent.width - 1, 2 * (y + 0.5) / kExtent.height - 1, camera.zNear / 4.0, 1);
            uint32_t lights = 0;
            for (const Light& light : scene.lights) lights += distance(dvec3(p) / p.w, dvec3(light.positionWorld)) < light.range;
            over += lights > room;
        }
    return over;
}

}  // namespace

TEST_CASE("light indexer: with every format and layout of the host's depth, pixels over capacity are exactly those that more lights reach") {
    Host host;
    const Scene scene = wallLights();
    const Camera camera;
    using Layout = vk::ImageLayout;
    for (const auto& [format, layout] : {std::pair(vk::Format::eD32Sfloat, Layout::eDepthAttachmentOptimal), std::pair(vk::Format::eD32Sfloat, Layout::eDepthReadOnlyOptimal),
                                         std::pair(vk::Format::eD32SfloatS8Uint, Layout::eDepthStencilAttachmentOptimal), std::pair(vk::Format::eD32SfloatS8Uint, Layout::eGeneral)})
        for (const uint32_t overlap : {1u, 2u}) {
            INFO(vk::to_string(format) << " " << vk::to_string(layout) << ", overlap " << overlap);
            LightIndexer indexer(host.device(), scene, host.makeDepth(format, layout), {.overlap = overlap, .indices = LidrIndices::n255});
            const uint32_t over = expectedOver(scene, camera, overlap);
            CHECK(over > 50);
            CHECK(host.run(indexer, camera, camera.zNear / 4) == over);
            CHECK(host.run(indexer, camera, camera.zNear / 8) == 0);  // a wall that no light reaches
            CHECK(host.run(indexer, camera, 0) == 0);                 // no wall
        }
}

TEST_CASE("light indexer: lights and depth may be exchanged, and what fails leaves all as it was") {
    Host host;
    const Camera camera;
    const Scene scene = wallLights();
    LightIndexer indexer(host.device(), scene, host.makeDepth(vk::Format::eD32Sfloat, vk::ImageLayout::eDepthReadOnlyOptimal), {.overlap = 2, .indices = LidrIndices::n15});
    CHECK(indexer.packing() == std::array<uint32_t, 4>{4, 4, 2, 1});
    Scene many;
    many.lights.resize(16, Light{.range = 1});
    CHECK_THROWS_WITH_AS(indexer.setLights(many), doctest::Contains("expected at most 15"), Error);
    CHECK(host.run(indexer, camera, camera.zNear / 4) == expectedOver(scene, camera, 2));
    Scene fewer = scene;
    fewer.lights.pop_back();
    indexer.setLights(fewer);
    CHECK(indexer.lightCount() == 4);
    CHECK(host.run(indexer, camera, camera.zNear / 4) == expectedOver(fewer, camera, 2));
    indexer.setDepth(host.makeDepth(vk::Format::eD32SfloatS8Uint, vk::ImageLayout::eDepthStencilReadOnlyOptimal));
    CHECK(host.run(indexer, camera, camera.zNear / 4) == expectedOver(fewer, camera, 2));
}

TEST_CASE("light indexer: what it can't do it says before it starts") {
    Host host;
    const Scene scene = wallLights();
    const HostDepth depth = host.makeDepth(vk::Format::eD32Sfloat, vk::ImageLayout::eDepthReadOnlyOptimal);
    const auto make = [&](const HostDevice& device, const HostDepth& hostDepth, const LightIndexSettings& settings) { LightIndexer(device, scene, hostDepth, settings); };
    HostDepth other = depth;
    other.format = VK_FORMAT_D16_UNORM;
    HostDepth noLayout = depth;
    noLayout.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    HostDevice noQueue = host.device();
    noQueue.queueFamily = 99;
    CHECK_THROWS_WITH_AS(make(host.device(), other, {}), doctest::Contains("expected format D32Sfloat or D32SfloatS8Uint, got D16Unorm"), Error);
    CHECK_THROWS_WITH_AS(make(host.device(), noLayout, {}), doctest::Contains("expected the layout that it is kept in"), Error);
    CHECK_THROWS_WITH_AS(make(noQueue, depth, {}), doctest::Contains("queue family 99: expected graphics and compute"), Error);
    CHECK_THROWS_WITH_AS(make(host.device(), depth, {.overlap = 16}), doctest::Contains("overlap: expected 1, 2, 4 or 8, got 16"), Error);
    CHECK_THROWS_WITH_AS(make(host.device(), depth, {.overlap = 1, .indices = LidrIndices::n15}), doctest::Contains("got 1x15"), Error);
}
