#pragma once
#include "render/lighting/light_index_plan.hpp"
#include "render/lighting/techniques.hpp"

namespace luciole::render {

/// What was made of a frame, for whoever judges it when it has run.
struct LightIndexFrame {
    std::optional<IndexLayout> layout;  ///< of the packing that the settings ask for; none for `list`
    LightingAttempt attempt;            ///< `list` and `entries` as they were in the end
    LightIndexStats stats;              ///< what is known before the frame has run
    bool drops = false;                 ///< lights of the table found no place
    OnOverflow onOverflow;
    std::vector<uint32_t> sceneIndices; ///< of the lights of the table
    uint64_t largestBuffer;
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

/// By pixel, the lights that reach its surface, whatever they are linked to.
struct PixelLists {
    frame::BufferId offsets;  ///< uint[pixels + 1]: where each list begins
    frame::BufferId entries;  ///< light indices, those of a list in the order of the table
};
using AddPixelShading = std::function<void(const PixelLists& lists, bool first)>;
/// Adds what makes the lists, and what `addShading` adds to use them; several times, with other lights, if a buffer does not hold all.
/// \param in its depth has one sample
void addPixelLists(frame::FrameGraph& graph, const LightingInputs& in, const AddPixelShading& addShading);

/// What the counters of the frame say (light_index.shared.h: kCounter*, then kLostWords by light); see LightingReport.
std::optional<LightingAttempt> judge(const LightIndexFrame& frame, std::span<const uint32_t> counters, LightIndexStats& stats);

}  // namespace luciole::render
