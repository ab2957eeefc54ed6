#pragma once
#include <optional>
#include <vector>

#include "gpu/vulkan.hpp"
#include "render/lighting/light_index.shared.h"
#include "render/tables.hpp"

/// What light-indexed deferred rendering decides on the host: how indices lie in their images, and which lights are
/// drawn when. Needs no device.
namespace luciole::render {

/// How indices lie in images.
struct IndexLayout {
    shared::IndexPacking packing;
    vk::Format format;
    uint32_t overlap;    ///< indices a pixel
    uint32_t mostIndex;  ///< largest index
    bool sorted;         ///< lights of one array never meet, so that nothing overflows

    uint32_t imageCount() const {
        return packing.kind == shared::kPackedBits ? packing.images * packing.passes : packing.images;
    }
};

/// The layout for a packing of settings `lidr-packing`, `overlap` and `indices` that tells `lights` lights apart if
/// there is one; else one that tells fewer. \throws Error(usage) if there is none for the settings, with those that
/// there are
IndexLayout indexLayout(const RenderSettings& settings, uint32_t lights);

/// Lights [slice) of the order, drawn into images [firstImage, firstImage + images).
struct IndexDraw {
    shared::LightSlice slice;
    uint8_t channels = 0xf;
    uint32_t firstImage = 0;
    uint32_t images = 1;
    uint32_t pass = 0;  ///< of a pixel: the lights of a pixel from pass * perPass on are those that are written
};

/// One filling of the images, and what of it comes when.
using IndexRound = std::vector<IndexDraw>;

struct IndexPlan {
    std::vector<uint32_t> order;                ///< of the light table: each light once
    std::vector<std::vector<IndexRound>> sets;  ///< of images: one, or one a type of light; their rounds
    shared::LightSlice rest{};                  ///< lights that every fragment looks at
    shared::LightSlice dropped{};               ///< lights that find no place (OnOverflow::priority)
    bool remapped = false;                      ///< an index is a place in the order instead of one in the table

    size_t rounds() const;
};

/// \param view null, or where lights of one array must not meet on the way to the eye either: the camera
/// \param oneRound lights that need a second round are dropped
IndexPlan planIndices(const RenderSettings& settings, const IndexLayout& layout, const SortedLights& lights,
                      const VolumeTables& volumes, const shared::ViewConstants* view, bool oneRound);

/// Colours of a graph, none of them next to its like: for each light of `lights` the number of the first array that
/// holds no light it overlaps (Trebilco 2009, "CPU Sorting"). \param pairsMayOverlap an array may hold lights that
/// overlap, but no three in one place
std::vector<uint32_t> sortIntoArrays(const std::vector<uint32_t>& lights,
                                     const std::vector<std::vector<uint32_t>>& overlaps, bool pairsMayOverlap);

}  // namespace luciole::render
