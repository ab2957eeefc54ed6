#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <luciole/renderer.hpp>

#include "frame/pass_context.hpp"
#include "render/geometry/gbuffer.hpp"
#include "render/gpu_scene.hpp"

namespace luciole::render {

/// How a technique goes about a frame; the one after another where the last did not hold all lights.
struct LightingAttempt {
    bool list = false;     ///< light-indexed: lists instead of what the settings say
    bool report = false;   ///< light-indexed: finds out which lights are lost
    uint32_t slices = 1;   ///< of the lights, a set of lists each
    uint64_t entries = 0;  ///< that the lists have room for; 0: as many as usual
    bool operator==(const LightingAttempt&) const = default;
};

/// What a technique that may have to try again says of a frame.
struct LightingReport {
    std::optional<frame::BufferId> counters;
    /// Told what the frame has counted there. Adds to the statistics. \return the next attempt, if this one did not do
    /// \throws Error(limit) if lights were lost that must not be
    std::function<std::optional<LightingAttempt>(std::span<const uint32_t> counters, FrameStats& stats)> judge;
};

/// What every lighting technique gets. It knows the G-buffer and the light tables and no other technique.
struct LightingInputs {
    const GBuffer& gbuffer;
    const GpuScene& scene;
    std::vector<uint32_t> constants;  ///< specialization constants kConstant* for whoever includes frame.glsl
    frame::BufferId lights;           ///< the table of lights, which the frame's set names
    std::optional<frame::ImageId> shadowAtlas = {};  ///< of shadow maps, likewise
    std::optional<frame::BufferId> shadowMask = {};  ///< of shadow volumes, likewise
    frame::ImageId depth;             ///< of the opaque surfaces, with all the samples that there are; the G-buffer's where that is one
    RenderSettings settings;
    std::string phase = "lighting.";  ///< what the names of passes begin with
    LightingAttempt attempt = {};
    uint64_t largestBuffer = 1ull << 27;  ///< bytes that a shader can see of one
    LightingReport* report = nullptr;     ///< null while counting
    std::optional<frame::ImageId> listLayers = {};  ///< for techniques that make lists: the image that gets the layers of list_layers.frag
    frame::BufferId counts = {};      ///< with kCountsLights: what forward passes count in (forward.glsl)

    bool counting() const { return (constants[shared::kConstantLights] & shared::kCountsLights) != 0; }

    /// Declares that a pass reads lights, and what keeps them off.
    void readLightsBy(frame::PassBuilder& pass) const {
        pass.read(lights, frame::Access::tableRead);
        if (shadowAtlas) pass.read(*shadowAtlas, frame::Access::tableSampled);
        if (shadowMask) pass.read(*shadowMask, frame::Access::tableRead);
    }

    /// Declares that a pass reads G-buffer and lights, and tests against depth (see readGBuffer).
    void readBy(frame::PassBuilder& pass, frame::Access depthAccess = frame::Access::depthTest) const {
        readGBuffer(pass, gbuffer, depthAccess);
        readLightsBy(pass);
    }
};

/// Adds its passes, which add the light of all of the scene's lights to `sum`: radiance, or, with kCountsLights among the
/// constants, counts (contribution.glsl). Forward techniques draw the surfaces themselves: they set `sum` to all the light there is,
/// and count in `in.counts`.
using AddLighting = void (*)(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);

struct LightingTechnique {
    LightingTechniqueInfo info;
    AddLighting add;
    bool forward = false;  ///< colours surfaces while it draws them: no G-buffer
    enum class Stencil { never, forMeshes, always } stencil = Stencil::never;  ///< when the depth buffer has to have one
    bool samples = false;  ///< takes any number of samples a pixel
    bool whole = false;   ///< deferred: sets `sum` to all the light there is, surfaces that blend included
    bool points = false;  ///< draws points as large as a tile, that bring along kBatchTexels (tiled_points.shared.h)
    bool onHost = false;  ///< the host looks at each light, so that none can be made on the device
    bool blendsLights = false;  ///< adds light by light to the light buffer, which rounds each sum
    std::string_view whyInexact = {};  ///< why it may differ from its yardstick by more than the rounding of sums; empty: it may not
};

/// The value of setting `lighting` that stands for a choice between the techniques, and is none of them.
inline constexpr std::string_view kAutoLighting = "auto";

/// One row per technique: its name on the command line, its image tests and its place in the docs come from here.
const std::vector<LightingTechnique>& techniques();

/// What no exact technique can undercut by finding fewer lights: for benchmarks only, so that it is in no list of techniques; the renderer
/// knows it by name. Its pass is "lighting.ideal"; the passes before it prepare what it is given.
const LightingTechnique& idealTechnique();

/// The technique without any bound, to which others are held: the one that evaluates all lights at the same surfaces.
std::string yardstickOf(const LightingTechnique& technique);

/// \throws Error(usage) listing the names of the table
const LightingTechnique& techniqueNamed(const std::string& name);

/// The passes that place the lights of the scene's bounce (docs/techniques/bounce.md) in the table of lights.
void addBounce(frame::FrameGraph& graph, const GpuScene& scene, frame::BufferId lights);

/// The pass that sets `radiance` to ambience and emission, before any technique adds to it.
void addInitialLight(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId radiance);

void addLightIndexed(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addLightPrepass(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addForwardMultipass(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addTiled(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addTiledPoints(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addClustered(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addClusteredForward(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addIdeal(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addForwardLoop(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addBruteForce(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addFullScreen(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addQuad(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addVolume(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addVolumeStencil(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addVolumeStencilReference(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);
void addVolumeInstanced(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);

/// Draws lights [first, first + count) at every pixel that holds a surface. \param fragment what sums up a slice of them in registers
void drawAtEveryPixel(frame::PassContext& pass, const GpuScene& scene, const std::vector<uint32_t>& constants, uint32_t first,
                      uint32_t count, const std::string& fragment = "render/lighting/brute_force.frag");

}  // namespace luciole::render
