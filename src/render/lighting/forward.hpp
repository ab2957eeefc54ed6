#pragma once
#include "render/lighting/techniques.hpp"

/// What the techniques that light surfaces while they draw them have in common.
namespace luciole::render {

enum class Surfaces {
    opaque,
    added,  ///< opaque ones, whose light is added to what is there: of those that coincide all are seen
    blended,
};

/// A pass that draws surfaces where they are seen. Of opaque surfaces that coincide the last one drawn is, so opaque
/// passes replace what is there, and a further one has a target of its own.
struct ForwardPass {
    frame::PassBuilder pass;  ///< for what its shaders read
    frame::ImageId target;    ///< what `addToSum` adds
};

/// \param first nothing was drawn before: `sum` is set, and ambience and emission are part of it
ForwardPass addForwardPass(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum,
                           const std::string& name, Surfaces which, bool first);

/// After a pass that was declared and recorded: adds its target to `sum`, if it has one of its own.
void addToSum(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId target, frame::ImageId sum);

/// How such a pass draws. \param fragment the technique's shader; its variant for samples and counting is chosen here
/// \param own the shader's specialization constants from kForwardConstants on
SurfaceShading forwardShading(const LightingInputs& in, std::string fragment, Surfaces which, bool first,
                              std::vector<uint32_t> own = {});

/// Sets the depth test of such a pass.
void testDepth(frame::PassContext& pass, Surfaces which);

/// Draws the blended surfaces over what is there, each with all lights in a loop.
void addBlendedLoop(frame::FrameGraph& graph, const LightingInputs& in, frame::ImageId sum);

}  // namespace luciole::render
