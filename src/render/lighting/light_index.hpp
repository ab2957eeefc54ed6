#pragma once
#include "render/lighting/light_index_plan.hpp"
#include "render/lighting/techniques.hpp"

namespace luciole::render {

/// What was made of a frame, for whoever judges it when it has run.
struct LightIndexFrame {
    std::optional<IndexLayout> layout;        ///< of the packing that the settings ask for; none for `list`
    LightIndexAttempt attempt;                ///< `list` and `entries` as they were in the end
    std::optional<frame::BufferId> counters;  ///< light_index.shared.h: kCounter*, then kLostWords by light
    LightIndexStats stats;                    ///< what is known before the frame has run
    std::vector<uint32_t> dropped;            ///< lights of the table that found no place
};

/// Step 2 alone, for surfaces that somebody else draws and looks up the indices for: the images of a packing of one
/// pass, which no stencil guards, and the counters.
struct LightIndices {
    IndexLayout layout;
    std::vector<frame::ImageId> images;
    frame::BufferId counters;
};
/// \param in of it: scene, constants, lights, depth (which has one sample) and settings
LightIndices addLightIndices(frame::FrameGraph& graph, const LightingInputs& in);

/// What the counters of the frame say. \return the next attempt, if this one did not do
/// \throws Error(limit) if lights were lost that must not be
std::optional<LightIndexAttempt> judge(const LightIndexFrame& frame, std::span<const uint32_t> counters,
                                       const RenderSettings& settings, const GpuScene& scene, uint64_t largestBuffer,
                                       LightIndexStats& stats);

}  // namespace luciole::render
