#pragma once
#include <functional>
#include <string>
#include <vector>

#include <luciole/renderer.hpp>

namespace luciole {

/// Renders on the CPU in double precision: the picture that every technique is held to. Needs no Vulkan.
/// One ray per pixel centre; the same scene, view, equations and settings as Renderer::render.
/// \param progress called now and then with the share done, [0, 1], from the calling thread; return false to stop
/// \return a Frame with empty images if `progress` stopped it
/// \throws Error(usage) for unknown AOV names and for sizes beyond View's
Frame renderReference(const Scene& scene, const View& view, const RenderSettings& settings,
                      const std::vector<std::string>& aovs = {}, const std::function<bool(double)>& progress = {});

}  // namespace luciole
