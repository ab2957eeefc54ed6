#include "render/scene_textures.hpp"

#include <fmt/format.h>

#include "scene/mip_chain.hpp"

namespace luciole::render {
namespace {

using namespace shared;

/// The textures of a material in the order of kTexture*, and whether each holds sRGB colours.
struct TextureRole {
    const TextureUse* use;
    bool srgb;
};
std::array<TextureRole, kTextureSlots> texturesOf(const Material& material) {
    return {{{&material.baseColorTexture, true},
             {&material.metallicRoughnessTexture, false},
             {&material.normalTexture, false},
             {&material.occlusionTexture, false},
             {&material.emissiveTexture, true}}};
}

vk::SamplerAddressMode addressMode(Wrap wrap) {
    switch (wrap) {
        case Wrap::mirroredRepeat: return vk::SamplerAddressMode::eMirroredRepeat;
        case Wrap::clampToEdge: return vk::SamplerAddressMode::eClampToEdge;
        default: return vk::SamplerAddressMode::eRepeat;
    }
}

vk::Filter filterOf(Filter filter) { return filter == Filter::nearest ? vk::Filter::eNearest : vk::Filter::eLinear; }

vk::raii::Sampler makeSampler(const gpu::Context& context, const Sampler& sampler) {
    const bool mips = sampler.mipFilter != MipFilter::none;
    return {context.device(),
            {.magFilter = filterOf(sampler.magFilter),
             .minFilter = filterOf(sampler.minFilter),
             .mipmapMode = sampler.mipFilter == MipFilter::linear ? vk::SamplerMipmapMode::eLinear : vk::SamplerMipmapMode::eNearest,
             .addressModeU = addressMode(sampler.wrapU),
             .addressModeV = addressMode(sampler.wrapV),
             // 0.25 keeps to level 0 and still tells minification from magnification (VkSamplerCreateInfo, note).
             .maxLod = mips ? VK_LOD_CLAMP_NONE : 0.25f}};
}

gpu::Image uploadTexels(const gpu::Context& context, const std::string& name, const Texels& texels, bool srgb) {
    const auto chain = mipChain(texels, srgb);
    std::vector<std::span<const std::byte>> levels;
    for (const Texels& level : chain) levels.push_back(std::as_bytes(std::span(level.rgba)));
    return gpu::uploadImage(context, name, srgb ? vk::Format::eR8G8B8A8Srgb : vk::Format::eR8G8B8A8Unorm,
                            {texels.width, texels.height}, levels);
}

}  // namespace

SceneTextures::SceneTextures(const gpu::Context& context, const Scene& scene) : context_(context), textures_(scene.textures) {
    images_.resize(scene.texels.size());
    for (const Material& material : scene.materials)
        for (const TextureRole& role : texturesOf(material)) {
            if (role.use->texture == kNone) continue;
            const uint32_t texels = scene.textures[role.use->texture].texels;
            gpu::Image& image = images_[texels][role.srgb];
            if (!*image.view) image = uploadTexels(context_, fmt::format("texels {} \"{}\"", texels, scene.texels[texels].name), scene.texels[texels], role.srgb);
        }
    white_ = uploadTexels(context_, "white", {.name = "white", .width = 1, .height = 1, .rgba = {255, 255, 255, 255}}, false);
}

std::array<vk::DescriptorImageInfo, kTextureSlots> SceneTextures::of(const Material& material) {
    std::array<vk::DescriptorImageInfo, kTextureSlots> infos;
    const auto roles = texturesOf(material);
    for (uint32_t slot = 0; slot < kTextureSlots; ++slot) {
        const uint32_t texture = roles[slot].use->texture;
        const bool has = texture != kNone;
        infos[slot] = {.sampler = samplerOf(has ? textures_[texture].sampler : Sampler{}),
                       .imageView = has ? *images_[textures_[texture].texels][roles[slot].srgb].view : *white_.view,
                       .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
    }
    return infos;
}

uint32_t SceneTextures::presentIn(const Material& material) {
    uint32_t present = 0;
    const auto roles = texturesOf(material);
    for (uint32_t slot = 0; slot < kTextureSlots; ++slot) present |= uint32_t(roles[slot].use->texture != kNone) << slot;
    return present;
}

vk::Sampler SceneTextures::samplerOf(const Sampler& wanted) {
    // A device may allow no more than 4,000 samplers; of different ones there are 108.
    for (const auto& [settings, sampler] : samplers_)
        if (settings == wanted) return *sampler;
    samplers_.emplace_back(wanted, makeSampler(context_, wanted));
    return *samplers_.back().second;
}

}  // namespace luciole::render
