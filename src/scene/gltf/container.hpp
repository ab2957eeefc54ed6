#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace luciole::gltf {

/// The two parts of a glTF file. A .gltf file has no binary chunk.
struct Container {
    std::string_view json;
    std::span<const std::byte> binaryChunk;
};

/// Takes a GLB file apart (glTF 2.0, section 4.4); anything else is taken for JSON. Refers to `bytes`.
/// \throws Error(scene) for a broken GLB
Container splitContainer(std::span<const std::byte> bytes, const std::string& file);

}  // namespace luciole::gltf
