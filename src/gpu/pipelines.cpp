#include "gpu/pipelines.hpp"

#include <luciole/scene.hpp>

#include "gpu/bindings.shared.h"
#include "gpu/resources.hpp"

namespace luciole::gpu {
namespace {

using Type = vk::DescriptorType;

void add(std::vector<vk::DescriptorSetLayoutBinding>& bindings, uint32_t first, uint32_t count, Type type) {
    for (uint32_t i = 0; i < count; ++i)
        bindings.push_back({.binding = first + i, .descriptorType = type, .descriptorCount = 1, .stageFlags = kStages});
}

vk::raii::DescriptorSetLayout makeLayout(const Context& context, const std::vector<vk::DescriptorSetLayoutBinding>& bindings) {
    return {context.device(), {.bindingCount = uint32_t(bindings.size()), .pBindings = bindings.data()}};
}

std::vector<vk::raii::DescriptorSetLayout> makeSetLayouts(const Context& context, vk::Sampler texelSampler) {
    using namespace shared;
    std::vector<vk::DescriptorSetLayoutBinding> frame, pass, material;
    add(frame, kFrameView, 1, Type::eUniformBuffer);
    add(frame, kFrameMaterials, 1, Type::eStorageBuffer);
    add(frame, kFrameUniformMaterials, 1, Type::eUniformBuffer);
    add(frame, kFrameLights, kFrameFunctions - kFrameLights, Type::eStorageBuffer);
    add(frame, kFrameFunctions, 1, Type::eCombinedImageSampler);
    add(frame, kFrameUniformLights, 1, Type::eUniformBuffer);
    add(frame, kFrameLightKinds, kFrameVolumeVertices - kFrameLightKinds + 1, Type::eStorageBuffer);
    add(frame, kFrameUniformLightKinds, 1, Type::eUniformBuffer);
    add(frame, kFrameLightTree, 1, Type::eCombinedImageSampler);
    add(frame, kFrameShadowedLights, 2, Type::eStorageBuffer);
    add(frame, kFrameShadowAtlas, 1, Type::eCombinedImageSampler);
    add(frame, kFrameUniformShadowedLights, 1, Type::eUniformBuffer);
    add(pass, kPassSampled, kPassSampledCount, Type::eCombinedImageSampler);
    // Immutable samplers, for a pass writes only the slots that it uses: Mesa's software driver (22.3) reads the sampler of
    // every slot and would follow a null pointer.
    for (auto& binding : pass) binding.pImmutableSamplers = &texelSampler;
    add(pass, kPassStorage, kPassStorageCount, Type::eStorageBuffer);
    add(material, 0, kMaterialTextures, Type::eCombinedImageSampler);
    add(material, kMaterialTextures, 1, Type::eUniformBuffer);
    std::vector<vk::raii::DescriptorSetLayout> layouts;
    for (const auto* bindings : {&frame, &pass, &material}) layouts.push_back(makeLayout(context, *bindings));
    return layouts;
}

/// Specialization data: constant i has ID i and 4 bytes.
struct Specialization {
    explicit Specialization(const std::vector<uint32_t>& constants) {
        for (uint32_t i = 0; i < constants.size(); ++i) entries.push_back({i, i * 4u, 4});
        info = {.mapEntryCount = uint32_t(entries.size()),
                .pMapEntries = entries.data(),
                .dataSize = constants.size() * 4,
                .pData = constants.data()};
    }
    std::vector<vk::SpecializationMapEntry> entries;
    vk::SpecializationInfo info;
};

using shared::ObjectConstants;
static_assert(sizeof(Vertex) == 72 && sizeof(ObjectConstants) == 112);
// Objects come as attributes of the instance: of a storage buffer Mesa's software driver (22.3) loads each float of each vertex by itself.
constexpr vk::VertexInputBindingDescription kMeshBindings[] = {{0, sizeof(Vertex), vk::VertexInputRate::eVertex},
                                                               {1, sizeof(ObjectConstants), vk::VertexInputRate::eInstance}};
constexpr uint32_t kWorldFromObject = offsetof(ObjectConstants, worldFromObject);
constexpr uint32_t kWorldNormalFromObject = offsetof(ObjectConstants, worldNormalFromObject);
constexpr vk::VertexInputAttributeDescription kMeshAttributes[] = {
    {0, 0, vk::Format::eR32G32B32Sfloat, offsetof(Vertex, position)},
    {1, 0, vk::Format::eR32G32B32Sfloat, offsetof(Vertex, normal)},
    {2, 0, vk::Format::eR32G32B32A32Sfloat, offsetof(Vertex, tangent)},
    {3, 0, vk::Format::eR32G32Sfloat, offsetof(Vertex, uv0)},
    {4, 0, vk::Format::eR32G32Sfloat, offsetof(Vertex, uv1)},
    {5, 0, vk::Format::eR32G32B32A32Sfloat, offsetof(Vertex, color)},
    {6, 1, vk::Format::eR32G32B32A32Sfloat, kWorldFromObject},
    {7, 1, vk::Format::eR32G32B32A32Sfloat, kWorldFromObject + sizeof(vec4)},
    {8, 1, vk::Format::eR32G32B32A32Sfloat, kWorldFromObject + 2 * sizeof(vec4)},
    {9, 1, vk::Format::eR32G32B32A32Sfloat, kWorldFromObject + 3 * sizeof(vec4)},
    {10, 1, vk::Format::eR32G32B32Sfloat, kWorldNormalFromObject},
    {11, 1, vk::Format::eR32G32B32Sfloat, kWorldNormalFromObject + sizeof(vec3)},
    {12, 1, vk::Format::eR32G32B32Sfloat, kWorldNormalFromObject + 2 * sizeof(vec3)},
    {13, 1, vk::Format::eR32Sfloat, offsetof(ObjectConstants, tangentSign)},
    {14, 1, vk::Format::eR32G32Uint, offsetof(ObjectConstants, material)},
};

vk::PipelineColorBlendAttachmentState blendState(const PipelineKey& key) {
    const vk::BlendFactor kept = key.blend == Blend::over    ? vk::BlendFactor::eOneMinusSrcAlpha
                                 : key.blend == Blend::shift ? vk::BlendFactor::eConstantColor
                                                             : vk::BlendFactor::eOne;
    const vk::BlendOp op = key.blend == Blend::max ? vk::BlendOp::eMax : vk::BlendOp::eAdd;
    return {.blendEnable = key.blend != Blend::replace,
            .srcColorBlendFactor = vk::BlendFactor::eOne,
            .dstColorBlendFactor = kept,
            .colorBlendOp = op,
            .srcAlphaBlendFactor = vk::BlendFactor::eOne,
            .dstAlphaBlendFactor = kept,  // of the constant its alpha
            .alphaBlendOp = op,
            // The bits of vk::ColorComponentFlagBits are those of the channels.
            .colorWriteMask = vk::ColorComponentFlags(key.fragment.empty() ? 0 : key.channels)};
}

}  // namespace

std::vector<vk::DescriptorSet> allocateSets(const Context& context, const vk::raii::DescriptorPool& pool,
                                            vk::DescriptorSetLayout layout, uint32_t count) {
    const std::vector<vk::DescriptorSetLayout> layouts(count, layout);
    // Not vk::raii::DescriptorSets: each of those is freed by a call of its own.
    return (*context.device())
        .allocateDescriptorSets({.descriptorPool = *pool, .descriptorSetCount = count, .pSetLayouts = layouts.data()},
                                *context.device().getDispatcher());
}

Pipelines::Pipelines(const Context& context, ShaderLibrary shaders)
    : context_(context),
      shaders_(shaders),
      texelSampler_(context.device(), {.magFilter = vk::Filter::eNearest,
                                       .minFilter = vk::Filter::eNearest,
                                       .addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                       .addressModeV = vk::SamplerAddressMode::eClampToEdge}),
      setLayouts_(makeSetLayouts(context, *texelSampler_)) {
    std::vector<vk::DescriptorSetLayout> handles;
    for (const auto& layout : setLayouts_) handles.push_back(*layout);
    const vk::PushConstantRange push{kStages, 0, shared::kPushBytes};
    layout_ = vk::raii::PipelineLayout(context.device(), {.setLayoutCount = uint32_t(handles.size()),
                                                          .pSetLayouts = handles.data(),
                                                          .pushConstantRangeCount = 1,
                                                          .pPushConstantRanges = &push});
}

vk::Pipeline Pipelines::get(const PipelineKey& key) {
    auto found = pipelines_.find(key);
    if (found == pipelines_.end()) {
        found = pipelines_.emplace(key, make(key)).first;
        context_.name(*found->second, key.fragment.empty() ? key.vertex : key.fragment);
    }
    return *found->second;
}

vk::Pipeline Pipelines::compute(const std::string& shader, const std::vector<uint32_t>& constants) {
    const auto key = std::pair(shader, constants);
    auto found = computePipelines_.find(key);
    if (found == computePipelines_.end()) {
        const Specialization specialization(constants);
        const vk::raii::ShaderModule code = module(shader);
        vk::raii::Pipeline pipeline(context_.device(), nullptr,
                                    vk::ComputePipelineCreateInfo{.stage = {.stage = vk::ShaderStageFlagBits::eCompute,
                                                                            .module = *code,
                                                                            .pName = "main",
                                                                            .pSpecializationInfo = &specialization.info},
                                                                  .layout = *layout_});
        found = computePipelines_.emplace(key, std::move(pipeline)).first;
        context_.name(*found->second, shader);
    }
    return *found->second;
}

vk::raii::ShaderModule Pipelines::module(const std::string& name) const {
    const auto code = shaders_(name);
    return {context_.device(), {.codeSize = code.size_bytes(), .pCode = code.data()}};
}

vk::raii::Pipeline Pipelines::make(const PipelineKey& key) const {
    const Specialization constants(key.constants);
    std::vector<vk::raii::ShaderModule> modules;
    std::vector<vk::PipelineShaderStageCreateInfo> stages;
    const auto addStage = [&](const std::string& name, vk::ShaderStageFlagBits stage) {
        if (name.empty()) return;
        modules.push_back(module(name));
        stages.push_back({.stage = stage, .module = *modules.back(), .pName = "main", .pSpecializationInfo = &constants.info});
    };
    addStage(key.vertex, vk::ShaderStageFlagBits::eVertex);
    addStage(key.fragment, vk::ShaderStageFlagBits::eFragment);

    vk::PipelineVertexInputStateCreateInfo vertices;
    if (key.meshVertices)
        vertices = {.vertexBindingDescriptionCount = uint32_t(std::size(kMeshBindings)),
                    .pVertexBindingDescriptions = kMeshBindings,
                    .vertexAttributeDescriptionCount = uint32_t(std::size(kMeshAttributes)),
                    .pVertexAttributeDescriptions = kMeshAttributes};
    const vk::PipelineInputAssemblyStateCreateInfo assembly{
        .topology = key.points ? vk::PrimitiveTopology::ePointList : vk::PrimitiveTopology::eTriangleList};
    const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
    const vk::PipelineRasterizationStateCreateInfo rasterization{
        .depthClampEnable = key.depthClamp, .polygonMode = vk::PolygonMode::eFill, .lineWidth = 1};
    const vk::PipelineMultisampleStateCreateInfo multisample{.rasterizationSamples = key.samples};
    const vk::PipelineDepthStencilStateCreateInfo depth{};
    std::vector<vk::PipelineColorBlendAttachmentState> blends(key.colors.size(), blendState(key));
    if (key.lastAdds) blends.back() = blendState({.fragment = key.fragment, .blend = Blend::add});
    const vk::PipelineColorBlendStateCreateInfo blending{.attachmentCount = uint32_t(blends.size()), .pAttachments = blends.data()};
    const vk::DynamicState dynamics[] = {vk::DynamicState::eViewport,        vk::DynamicState::eScissor,
                                         vk::DynamicState::eCullMode,        vk::DynamicState::eFrontFace,
                                         vk::DynamicState::eDepthTestEnable, vk::DynamicState::eDepthWriteEnable,
                                         vk::DynamicState::eDepthCompareOp,  vk::DynamicState::eStencilTestEnable,
                                         vk::DynamicState::eStencilOp,       vk::DynamicState::eStencilCompareMask,
                                         vk::DynamicState::eStencilWriteMask, vk::DynamicState::eStencilReference,
                                         vk::DynamicState::eBlendConstants,  vk::DynamicState::eDepthBiasEnable,
                                         vk::DynamicState::eDepthBias};
    const vk::PipelineDynamicStateCreateInfo dynamic{.dynamicStateCount = uint32_t(std::size(dynamics)), .pDynamicStates = dynamics};
    const vk::PipelineRenderingCreateInfo formats{.colorAttachmentCount = uint32_t(key.colors.size()),
                                                  .pColorAttachmentFormats = key.colors.data(),
                                                  .depthAttachmentFormat = key.depth,
                                                  .stencilAttachmentFormat = hasStencil(key.depth) ? key.depth : vk::Format::eUndefined};
    return {context_.device(), nullptr,
            vk::GraphicsPipelineCreateInfo{.pNext = &formats,
                                           .flags = key.feedback ? vk::PipelineCreateFlagBits::eColorAttachmentFeedbackLoopEXT : vk::PipelineCreateFlags(),
                                           .stageCount = uint32_t(stages.size()),
                                           .pStages = stages.data(),
                                           .pVertexInputState = &vertices,
                                           .pInputAssemblyState = &assembly,
                                           .pViewportState = &viewport,
                                           .pRasterizationState = &rasterization,
                                           .pMultisampleState = &multisample,
                                           .pDepthStencilState = &depth,
                                           .pColorBlendState = &blending,
                                           .pDynamicState = &dynamic,
                                           .layout = *layout_}};
}

}  // namespace luciole::gpu
