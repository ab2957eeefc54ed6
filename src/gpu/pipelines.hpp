#pragma once
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/context.hpp"

namespace luciole::gpu {

/// Finds SPIR-V by name; made by luciole_shaders (cmake/shaders.cmake).
using ShaderLibrary = std::span<const uint32_t> (*)(std::string_view name);

/// What becomes of a colour that is there: dst' of src and dst, each channel by itself.
enum class Blend : uint8_t {
    replace,  ///< src
    add,      ///< src + dst
    over,     ///< src + (1 - src.a) dst: what is behind a premultiplied colour
    shift,    ///< src + c dst, c the blend constant
    max,      ///< max(src, dst)
};

/// What tells one pipeline from another. Cull mode, front face, depth (its bias, too) and stencil state and the blend constant are dynamic and not
/// in here.
struct PipelineKey {
    std::string vertex;
    std::string fragment;               ///< empty: nothing is written to colour attachments
    bool meshVertices = false;          ///< reads luciole::Vertex from vertex buffer 0, ObjectConstants by instance from 1
    bool points = false;                ///< draws points instead of triangles
    Blend blend = Blend::replace;
    bool feedback = false;              ///< reads the colour attachment that it writes
    bool lastAdds = false;              ///< the last colour attachment adds, whatever the others do
    uint8_t channels = 0xf;             ///< bit i: channel i of the colour attachments is written
    bool depthClamp = false;            ///< depth is clamped to [0, 1] where it would be clipped
    std::vector<uint32_t> constants;    ///< specialization constants 0, 1, ...
    std::vector<vk::Format> colors;
    vk::Format depth = vk::Format::eUndefined;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    auto operator<=>(const PipelineKey&) const = default;
};

/// Stages that see descriptors and push constants.
inline constexpr vk::ShaderStageFlags kStages =
    vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment | vk::ShaderStageFlagBits::eCompute;

/// `count` sets of one layout, freed with their pool.
std::vector<vk::DescriptorSet> allocateSets(const Context& context, const vk::raii::DescriptorPool& pool,
                                            vk::DescriptorSetLayout layout, uint32_t count);

/// Pipelines by key, made when first asked for. All share one layout, so that sets stay bound across pipelines:
///   set 0  the frame: tables that every pass may read (kFrame* below)
///   set 1  the pass: filled by the frame graph from what the pass declares
///   set 2  the material's textures and constants, geometry passes only
/// and 128 bytes of push constants, the least that Vulkan guarantees.
class Pipelines {
public:
    Pipelines(const Context& context, ShaderLibrary shaders);
    vk::Pipeline get(const PipelineKey& key);
    vk::Pipeline compute(const std::string& shader, const std::vector<uint32_t>& constants);
    vk::PipelineLayout layout() const { return *layout_; }
    vk::DescriptorSetLayout frameSetLayout() const { return *setLayouts_[0]; }
    vk::DescriptorSetLayout passSetLayout() const { return *setLayouts_[1]; }
    vk::DescriptorSetLayout materialSetLayout() const { return *setLayouts_[2]; }

private:
    vk::raii::Pipeline make(const PipelineKey& key) const;
    vk::raii::ShaderModule module(const std::string& name) const;

    const Context& context_;
    ShaderLibrary shaders_;
    vk::raii::Sampler texelSampler_;  // set 1 is read by texelFetch: nearest, clamped
    std::vector<vk::raii::DescriptorSetLayout> setLayouts_;
    vk::raii::PipelineLayout layout_ = nullptr;
    std::map<PipelineKey, vk::raii::Pipeline> pipelines_;
    std::map<std::pair<std::string, std::vector<uint32_t>>, vk::raii::Pipeline> computePipelines_;
};

}  // namespace luciole::gpu
