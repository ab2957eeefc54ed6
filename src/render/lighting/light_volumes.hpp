#pragma once
#include "render/lighting/techniques.hpp"

/// What the techniques that draw light volumes have in common.
namespace luciole::render {

/// Adds pass `name`, which draws the unbounded lights at every pixel, then what `drawShaped` draws, then, stencilled, the lights
/// that a mesh bounds. \param stencil whether `drawShaped` marks the stencil; it leaves it at 0
/// \return the pass, for further reads; `drawShaped` runs with the lights' shaders' constants
frame::PassBuilder addVolumePass(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum, const std::string& name,
                                 bool stencil, std::function<void(frame::PassContext&, const std::vector<uint32_t>&)> drawShaped);

/// Whether volumes are drawn with depth clamped. In perspective nothing that matters is clipped: there is no far plane, and no surface
/// before the near plane. An orthographic view has both, and may see the far side of a volume only behind them.
bool clampsDepth(const GpuScene& scene);

/// Faces to draw of a convex mesh, and their depth test: front faces are drawn where they lie before the surface, back faces
/// where they lie behind it.
void setFaces(frame::PassContext& pass, bool frontFaces);

}  // namespace luciole::render
