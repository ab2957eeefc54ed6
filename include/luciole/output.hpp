#pragma once
#include <filesystem>
#include <map>
#include <span>
#include <string>

#include <luciole/image.hpp>

/// Files appear whole or not at all: written beside the target, synced, renamed.
namespace luciole {

/// \throws Error(io) naming the file and the system's reason; nothing is left behind
void writeFileAtomically(const std::filesystem::path& file, std::span<const std::byte> bytes);

/// \param image values in [0, 1] (clamped), 1, 3 or 4 channels; \param bits 8 or 16, rounded to nearest
void writePng(const std::filesystem::path& file, const Image& image, int bits = 8);

enum class ExrType { half, float32 };
/// \param layers layer "" holds R, G, B; layer NAME holds NAME.R, NAME.G, NAME.B or NAME.Y by channel count.
///        Layers named depth, material, id and light-count are always written as 32-bit float. All of one size
void writeExr(const std::filesystem::path& file, const std::map<std::string, Image>& layers, ExrType type = ExrType::half);

Image readPng(const std::filesystem::path& file);                         ///< [0, 1], 3 or 4 channels
std::map<std::string, Image> readExr(const std::filesystem::path& file);  ///< as writeExr takes them

}  // namespace luciole
