#pragma once
#include <array>
#include <optional>

#include <luciole/renderer.hpp>

#include "frame/executor.hpp"
#include "render/lighting/techniques.hpp"

namespace luciole::render {

/// Phase 3: exposure, tone mapping and sRGB encoding into a picture of floats.
frame::ImageId addToneMap(frame::FrameGraph& graph, frame::ImageId radiance, vk::Extent2D extent, ToneMap toneMap);

/// The mean of each pixel's samples.
void addResolve(frame::FrameGraph& graph, frame::ImageId samples, frame::ImageId resolved);

/// What the host reads after the frame.
struct FrameOutputs {
    frame::BufferId radiance, display;
    std::optional<std::array<frame::BufferId, 4>> aovs = {};  ///< scalars, normal, cs0, cs1 (aov.frag)
    std::optional<frame::BufferId> counts = {};               ///< contribution.glsl
    std::optional<frame::BufferId> lists = {};                ///< list_layers.frag
};
FrameOutputs addOutputs(frame::FrameGraph& graph, const LightingInputs& lighting, frame::ImageId radiance,
                        frame::ImageId display, vk::Extent2D extent, bool aovs);

/// Whether a layer is one of those that count what the technique evaluates.
bool isCount(const std::string& aov);

/// Runs the technique once more, counting. \return evaluations, useful ones, fingerprints
frame::BufferId addCounts(frame::FrameGraph& graph, const LightingInputs& lighting, const LightingTechnique& technique);

/// Pictures and wanted AOVs of the last run; statistics are left empty.
Frame readOutputs(const frame::Executor& executor, const FrameOutputs& outputs, uvec2 extent, LightBufferFormat format,
                  const std::vector<std::string>& aovs);

}  // namespace luciole::render
