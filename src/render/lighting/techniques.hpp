#pragma once
#include <vector>

#include <luciole/renderer.hpp>

#include "render/geometry/gbuffer.hpp"
#include "render/gpu_scene.hpp"

namespace luciole::render {

/// What every lighting technique gets. It knows the G-buffer and the light tables and no other technique.
struct LightingInputs {
    const GBuffer& gbuffer;
    const GpuScene& scene;
    std::vector<uint32_t> constants;  ///< specialization constants kConstant* for whoever includes frame.glsl
};

/// Adds its passes, which add the light of all of the scene's lights to `radiance`.
using AddLighting = void (*)(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId radiance);

struct LightingTechnique {
    LightingTechniqueInfo info;
    AddLighting add;
};

/// One row per technique: its name on the command line, its image tests and its place in the docs come from here.
const std::vector<LightingTechnique>& techniques();

/// \throws Error(usage) listing the names
const LightingTechnique& techniqueNamed(const std::string& name);

/// The pass that sets `radiance` to ambience and emission, before any technique adds to it.
void addInitialLight(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId radiance);

void addFullScreen(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId radiance);
void addBruteForce(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId radiance);

}  // namespace luciole::render
