#include "render/lighting/light_index_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <luciole/error.hpp>
#include <numeric>

namespace luciole::render {

using namespace shared;

namespace {

/// Trebilco 2009, Table 2.9.1, as one rule. An index of `indexBits` bits is cut into digits of 8 / overlap bits, a
/// channel each; beyond eight indices a second pass fills as many images again. What needs more than 16 channels, or no
/// channel whole, is not in the table.
std::optional<IndexLayout> bitShiftLayout(uint32_t overlap, uint32_t indexBits) {
    if (!std::has_single_bit(overlap) || overlap > 16) return std::nullopt;
    IndexPacking packing{.kind = kPackedBits, .indexBits = indexBits, .perPass = std::min(overlap, 8u), .unit = 255};
    packing.entryBits = 8 / packing.perPass;
    packing.passes = overlap / packing.perPass;
    const uint32_t channels = indexBits / packing.entryBits;
    if (channels == 0 || channels * packing.passes > 16) return std::nullopt;
    packing.images = (channels + 3) / 4;
    const vk::Format formats[] = {vk::Format::eUndefined, vk::Format::eR8Unorm, vk::Format::eR8G8Unorm,
                                  vk::Format::eR8G8B8A8Unorm, vk::Format::eR8G8B8A8Unorm};
    return IndexLayout{packing, formats[std::min(channels, 4u)], overlap, (1u << indexBits) - 1, false};
}

/// A channel an index, or two for a pair of extremes.
IndexLayout channelLayout(uint32_t kind, uint32_t channels, uint32_t indexBits, uint32_t perPass, uint32_t passes) {
    const bool wide = indexBits == 16;
    const vk::Format narrowFormats[] = {vk::Format::eR8Unorm, vk::Format::eR8G8Unorm, vk::Format::eR8G8B8A8Unorm};
    const vk::Format wideFormats[] = {vk::Format::eR16Unorm, vk::Format::eR16G16Unorm, vk::Format::eR16G16B16A16Unorm};
    const uint32_t format = channels < 3 ? channels - 1 : 2;
    const IndexPacking packing{.kind = kind,
                               .indexBits = std::max(indexBits, 8u),
                               .entryBits = std::max(indexBits, 8u),
                               .perPass = perPass,
                               .passes = passes,
                               .images = (channels + 3) / 4,
                               .unit = wide ? 65535u : 255u};
    return {packing, wide ? wideFormats[format] : narrowFormats[format], perPass * passes, wide ? 65535u : 255u, true};
}

std::optional<IndexLayout> layoutFor(LidrPacking packing, uint32_t overlap, uint32_t indexBits) {
    switch (packing) {
        case LidrPacking::bitShift:
            return bitShiftLayout(overlap, indexBits);
        case LidrPacking::cpuSort:
            return channelLayout(kPackedChannels, overlap, indexBits, overlap, 1);
        default: {
            const bool sorted = packing == LidrPacking::maxBlendSorted;
            if (overlap != 4 && (sorted || overlap != 2)) return std::nullopt;
            IndexLayout layout = channelLayout(kPackedExtremes, overlap, indexBits, 2, overlap / 2);
            layout.sorted = sorted;
            return layout;
        }
    }
}

}  // namespace

namespace {

/// The layout in the light buffer itself: a float in [0, 1) keeps the digits of a channel, as so many 256ths.
IndexLayout inLightBuffer(IndexLayout layout, LightBufferFormat format) {
    if (layout.packing.kind != kPackedBits || layout.format != vk::Format::eR8G8B8A8Unorm || layout.imageCount() != 1)
        throw Error(ErrorKind::usage,
                    "lidr-share: expected a packing of four channels, bit-shift 8x15, 4x255 or 2x65535");
    layout.format =
        format == LightBufferFormat::rgba32f ? vk::Format::eR32G32B32A32Sfloat : vk::Format::eR16G16B16A16Sfloat;
    layout.packing.unit = 256;
    return layout;
}

}  // namespace

IndexLayout indexLayout(const RenderSettings& settings, uint32_t lights) {
    constexpr uint32_t kBits[] = {4, 8, 16};
    const auto wanted = [&](uint32_t bits) {
        return settings.indices == LidrIndices::automatic || kBits[uint32_t(settings.indices) - 1] == bits;
    };
    std::optional<IndexLayout> best;
    for (const uint32_t bits : kBits) {
        if (!wanted(bits)) continue;
        const auto layout = layoutFor(settings.lidrPacking, settings.overlap, bits);
        if (layout && (!best || best->mostIndex < lights)) best = layout;
    }
    if (best) return settings.lidrShare ? inLightBuffer(*best, settings.lightBuffer) : *best;
    std::string rows;
    for (const uint32_t bits : kBits)
        for (uint32_t overlap = 1; overlap <= 16; ++overlap)
            if (layoutFor(settings.lidrPacking, overlap, bits))
                rows += fmt::format(" {}x{}", overlap, (1u << bits) - 1);
    throw Error(ErrorKind::usage,
                fmt::format("lidr-packing: expected an overlap and indices out of{}, got {}x{}", rows, settings.overlap,
                            settings.indices == LidrIndices::automatic
                                ? "auto"
                                : std::to_string((1u << kBits[uint32_t(settings.indices) - 1]) - 1)));
}

size_t IndexPlan::rounds() const {
    size_t most = 1;
    for (const auto& set : sets) most = std::max(most, set.size());
    return most;
}

namespace {

/// A box that two lights have to share if they are to meet: in the world, or on the screen.
struct Box {
    dvec3 low, high;
    dvec4 ball;  ///< in the world; radius < 0: none
};

/// Pairs of boxes that overlap, by a sweep along x: for each light its neighbours.
std::vector<std::vector<uint32_t>> overlapsOf(const std::vector<Box>& boxes) {
    std::vector<std::vector<uint32_t>> overlaps(boxes.size());
    std::vector<uint32_t> byLow(boxes.size());
    std::iota(byLow.begin(), byLow.end(), 0u);
    std::ranges::sort(byLow, {}, [&](uint32_t i) { return std::pair(boxes[i].low.x, i); });
    for (size_t k = 0; k < byLow.size(); ++k)
        for (size_t l = k + 1; l < byLow.size() && boxes[byLow[l]].low.x <= boxes[byLow[k]].high.x; ++l) {
            const Box &a = boxes[byLow[k]], &b = boxes[byLow[l]];
            if (a.high.y < b.low.y || b.high.y < a.low.y || a.high.z < b.low.z || b.high.z < a.low.z) continue;
            // Floats may round where the shader tests ranges.
            const double reach =
                (a.ball.w + b.ball.w) * (1 + 1e-5) + 1e-6 * (length(dvec3(a.ball)) + length(dvec3(b.ball)));
            if (a.ball.w >= 0 && b.ball.w >= 0 && length(dvec3(a.ball) - dvec3(b.ball)) > reach) continue;
            overlaps[byLow[k]].push_back(byLow[l]);
            overlaps[byLow[l]].push_back(byLow[k]);
        }
    return overlaps;
}

Box everywhere() { return {dvec3(-INFINITY), dvec3(INFINITY), dvec4(0, 0, 0, -1)}; }

Box boxInWorld(const LightConstants& light, const VolumeTables& volumes) {
    dvec4 ball;
    if (light.volume != kNoIndex) {
        const VolumeConstants& volume = volumes.volumes[light.volume];
        ball = dvec4(0.5 * (dvec3(volume.low) + dvec3(volume.high)),
                     0.5 * distance(dvec3(volume.low), dvec3(volume.high)));
    } else if (light.type != kLightDirectional && light.range < kBoundless) {
        ball = dvec4(boundingBall(lightShape(light)));
    } else {
        return everywhere();
    }
    return {dvec3(ball) - ball.w * (1 + 1e-5), dvec3(ball) + ball.w * (1 + 1e-5), ball};
}

Box boxOnScreen(const LightConstants& source, const VolumeTables& volumes, const ViewConstants& view) {
    const LightConstants light = inView(source, view.viewFromWorld, vec3(view.worldFromView[3]));
    const vec4 mesh = light.volume != kNoIndex ? volumeBall(view, volumes.volumes[light.volume]) : vec4(0);
    const LightShape shape = indexShape(view, light, mesh);
    const uint how = indexShapeOf(view, light, shape);
    if (how == kShapeScreen) return everywhere();
    if (how == kShapeNone) return {dvec3(INFINITY), dvec3(-INFINITY), dvec4(0, 0, 0, -1)};
    const vec4 bounds = projectedBounds(view, meshBall(shape, kIndexLod));
    return {dvec3(bounds.x - 1e-5, bounds.y - 1e-5, 0), dvec3(bounds.z + 1e-5, bounds.w + 1e-5, 0), dvec4(0, 0, 0, -1)};
}

/// What a light brings to the picture, about: its strength times how far it reaches.
float importanceOf(const LightConstants& light) {
    return dot(light.color, vec3(0.2126f, 0.7152f, 0.0722f)) * std::min(light.range, kBoundless);
}

}  // namespace

std::vector<uint32_t> sortIntoArrays(const std::vector<uint32_t>& lights,
                                     const std::vector<std::vector<uint32_t>>& overlaps, bool pairsMayOverlap) {
    std::vector<uint32_t> arrayOf(overlaps.size(), kNoIndex);
    for (const uint32_t light : lights) {
        // The neighbours in each array that has any.
        std::vector<std::vector<uint32_t>> met;
        for (const uint32_t other : overlaps[light]) {
            const uint32_t array = arrayOf[other];
            if (array == kNoIndex) continue;
            if (met.size() <= array) met.resize(array + 1);
            met[array].push_back(other);
        }
        const auto takes = [&](const std::vector<uint32_t>& neighbours) {
            if (!pairsMayOverlap) return neighbours.empty();
            for (const uint32_t a : neighbours)
                for (const uint32_t b : neighbours)
                    if (std::ranges::find(overlaps[a], b) != overlaps[a].end()) return false;
            return true;
        };
        uint32_t array = 0;
        while (array < met.size() && !takes(met[array])) ++array;
        arrayOf[light] = array;
    }
    return arrayOf;
}

IndexPlan planIndices(const RenderSettings& settings, const IndexLayout& layout, const SortedLights& lights,
                      const VolumeTables& volumes, const ViewConstants* view, bool oneRound) {
    const auto count = uint32_t(lights.sources.size());
    // Which set of images a light is drawn into; kNoIndex: none.
    const auto setOf = [&](uint32_t i) -> uint32_t {
        const uint32_t type = lights.at(i).type;
        if (settings.lidrTypes == LidrTypes::flag) return 0;
        const bool shaped = i >= lights.unbounded && i < lights.unbounded + lights.shaped;
        if (shaped && type == kLightPoint) return 0;
        return shaped && type == kLightSpot && settings.lidrTypes == LidrTypes::targets ? 1 : kNoIndex;
    };
    std::vector<std::vector<uint32_t>> drawn(settings.lidrTypes == LidrTypes::targets ? 2 : 1);
    std::vector<uint32_t> rest;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t set = setOf(i);
        (set == kNoIndex ? rest : drawn[set]).push_back(i);
    }

    IndexPlan plan;
    std::vector<uint32_t> dropped;
    const bool byImportance = settings.onOverflow == OnOverflow::priority;
    plan.remapped = byImportance && count > layout.mostIndex;
    if (byImportance)
        for (auto& set : drawn)
            std::ranges::stable_sort(set, std::greater<>{}, [&](uint32_t i) { return importanceOf(lights.at(i)); });
    if (plan.remapped) {
        uint32_t room = layout.mostIndex;
        for (auto& set : drawn) {
            const uint32_t kept = std::min(room, uint32_t(set.size()));
            dropped.insert(dropped.end(), set.begin() + kept, set.end());
            set.resize(kept);
            room -= kept;
        }
    }

    const bool sorted = layout.sorted;
    const bool extremes = layout.packing.kind == kPackedExtremes;
    std::vector<std::vector<uint32_t>> overlaps;
    if (sorted) {
        std::vector<Box> boxes;
        for (uint32_t i = 0; i < count; ++i)
            boxes.push_back(view ? boxOnScreen(lights.at(i), volumes, *view) : boxInWorld(lights.at(i), volumes));
        overlaps = overlapsOf(boxes);
    }
    const uint32_t arrays = extremes ? layout.packing.passes : layout.overlap;
    for (const auto& set : drawn) {
        std::vector<IndexRound>& rounds = plan.sets.emplace_back();
        const auto append = [&](const std::vector<uint32_t>& some) {
            const LightSlice slice{uint32_t(plan.order.size()), uint32_t(some.size())};
            plan.order.insert(plan.order.end(), some.begin(), some.end());
            return slice;
        };
        if (!sorted) {
            const LightSlice slice = append(set);
            IndexRound& round = rounds.emplace_back();
            for (uint32_t pass = 0; pass < layout.packing.passes; ++pass) {
                if (extremes)
                    round.push_back({slice, uint8_t(pass == 0 ? 0x3 : 0xc), 0, 1, pass});
                else
                    round.push_back({slice, 0xf, pass * layout.packing.images, layout.packing.images, pass});
            }
            continue;
        }
        const std::vector<uint32_t> arrayOf = sortIntoArrays(set, overlaps, extremes);
        std::vector<std::vector<uint32_t>> members;
        for (const uint32_t light : set) {
            if (oneRound && arrayOf[light] >= arrays) {
                dropped.push_back(light);
                continue;
            }
            if (members.size() <= arrayOf[light]) members.resize(arrayOf[light] + 1);
            members[arrayOf[light]].push_back(light);
        }
        rounds.resize(std::max<size_t>(1, (members.size() + arrays - 1) / arrays));
        for (uint32_t array = 0; array < members.size(); ++array) {
            const uint32_t place = array % arrays;
            IndexDraw draw{append(members[array])};
            draw.channels = uint8_t(extremes ? (place == 0 ? 0x3 : 0xc) : 1u << (place % 4));
            draw.firstImage = extremes ? 0 : place / 4;
            rounds[array / arrays].push_back(draw);
        }
    }
    plan.rest = {uint32_t(plan.order.size()), uint32_t(rest.size())};
    plan.order.insert(plan.order.end(), rest.begin(), rest.end());
    plan.dropped = {uint32_t(plan.order.size()), uint32_t(dropped.size())};
    plan.order.insert(plan.order.end(), dropped.begin(), dropped.end());
    return plan;
}

}  // namespace luciole::render
