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

constexpr vk::Format kDepthFormat = vk::Format::eD32Sfloat;
std::array<vk::Format, 4> targetFormats(GBufferLayout layout);

GBuffer createGBuffer(frame::FrameGraph& graph, GBufferLayout layout, vk::Extent2D extent);

/// Declares that a full-screen pass reads the G-buffer (bindings of gbuffer_read.glsl) and tests against its depth, so
/// that it runs only where a surface is.
void readGBuffer(frame::PassBuilder& pass, const GBuffer& gbuffer);

}  // namespace luciole::render
