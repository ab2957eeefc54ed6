#pragma once
#include <array>

#include <luciole/settings.hpp>

#include "frame/graph.hpp"

namespace luciole::render {

/// The four colour targets and the depth buffer of the geometry phase. What they hold: gbuffer.glsl, docs/gbuffer.md.
struct GBuffer {
    std::array<frame::ImageId, 4> targets;
    frame::ImageId depth;
};

std::array<vk::Format, 4> targetFormats(GBufferLayout layout);

/// \param stencil whether the depth buffer has one; the geometry phase leaves it at 0
/// \param prefix of the images' names
GBuffer createGBuffer(frame::FrameGraph& graph, GBufferLayout layout, vk::Extent2D extent, bool stencil, const std::string& prefix = "");

/// Declares that a pass reads the G-buffer (bindings of gbuffer_read.glsl) and tests against its depth.
/// \param depth depthTest, or stencilWrite for a pass that marks the stencil as well
void readGBuffer(frame::PassBuilder& pass, const GBuffer& gbuffer, frame::Access depth = frame::Access::depthTest);

}  // namespace luciole::render
