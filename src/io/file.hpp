#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

#include <luciole/output.hpp>

namespace luciole {

/// Reads a whole regular file.
/// \throws Error(io) if it can't be read (naming the file and the system's reason), Error(limit) beyond `maxBytes`
std::vector<std::byte> readFile(const std::filesystem::path& file, uint64_t maxBytes);

}  // namespace luciole
