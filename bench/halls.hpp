#pragma once
#include <string>

#include <luciole/renderer.hpp>

namespace luciole::bench {

/// The built-in hall of 40,000 triangles with glTF's materials.
Scene builtinHall(uint32_t lights, double overlap);

/// The hall of `folder`/hall-255-o4.glb, for more than 255 lights of hall-1024-o4.glb, with so many lights and such a mean number of them
/// at a visible pixel. More lights than the file has are its own, moved a little; their ranges all get one factor. \throws Error
Scene hallOfFile(Renderer& renderer, const std::string& folder, uint32_t lights, double overlap);

/// A hall with `visible` lights, and so many more spread over a world around it, out of everything that is seen, that there are `lights`.
Scene hallInWorld(uint32_t visible, uint32_t lights);

}  // namespace luciole::bench
