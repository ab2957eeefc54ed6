// A forward renderer with a Vulkan device, a scene and shaders of its own, which takes one thing from Luciole: which lights reach each
// pixel. Each frame: depth pass (its own), LightIndexer::record, forward pass (its own, includes <luciole/light_index.glsl>).
//
//     foreign_renderer [--check] [picture.png]
//
// --check: under validation, and once more with a loop over all lights; fails if the pictures differ.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <luciole/error.hpp>
#include <luciole/light_indexer.hpp>
#include <luciole/output.hpp>
#include <random>

#include "device.hpp"

namespace {

using namespace luciole;
using Stage = vk::PipelineStageFlagBits2;
using Mask = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

constexpr uint32_t kSceneVert[] =
#include "scene.vert.inc"
    ;
constexpr uint32_t kForwardFrag[] =
#include "forward.frag.inc"
    ;

constexpr vk::Extent2D kExtent{640, 360};
constexpr vk::Format kColorFormat = vk::Format::eR32G32B32A32Sfloat, kDepthFormat = vk::Format::eD32Sfloat;
constexpr auto kSampled = vk::DescriptorType::eCombinedImageSampler, kStorage = vk::DescriptorType::eStorageBuffer;
constexpr auto kDepthLayout = Layout::eDepthAttachmentOptimal;  // in which this renderer keeps its depth

// ---- The scene, in this renderer's own terms: boxes. Only its lights are Luciole's.

struct Box {
    vec4 center, halfSize, color;
};

std::vector<Box> makeBoxes() {
    std::mt19937 random(1);
    const auto uniform = [&](float low, float high) { return low + (high - low) * float(random()) / 4294967296.0f; };
    std::vector<Box> boxes{{{0, -0.5f, 0, 0}, {20, 0.5f, 20, 0}, {0.8f, 0.8f, 0.8f, 0}}};
    for (int z = -6; z <= 6; ++z)
        for (int x = -6; x <= 6; ++x) {
            const float height = uniform(0.1f, 1.2f);
            boxes.push_back({{3 * float(x) + uniform(-1, 1), height, 3 * float(z) + uniform(-1, 1), 0},
                             {uniform(0.2f, 0.6f), height, uniform(0.2f, 0.6f), 0},
                             {uniform(0.3f, 1), uniform(0.3f, 1), uniform(0.3f, 1), 0}});
        }
    return boxes;
}

/// Hundreds of point lights, among them spots and some that fade by a function.
Scene makeLights() {
    std::mt19937 random(2);
    const auto uniform = [&](float low, float high) { return low + (high - low) * float(random()) / 4294967296.0f; };
    Scene scene;
    scene.functions = {{.name = "fade", .kind = Function::Kind::sampled, .samples = {vec2(1), vec2(0.3f), vec2(0)}}};
    for (int z = -9; z <= 9; ++z)
        for (int x = -9; x <= 9; ++x) {
            Light light{.positionWorld = {2 * float(x) + uniform(-0.7f, 0.7f), uniform(0.3f, 1.5f), 2 * float(z) + uniform(-0.7f, 0.7f)},
                        .color = {uniform(0, 1), uniform(0, 1), uniform(0, 1)},
                        .range = 2};
            if (scene.lights.size() % 5 == 0) light.type = LightType::spot, light.directionWorld = vec3(0, -1, 0);
            if (scene.lights.size() % 7 == 0) light.attenuation = 0;
            scene.lights.push_back(light);
        }
    return scene;
}

// ---- The renderer

class ForeignRenderer {
public:
    explicit ForeignRenderer(const host::Device& vulkan) : vulkan_(vulkan) {
        std::memcpy(boxBuffer_.mapped, boxes_.data(), boxes_.size() * sizeof(Box));
        writeDescriptors();
    }

    /// Linear radiance. \param loop over all lights, instead of those that the index images name
    Image render(const Camera& camera, bool loop) {
        const vk::raii::Pipeline depthOnly = makePipeline(false, 0), forward = makePipeline(true, loop ? indexer_.lightCount() : 0);
        const auto buffers = vk::raii::CommandBuffers(vulkan_.device, {.commandPool = *vulkan_.commandPool, .commandBufferCount = 1});
        const auto& commands = buffers.front();
        commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        host::transition(commands, *depth_.handle, vk::ImageAspectFlagBits::eDepth, Layout::eUndefined, kDepthLayout);
        drawBoxes(commands, camera, *depthOnly, false);

        indexer_.record(*commands, camera);

        host::transition(commands, *color_.handle, vk::ImageAspectFlagBits::eColor, Layout::eUndefined, Layout::eColorAttachmentOptimal);
        drawBoxes(commands, camera, *forward, true);
        host::transition(commands, *color_.handle, vk::ImageAspectFlagBits::eColor, Layout::eColorAttachmentOptimal, Layout::eTransferSrcOptimal);
        commands.copyImageToBuffer(
            *color_.handle, Layout::eTransferSrcOptimal, *pixels_.handle,
            vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, .imageExtent = {kExtent.width, kExtent.height, 1}});
        const vk::MemoryBarrier2 toHost{
            .srcStageMask = Stage::eTransfer, .srcAccessMask = Mask::eTransferWrite, .dstStageMask = Stage::eHost, .dstAccessMask = Mask::eHostRead};
        commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &toHost});
        commands.end();
        const vk::SubmitInfo submit{.commandBufferCount = 1, .pCommandBuffers = &*commands};
        vulkan_.queue.submit(submit);
        vulkan_.queue.waitIdle();

        if (const uint32_t over = indexer_.pixelsOver(); over > 0)
            throw std::runtime_error(fmt::format("{} pixels have more lights than room for them", over));
        Image image(kExtent.width, kExtent.height, 3);
        const auto* texels = static_cast<const vec4*>(pixels_.mapped);
        for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = texels[i / 3][int(i % 3)];
        return image;
    }

private:
    void writeDescriptors() {
        const vk::DescriptorBufferInfo boxes{.buffer = *boxBuffer_.handle, .range = VK_WHOLE_SIZE};
        const LightIndexDescriptors luciole = indexer_.descriptors();
        // What vulkan.hpp makes of C's structs has their layout.
        const auto* images = reinterpret_cast<const vk::DescriptorImageInfo*>(luciole.images.data());
        const auto* lights = reinterpret_cast<const vk::DescriptorBufferInfo*>(&luciole.lights);
        vulkan_.device.updateDescriptorSets(
            {vk::WriteDescriptorSet{.dstSet = sets_[0], .dstBinding = 0, .descriptorCount = 1, .descriptorType = kStorage, .pBufferInfo = &boxes},
             vk::WriteDescriptorSet{.dstSet = sets_[1], .dstBinding = 0, .descriptorCount = 5, .descriptorType = kSampled, .pImageInfo = images},
             vk::WriteDescriptorSet{.dstSet = sets_[1], .dstBinding = 5, .descriptorCount = 1, .descriptorType = kStorage, .pBufferInfo = lights}},
            nullptr);
    }

    /// \param stages of the shader that reads them
    vk::raii::DescriptorSetLayout makeSetLayout(const std::vector<vk::DescriptorType>& types, vk::ShaderStageFlags stages) const {
        std::vector<vk::DescriptorSetLayoutBinding> bindings;
        for (const auto type : types)
            bindings.push_back({.binding = uint32_t(bindings.size()), .descriptorType = type, .descriptorCount = 1, .stageFlags = stages});
        return {vulkan_.device, vk::DescriptorSetLayoutCreateInfo{}.setBindings(bindings)};
    }

    vk::raii::PipelineLayout makePipelineLayout() const {
        const vk::DescriptorSetLayout layouts[] = {*boxSet_, *lightSet_};
        const vk::PushConstantRange push{vk::ShaderStageFlagBits::eVertex, 0, 2 * sizeof(mat4)};
        return {vulkan_.device, vk::PipelineLayoutCreateInfo{}.setSetLayouts(layouts).setPushConstantRanges(push)};
    }

    vk::raii::DescriptorPool makeDescriptorPool() const {
        const vk::DescriptorPoolSize sizes[] = {{kSampled, 5}, {kStorage, 2}};
        return {vulkan_.device, vk::DescriptorPoolCreateInfo{.maxSets = 2}.setPoolSizes(sizes)};
    }

    std::vector<vk::DescriptorSet> allocateSets() const {
        const vk::DescriptorSetLayout layouts[] = {*boxSet_, *lightSet_};
        return (*vulkan_.device)
            .allocateDescriptorSets(vk::DescriptorSetAllocateInfo{.descriptorPool = *descriptorPool_}.setSetLayouts(layouts),
                                    *vulkan_.device.getDispatcher());
    }

    /// The depth pass, or the forward pass.
    vk::raii::Pipeline makePipeline(bool shades, uint32_t loop) const {
        const vk::raii::ShaderModule vertex(vulkan_.device, {.codeSize = sizeof(kSceneVert), .pCode = kSceneVert});
        const vk::raii::ShaderModule fragment(vulkan_.device, {.codeSize = sizeof(kForwardFrag), .pCode = kForwardFrag});
        const auto [indexBits, entryBits, overlap, images] = indexer_.packing();
        const uint32_t constants[] = {indexBits, entryBits, overlap, images, loop};
        std::vector<vk::SpecializationMapEntry> entries;
        for (uint32_t i = 0; i < std::size(constants); ++i) entries.push_back({i, 4 * i, 4});
        const auto specialization = vk::SpecializationInfo{}.setMapEntries(entries).setData<uint32_t>(constants);
        const vk::PipelineShaderStageCreateInfo stages[] = {
            {.stage = vk::ShaderStageFlagBits::eVertex, .module = *vertex, .pName = "main"},
            {.stage = vk::ShaderStageFlagBits::eFragment, .module = *fragment, .pName = "main", .pSpecializationInfo = &specialization}};
        const vk::PipelineVertexInputStateCreateInfo noVertices;
        const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = vk::PrimitiveTopology::eTriangleList};
        const vk::Viewport viewport{0, 0, float(kExtent.width), float(kExtent.height), 0, 1};
        const vk::Rect2D scissor{{0, 0}, kExtent};
        const auto viewports = vk::PipelineViewportStateCreateInfo{}.setViewports(viewport).setScissors(scissor);
        const vk::PipelineRasterizationStateCreateInfo rasterization{.lineWidth = 1};
        const vk::PipelineMultisampleStateCreateInfo oneSample{.rasterizationSamples = vk::SampleCountFlagBits::e1};
        // Depth is reversed, as Luciole's is.
        const vk::PipelineDepthStencilStateCreateInfo depth{
            .depthTestEnable = true, .depthWriteEnable = !shades, .depthCompareOp = shades ? vk::CompareOp::eEqual : vk::CompareOp::eGreater};
        const vk::PipelineColorBlendAttachmentState opaque{.colorWriteMask = vk::ColorComponentFlags(0xf)};
        const vk::PipelineColorBlendStateCreateInfo blending{.attachmentCount = shades, .pAttachments = &opaque};
        const vk::PipelineRenderingCreateInfo formats{
            .colorAttachmentCount = shades, .pColorAttachmentFormats = &kColorFormat, .depthAttachmentFormat = kDepthFormat};
        return {vulkan_.device, nullptr,
                vk::GraphicsPipelineCreateInfo{.pNext = &formats,
                                               .stageCount = shades ? 2u : 1u,
                                               .pStages = stages,
                                               .pVertexInputState = &noVertices,
                                               .pInputAssemblyState = &assembly,
                                               .pViewportState = &viewports,
                                               .pRasterizationState = &rasterization,
                                               .pMultisampleState = &oneSample,
                                               .pDepthStencilState = &depth,
                                               .pColorBlendState = &blending,
                                               .layout = *pipelineLayout_}};
    }

    void drawBoxes(const vk::raii::CommandBuffer& commands, const Camera& camera, vk::Pipeline pipeline, bool shades) const {
        const vk::RenderingAttachmentInfo color{.imageView = *color_.view,
                                                .imageLayout = Layout::eColorAttachmentOptimal,
                                                .loadOp = vk::AttachmentLoadOp::eClear,
                                                .storeOp = vk::AttachmentStoreOp::eStore};
        const vk::RenderingAttachmentInfo depth{.imageView = *depth_.view,
                                                .imageLayout = kDepthLayout,
                                                .loadOp = shades ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eClear,
                                                .storeOp = vk::AttachmentStoreOp::eStore};  // cleared to 0: infinitely far
        commands.beginRendering({.renderArea = {{0, 0}, kExtent},
                                 .layerCount = 1,
                                 .colorAttachmentCount = shades,
                                 .pColorAttachments = &color,
                                 .pDepthAttachment = &depth});
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelineLayout_, 0, sets_, nullptr);
        const mat4 matrices[] = {clipFromView(camera, {kExtent.width, kExtent.height}), inverse(camera.worldFromView)};
        commands.pushConstants<mat4>(*pipelineLayout_, vk::ShaderStageFlagBits::eVertex, 0, matrices);
        commands.draw(36, uint32_t(boxes_.size()), 0, 0);
        commands.endRendering();
    }

    const host::Device& vulkan_;
    const std::vector<Box> boxes_ = makeBoxes();
    host::Buffer boxBuffer_ = host::makeBuffer(vulkan_, boxes_.size() * sizeof(Box), vk::BufferUsageFlagBits::eStorageBuffer);
    host::Buffer pixels_ = host::makeBuffer(vulkan_, kExtent.width * kExtent.height * sizeof(vec4), vk::BufferUsageFlagBits::eTransferDst);
    host::Image color_ =
        host::makeImage(vulkan_, kColorFormat, kExtent, vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc,
                        vk::ImageAspectFlagBits::eColor);
    host::Image depth_ =
        host::makeImage(vulkan_, kDepthFormat, kExtent, vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled,
                        vk::ImageAspectFlagBits::eDepth);
    LightIndexer indexer_{
        vulkan_.forLuciole(), makeLights(), {*depth_.handle, VkFormat(kDepthFormat), VkImageLayout(kDepthLayout), {kExtent.width, kExtent.height}}};
    vk::raii::DescriptorSetLayout boxSet_ = makeSetLayout({kStorage}, vk::ShaderStageFlagBits::eVertex);
    vk::raii::DescriptorSetLayout lightSet_ =
        makeSetLayout({kSampled, kSampled, kSampled, kSampled, kSampled, kStorage}, vk::ShaderStageFlagBits::eFragment);
    vk::raii::PipelineLayout pipelineLayout_ = makePipelineLayout();
    vk::raii::DescriptorPool descriptorPool_ = makeDescriptorPool();
    std::vector<vk::DescriptorSet> sets_ = allocateSets();
};

/// The largest difference of the radiances, as a share of what they are.
float difference(const Image& a, const Image& b) {
    float largest = 0;
    for (size_t i = 0; i < a.data.size(); ++i) {
        const float here = std::abs(a.data[i] - b.data[i]) / (0.1f + b.data[i]);
        largest = std::isnan(here) ? INFINITY : std::max(largest, here);
    }
    return largest;
}

int run(bool check, const std::string& file) {
    std::vector<std::string> messages;
    {
        const host::Device vulkan(check ? &messages : nullptr);
        ForeignRenderer renderer(vulkan);
        const Camera camera{.worldFromView = lookAt({0, 6, 17}, {0, 0, 3})};
        Image image = renderer.render(camera, false);
        if (check) {
            const float most = difference(image, renderer.render(camera, true));
            fmt::print("largest difference from the loop over all lights: {:.1e}\n", most);
            // A light that one of them leaves out, at its very rim, is as dim as roundoff.
            if (!(most < 1e-5f)) return 1;
        }
        for (float& value : image.data) value = std::pow(value / (1 + value), 1 / 2.2f);
        writePng(file, image);
    }
    for (const std::string& message : messages) fmt::print(stderr, "validation: {}\n", message);
    return messages.empty() ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
    bool check = false;
    std::string file = "foreign_renderer.png";
    for (int i = 1; i < count; ++i) std::string_view(arguments[i]) == "--check" ? void(check = true) : void(file = arguments[i]);
    try {
        return run(check, file);
    } catch (const std::exception& error) {
        fmt::print(stderr, "foreign_renderer: {}\n", error.what());
        return 1;
    }
}
