#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <luciole/image.hpp>

/// Pictures as files, and pictures of counts. Files appear whole or not at all: written beside the target, synced,
/// renamed.
namespace luciole {

/// \throws Error(io) naming the file and the system's reason; nothing is left behind
void writeFileAtomically(const std::filesystem::path& file, std::span<const std::byte> bytes);

/// \param image values in [0, 1] (clamped), 1, 3 or 4 channels; \param bits 8 or 16, rounded to nearest
void writePng(const std::filesystem::path& file, const Image& image, int bits = 8);

/// The same in memory.
std::vector<std::byte> pngOf(const Image& image, int bits = 8);

enum class ExrType { half, float32 };
/// \param layers layer "" holds R, G, B; layer NAME holds NAME.R, NAME.G, NAME.B or NAME.Y by channel count.
///        All of one size. Layers of distances, indices and counts (depth, material, id, light-count, evaluations,
///        useful-evaluations, light-fingerprint, list-length, list-slice) are always written as 32-bit float
void writeExr(const std::filesystem::path& file, const std::map<std::string, Image>& layers, ExrType type = ExrType::half);

Image readPng(const std::filesystem::path& file);                         ///< [0, 1], 3 or 4 channels
std::map<std::string, Image> readExr(const std::filesystem::path& file);  ///< as writeExr takes them

/// Counts or errors as colours, one for each pixel, without a legend: from 0 to `top` on one scale, dark grey where nothing was counted.
/// \param values 1 channel; not finite counts as 0. \param top > 0
/// \return sRGB-encoded, [0, 1], 3 channels. \throws Error(usage) for other images
Image heatMap(const Image& values, float top);

/// How much work a technique did for one picture, and how much of it was of use.
struct OverlapCounts {
    uint64_t evaluations = 0;        ///< pairs of a pixel and a light that was evaluated there
    uint64_t usefulEvaluations = 0;  ///< those of them whose light reaches the pixel's surface
    uint64_t coveredPixels = 0;      ///< pixels at which at least one light was evaluated
};

/// \param evaluations, useful the layers of these names (see aovNames): whole numbers >= 0, 1 channel, one size
/// \throws Error(usage) for other shapes
OverlapCounts countOverlap(const Image& evaluations, const Image& useful);

/// Both layers as heat maps side by side, for people: full resolution, one colour scale from 0 to the largest count,
/// and below it a legend with the largest count and the mean over the covered pixels of each. A pixel at which no light
/// was evaluated is dark grey in both.
/// \return sRGB-encoded, [0, 1], 3 channels. The left map's corner is (0, 0), the right one's
///         ((width + kOverlapGap) / 2, 0); maps that are narrower than their legend are padded
/// \throws as countOverlap
Image overlapHeatMap(const Image& evaluations, const Image& useful);
inline constexpr uint32_t kOverlapGap = 4;  ///< pixels between the maps

/// The lists of lights that a tiled or clustered technique made, for people: two maps side by side, full resolution. On the left how many
/// lights are in each pixel's list, on one scale from 0 to the longest, dark grey where none is; on the right the slices of depth, each in
/// a colour of its own, with the tiles as squares of a chessboard, dark grey where there is no surface. Below them a legend.
/// \param lengths, slices the layers list-length and list-slice (see aovNames)
/// \param tileSize of the lists (LightListStats), pixels, >= 1
/// \return as overlapHeatMap. \throws Error(usage) for images of other shapes
Image lightListMap(const Image& lengths, const Image& slices, uint32_t tileSize);

}  // namespace luciole
