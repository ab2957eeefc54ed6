#include "render/geometry/gbuffer.hpp"

namespace luciole::render {

using frame::Access;

std::array<vk::Format, 4> targetFormats(GBufferLayout layout) {
    const auto wide = vk::Format::eR16G16B16A16Unorm;
    switch (layout) {
        case GBufferLayout::calver: return {wide, wide, wide, wide};
        case GBufferLayout::floatPosition: return {vk::Format::eR16G16B16A16Sfloat, wide, wide, wide};
        default: return {vk::Format::eR8G8B8A8Unorm, vk::Format::eR8G8B8A8Unorm, wide, vk::Format::eR16Unorm};
    }
}

GBuffer createGBuffer(frame::FrameGraph& graph, GBufferLayout layout, vk::Extent2D extent, bool stencil, const std::string& prefix) {
    const auto formats = targetFormats(layout);
    GBuffer gbuffer;
    for (size_t i = 0; i < formats.size(); ++i)
        gbuffer.targets[i] = graph.createImage(prefix + "gbuffer." + "abcd"[i], {formats[i], extent});
    gbuffer.depth = graph.createImage(prefix + "depth", {stencil ? vk::Format::eD32SfloatS8Uint : vk::Format::eD32Sfloat, extent});
    return gbuffer;
}

void readGBuffer(frame::PassBuilder& pass, const GBuffer& gbuffer, Access depth) {
    for (uint32_t i = 0; i < gbuffer.targets.size(); ++i)
        pass.read(gbuffer.targets[i], Access::fragmentSampled, i);
    pass.read(gbuffer.depth, Access::fragmentSampled, 4);
    if (depth == Access::stencilWrite)
        pass.update(gbuffer.depth, depth);
    else
        pass.read(gbuffer.depth, depth);
}

}  // namespace luciole::render
