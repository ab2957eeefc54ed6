#pragma once
#include <span>

#include <luciole/advice.hpp>

#include "frame/executor.hpp"
#include "gpu/pipelines.hpp"
#include "render/gpu_scene.hpp"

/// What a view asks of lighting techniques, counted in a small picture of it.
namespace luciole::render {

/// What the device draws for it: surfaces, and no light on them.
struct SmallPicture {
    uvec2 extent;
    std::span<const float> depth;      ///< of the opaque surfaces, as the depth buffer holds it; row by row
    std::span<const float> fragments;  ///< opaque fragments that passed the depth test, a pixel
    std::span<const float> blended;    ///< fragments of surfaces that blend, a pixel
    std::span<const shared::LightConstants> lightsInView;  ///< in the order of SortedLights
};

/// Counts pairs of lights and pixels of the picture, which stand for those of `view`. Needs no device.
/// \param view of the whole picture
/// \param sorted as it says how many of the lights have which shape
SceneCounts countPairs(const SmallPicture& picture, const shared::ViewConstants& view, const SortedLights& sorted,
                       const VolumeTables& volumes);

/// Draws the picture and counts, for `view` of the scene, which setView then was called with.
SceneCounts countScene(const gpu::Context& context, gpu::Pipelines& pipelines, GpuScene& scene, const View& view,
                       const RenderSettings& settings, GBufferLayout layout);

}  // namespace luciole::render
