#pragma once
#include <array>
#include <utility>
#include <vector>

#include <luciole/scene.hpp>

#include "gpu/resources.hpp"
#include "render/shaders/types.shared.h"

namespace luciole::render {

/// The textures of a scene's materials on the device, and all samplers.
class SceneTextures {
public:
    SceneTextures(const gpu::Context& context, const Scene& scene);

    /// What a material's textures are read through, in the order of kTexture*: white, for one that it has not.
    std::array<vk::DescriptorImageInfo, shared::kTextureSlots> of(const Material& material);
    /// Bit i: the material has texture i.
    static uint32_t presentIn(const Material& material);
    vk::Sampler samplerOf(const Sampler& wanted);

private:
    const gpu::Context& context_;
    std::vector<Texture> textures_;
    std::vector<std::array<gpu::Image, 2>> images_;  ///< texels by [image][sRGB]: one image may serve as colour and as data
    gpu::Image white_;
    std::vector<std::pair<Sampler, vk::raii::Sampler>> samplers_;
};

}  // namespace luciole::render
