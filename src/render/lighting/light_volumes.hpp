#pragma once
#include "render/lighting/techniques.hpp"

/// What the techniques that draw light volumes have in common.
namespace luciole::render {

/// What is evaluated where lights may reach, and what it needs.
struct VolumeShading {
    std::string shaped;      ///< fragment shader of one light, its input `lightIndex`
    std::string everywhere;  ///< fragment shader of a LightSlice, pushed, at every pixel
    /// Declares what the shaders read and add to, lights and depth included. \param depth how the pass tests: depthTest or stencilWrite
    std::function<void(frame::PassBuilder& pass, frame::Access depth)> declare;
};

/// Adds each light's contribution (contribution.glsl) to the surfaces of the G-buffer. `in` has to outlive the result.
VolumeShading deferredShading(const LightingInputs& in, frame::ImageId sum);

/// Adds pass `name`, which draws the unbounded lights at every pixel, then what `drawShaped` draws, then, stencilled, the lights
/// that a mesh bounds. \param stencil whether `drawShaped` marks the stencil; it leaves it at 0
/// \return the pass, for further reads; `drawShaped` runs with the lights' shaders' constants
frame::PassBuilder addVolumePass(frame::FrameGraph& graph, const LightingInputs& in, const VolumeShading& shading, const std::string& name,
                                 bool stencil, std::function<void(frame::PassContext&, const std::vector<uint32_t>&)> drawShaped);

/// Adds such a pass that draws the shaped lights' volumes in a fixed number of instanced draws, after those that make its lists.
void addInstancedVolumes(frame::FrameGraph& graph, const LightingInputs& in, const VolumeShading& shading, const std::string& name);

/// Whether volumes are drawn with depth clamped. In perspective nothing that matters is clipped: there is no far plane, and no surface
/// before the near plane. An orthographic view has both, and may see the far side of a volume only behind them.
bool clampsDepth(const GpuScene& scene);

/// Faces to draw of a convex mesh, and their depth test: front faces are drawn where they lie before the surface, back faces
/// where they lie behind it.
void setFaces(frame::PassContext& pass, bool frontFaces);

}  // namespace luciole::render
