#pragma once
#include <memory>
#include <vector>

#include <luciole/scene.hpp>

namespace luciole::reference {

/// A texture with its mip levels, read as Vulkan reads it (Vulkan 1.3, "Image Operations", "Texel Selection"), but with
/// exact weights and level of detail.
class SampledTexture {
public:
    /// Level 0 first; a sampler without a mip filter reads no other.
    using Levels = std::shared_ptr<const std::vector<Texels>>;

    SampledTexture(Levels levels, const Sampler& sampler, bool srgb);

    /// \param uv (0, 0) at the top left; \param dx, dy differences to the neighbouring pixels
    /// \return linear RGBA
    dvec4 sample(dvec2 uv, dvec2 dx, dvec2 dy) const;

    /// log2 of the larger difference in texels of level 0; -infinity where nothing changes.
    double levelOfDetail(dvec2 dx, dvec2 dy) const;

private:
    dvec4 sampleLevel(size_t level, dvec2 uv, Filter filter) const;
    dvec4 texel(const Texels& level, int64_t x, int64_t y) const;

    Levels levels_;
    Sampler sampler_;
    bool srgb_;
};

}  // namespace luciole::reference
