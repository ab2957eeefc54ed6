#include "render/shadow/shadow_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <luciole/error.hpp>
#include <ranges>

#include "hash.hpp"
#include "render/lighting/light_volume.shared.h"
#include "render/shadow/seen_space.hpp"
#include "render/tables.hpp"

namespace luciole::render {
namespace {

using namespace shared;

constexpr uint32_t kLeastSide = kPageUnit;  // texels
constexpr uint32_t kLargestAtlas = 16384;   // a side, as far as packed pages reach
constexpr uint32_t kUsualSide = 1024;     // largest of a light's maps that asks for no finer ones
constexpr uint32_t kSunSide = 2048;       // likewise of a cascade
constexpr double kWidestMap = 1.0;        // radians, half the angle of one map; wider spots have the faces of a cube
constexpr uint32_t kCascades = 4;
constexpr double kMostBorder = 4.0 / 3;   // so much wider is a map then
constexpr double kPixelsPerTexel = 2;     // where the light ends, if that lies no nearer to the eye than its range

uint64_t signature(const Hash& hash) { return hash.value() | 1; }  // 0 stands for nothing

uint64_t signatureOf(const ShadowFrustum& frustum, uint32_t linkGroup) {
    return signature(Hash().add(frustum.origin).add(frustum.right).add(frustum.down).add(frustum.forward).add(frustum.tangent).add(frustum.depth).add(linkGroup));
}

/// How far a box reaches along a direction.
double reachAlong(dvec3 direction, dvec3 halfSize) { return dot(abs(direction), halfSize); }

/// Whether a box may be seen from the light; never false for one that is.
bool sees(const ShadowFrustum& frustum, const Bounds& boundsWorld) {
    const dvec3 halfSize = 0.5 * (dvec3(boundsWorld.high) - dvec3(boundsWorld.low));
    const dvec3 center = 0.5 * (dvec3(boundsWorld.high) + dvec3(boundsWorld.low)) - frustum.origin;
    if (!frustum.orthographic) {
        const dvec3 nearest = max(abs(center) - halfSize, dvec3(0));
        if (dot(nearest, nearest) >= frustum.depth * frustum.depth) return false;
    }
    const auto outside = [&](dvec3 inwards, double offset) { return dot(inwards, center) + reachAlong(inwards, halfSize) < -offset; };
    for (const dvec3 side : {frustum.right, frustum.down})
        for (const double sign : {1.0, -1.0}) {
            if (frustum.orthographic ? outside(sign * side, frustum.tangent) : outside(kMostBorder * frustum.tangent * frustum.forward + sign * side, 0)) return false;
        }
    if (outside(frustum.forward, 0)) return false;
    return !frustum.orthographic || !outside(-frustum.forward, frustum.depth);
}

/// The power of two that is nearest in proportion.
uint32_t sideFor(double texels, double resolution, uint32_t usual, uint32_t largest) {
    const double most = std::min<double>(largest, std::max(double(kLeastSide), usual * resolution));
    const double wanted = std::clamp(texels * resolution, double(kLeastSide), most);
    return std::min(1u << uint32_t(std::lround(std::log2(wanted))), std::bit_floor(uint32_t(most)));
}

/// The axes of a map that looks along `forward`: those of a camera, so that front faces look alike.
void setAxes(ShadowFrustum& frustum, dvec3 forward) {
    const dmat3 axes(lookAt(vec3(0), vec3(normalize(forward))));
    frustum.right = axes[0];
    frustum.down = -axes[1];
    frustum.forward = -axes[2];
}

constexpr std::array kCubeAxes{dvec3(1, 0, 0), dvec3(-1, 0, 0), dvec3(0, 1, 0), dvec3(0, -1, 0), dvec3(0, 0, 1), dvec3(0, 0, -1)};  // cubeFaceOf

std::array<dvec3, 8> cornersOf(const Bounds& bounds) {
    std::array<dvec3, 8> corners;
    for (uint32_t i = 0; i < 8; ++i)
        corners[i] = {i & 1 ? bounds.high.x : bounds.low.x, i & 2 ? bounds.high.y : bounds.low.y, i & 4 ? bounds.high.z : bounds.low.z};
    return corners;
}

/// The atlas of at most so many texels, and so large that it holds `texels` if it can.
uvec2 extentFor(uint64_t texels, uint64_t most, uint32_t largestSide) {
    uvec2 extent(std::min(kUsualSide, std::bit_floor(largestSide)));
    while (uint64_t(extent.x) * extent.y < texels) {
        const uvec2 next = extent.x > extent.y ? uvec2(extent.x, 2 * extent.y) : uvec2(2 * extent.x, extent.y);
        if (uint64_t(next.x) * next.y > most || next.x > largestSide) break;
        extent = next;
    }
    while (uint64_t(extent.x) * extent.y > most) extent.x > extent.y ? extent.x /= 2 : extent.y /= 2;
    return max(extent, uvec2(kLeastSide));
}

uint64_t texelsOf(uint32_t side) { return uint64_t(side) * side; }

}  // namespace

bool ShadowPlan::Asked::operator==(const Asked& other) const {
    return view.camera == other.view.camera && view.extent == other.view.extent && settings == other.settings && version == other.version && largestSide == other.largestSide;
}

void ShadowPlan::forget() {
    kept_.clear();
    pages_ = PageAllocator(pages_.extent());
    last_.reset();
}

void ShadowPlan::update(const Inputs& in) {
    const Asked asked{in.view, in.settings, in.version, in.largestSide};
    if (last_ == asked && stats_.waiting.empty()) {
        dirty_.clear();
        stats_.drawn = stats_.casterDraws = 0;
        return;
    }
    last_.reset();  // an exception leaves the plan unfinished
    stats_ = {};
    maps_.clear();
    for (auto& [key, kept] : kept_) kept.wanted = false;
    collect(in);
    fit(in);
    placePages(in);
    chooseDirty(in);
    if (in.settings.onOverflow == OnOverflow::fail && !(stats_.lost.empty() && stats_.waiting.empty())) {
        const ShadowStats::Without first = stats_.lost.empty() ? stats_.waiting.front() : stats_.lost.front();
        forget();  // nothing of it will be drawn
        throw Error(ErrorKind::limit, fmt::format("shadows: {} lights go without theirs, the first of them light {} \"{}\": {}", stats_.lost.size() + stats_.waiting.size(),
                                                  first.light, in.lights[first.light].name, first.reason));
    }
    last_ = asked;
}

uint32_t ShadowPlan::mapsOf(const Light& light) {
    if (light.type == LightType::directional) return kCascades;
    return light.type == LightType::spot && light.outerConeAngle <= kWidestMap ? 1 : kShadowCubeFaces;
}

void ShadowPlan::collect(const Inputs& in) {
    if (std::ranges::count(in.casters, true, &ShadowCaster::casts) == 0) return;
    for (uint32_t i = 0; i < in.lights.size(); ++i) {
        const Light& light = in.lights[i];
        if (!light.castsShadows || light.color == vec3(0)) continue;
        light.type == LightType::directional ? collectDirectional(in, i) : collectLocal(in, i);
    }
}

void ShadowPlan::collectLocal(const Inputs& in, uint32_t index) {
    const Light& light = in.lights[index];
    const dvec3 position(light.positionWorld);
    const SeenSpace seen(in.view);
    double range = 0;  // how far there is anything
    for (const dvec3 corner : cornersOf(in.boundsWorld)) range = std::max(range, distance(position, corner));
    range = std::min(range, double(light.range));
    const bool spot = light.type == LightType::spot;
    const LightShape shape{light.positionWorld, spot ? vec3(normalize(dvec3(light.directionWorld))) : vec3(0, 0, 1), float(range), spot ? light.outerConeAngle : kHalfTurn};
    if (range <= kShadowNear || !seen.meets(dvec4(boundingBall(shape)) * dvec4(1, 1, 1, 1.001))) return;
    const uint32_t faces = mapsOf(light);
    const bool cube = faces > 1;
    const double metre = seen.pixelsPerMetre(position, range);
    for (uint32_t face = 0; face < faces; ++face) {
        ShadowFrustum frustum{.origin = position, .tangent = cube ? 1 : std::max(std::tan(double(light.outerConeAngle)), 1e-4), .depth = range};
        setAxes(frustum, cube ? kCubeAxes[face] : dvec3(shape.axis));
        const double cone = double(light.outerConeAngle) + std::acos(std::sqrt(1.0 / 3));  // a face lies within that angle of its axis
        if (cube && spot && cone < kHalfTurn && dot(dvec3(shape.axis), frustum.forward) < std::cos(cone)) continue;
        std::array<dvec3, 5> pyramid{position};
        for (uint32_t i = 0; i < 4; ++i)
            pyramid[i + 1] = position + range * (frustum.forward + frustum.tangent * ((i & 1 ? 1.0 : -1.0) * frustum.right + (i & 2 ? 1.0 : -1.0) * frustum.down));
        if (!seen.meets(pyramid)) continue;
        const double pixels = 2 * range * frustum.tangent * metre;
        add(in, {.light = index, .face = face, .frustum = frustum, .pixels = pixels, .side = sideFor(pixels / kPixelsPerTexel, light.shadowResolution, kUsualSide, in.largestSide)});
    }
}

// Cascades (Engel 2006, "Cascaded Shadow Maps"; where to split: Zhang et al. 2006, "Parallel-Split Shadow Maps"), each around a ball around its
// part of what is seen, so that it does not change while the camera turns, and moved in steps of whole texels.
void ShadowPlan::collectDirectional(const Inputs& in, uint32_t index) {
    const Light& light = in.lights[index];
    const Camera& camera = in.view.camera;
    ShadowFrustum whole{.orthographic = true};
    setAxes(whole, dvec3(light.directionWorld));
    dvec3 low(HUGE_VAL), high(-HUGE_VAL);  // along right, down, forward
    double farthest = 0;                   // along the view axis
    const dmat4 viewFromWorld = inverse(dmat4(camera.worldFromView));
    for (const dvec3 corner : cornersOf(in.boundsWorld)) {
        const dvec3 p(dot(corner, whole.right), dot(corner, whole.down), dot(corner, whole.forward));
        low = min(low, p);
        high = max(high, p);
        farthest = std::max(farthest, -(viewFromWorld * dvec4(corner, 1)).z);
    }
    const dvec3 margin = 1e-3 * (high - low) + 1e-3;
    low -= margin;
    high += margin;
    if (farthest <= 0) return;
    whole.depth = high.z - low.z;
    const double nearest = camera.orthographic ? camera.zNear : std::max<double>(camera.zNear, farthest * 1e-3);
    farthest = std::max(camera.orthographic ? std::min<double>(farthest, camera.zFar) : farthest, nearest * 1.001);
    const double aspect = double(in.view.extent.x) / in.view.extent.y;
    const double half = camera.orthographic ? camera.halfHeight : std::tan(0.5 * camera.yFov);
    const double corner = half * std::sqrt(1 + aspect * aspect);  // of the picture, from its middle, at a distance of 1
    const uint32_t side = sideFor(double(std::max(in.view.extent.x, in.view.extent.y)), light.shadowResolution, kSunSide, in.largestSide);
    const uint32_t cascades = camera.orthographic ? 1 : kCascades;
    double from = camera.orthographic ? nearest : 0;
    for (uint32_t cascade = 0; cascade < cascades; ++cascade) {
        const double share = double(cascade + 1) / cascades;
        const double to = 0.6 * nearest * std::pow(farthest / nearest, share) + 0.4 * std::lerp(nearest, farthest, share);
        // The smallest ball around the slice: in the middle, or around its far end where that is wider than the slice is deep.
        double middle = 0.5 * (from + to), radius = 0;
        if (camera.orthographic) {
            radius = std::hypot(corner, 0.5 * (to - from));
        } else {
            middle = std::min(to, 0.5 * (from + to) * (1 + corner * corner));
            radius = std::hypot(corner * to, to - middle);
        }
        const dvec3 center = dvec3(camera.worldFromView[3]) - middle * dvec3(camera.worldFromView[2]);
        ShadowFrustum frustum = whole;
        const bool all = radius >= 0.5 * std::max(high.x - low.x, high.y - low.y);
        frustum.tangent = all ? 0.5 * std::max(high.x - low.x, high.y - low.y) : radius;
        dvec2 at(0.5 * (low.x + high.x), 0.5 * (low.y + high.y));
        if (!all) {
            const double texel = 2 * frustum.tangent / (side - 2.0 * double(pageBorder(float(side))));
            at = round(dvec2(dot(center, whole.right), dot(center, whole.down)) / texel) * texel;
        }
        frustum.origin = at.x * whole.right + at.y * whole.down + low.z * whole.forward;
        add(in, {.light = index, .face = cascade, .frustum = frustum, .pixels = double(in.view.extent.y) / (1 + cascade), .side = side});
        if (all) break;
        from = to;
    }
}

void ShadowPlan::add(const Inputs& in, PlannedMap map) {
    Kept& kept = kept_[{map.light, map.face}];
    kept.wanted = true;
    const uint32_t group = in.lights[map.light].linkGroup;
    const uint64_t light = signatureOf(map.frustum, group);
    if (kept.casting == 0 || kept.lightSignature != light || kept.version != in.version) {
        Hash casting, standing;
        kept.anyCaster = kept.anyMoves = false;
        for (uint32_t i = 0; i < in.casters.size(); ++i) {
            if (!castsInto(in, map, i)) continue;
            kept.anyCaster = true;
            casting.add(i).add(in.casters[i].version);
            if (in.casters[i].version == 0)
                standing.add(i);
            else
                kept.anyMoves = true;
        }
        kept.lightSignature = light;
        kept.version = in.version;
        kept.casting = signature(casting.add(light));
        kept.standing = signature(standing.add(light));
    }
    if (!kept.anyCaster) map.side = 0;
    maps_.push_back(std::move(map));
}

bool ShadowPlan::castsInto(const Inputs& in, const PlannedMap& map, uint32_t caster) {
    const ShadowCaster& object = in.casters[caster];
    return object.casts && sees(map.frustum, object.boundsWorld) && in.castsFor(in.lights[map.light].linkGroup, object.objectId);
}

// Maps get coarser until all fit; only if not even the coarsest do, lights go without, those first that are least to be seen.
void ShadowPlan::fit(const Inputs& in) {
    anyMoves_ = std::ranges::any_of(in.casters, [](const ShadowCaster& caster) { return caster.casts && caster.version > 0; });
    const uint64_t most = (uint64_t(in.settings.shadowMemory) << 20) / sizeof(float) / (anyMoves_ ? 2 : 1);
    const uint32_t largestSide = std::min(in.largestSide, kLargestAtlas);
    const uvec2 largest = extentFor(UINT64_MAX, most, largestSide);
    const uint64_t capacity = uint64_t(largest.x) * largest.y;
    const auto sideAt = [&](uint32_t side, uint32_t coarser) { return side == 0 ? 0 : std::min(std::max(side >> coarser, kLeastSide), std::min(largest.x, largest.y)); };
    const auto texelsAt = [&](uint32_t coarser) {
        uint64_t texels = 0;
        for (const PlannedMap& map : maps_) texels += texelsOf(sideAt(map.side, coarser));
        return texels;
    };
    uint32_t coarser = 0;
    while (texelsAt(coarser) > capacity && texelsAt(coarser + 1) < texelsAt(coarser)) ++coarser;
    stats_.coarser = coarser;
    for (PlannedMap& map : maps_) map.side = sideAt(map.side, coarser);
    uint64_t texels = texelsAt(coarser);
    if (texels > capacity) {
        std::map<uint32_t, double> pixels;
        std::map<uint32_t, uint64_t> sizes;
        for (const PlannedMap& map : maps_) {
            pixels[map.light] = std::max(pixels[map.light], map.pixels);
            sizes[map.light] += texelsOf(map.side);
        }
        std::vector<uint32_t> order;
        for (const auto& [light, size] : sizes) order.push_back(light);
        std::ranges::stable_sort(order, {}, [&](uint32_t light) { return pixels[light]; });
        const bool byMemory = largest != extentFor(UINT64_MAX, UINT64_MAX, largestSide);
        const std::string where = byMemory ? fmt::format("{} MiB (shadow-memory)", in.settings.shadowMemory)
                                           : fmt::format("an image of {} x {} texels, the device's largest", largest.x, largest.y);
        std::map<uint32_t, bool> goes;
        for (const uint32_t light : order) {
            if (texels <= capacity) break;
            texels -= sizes[light];
            goes[light] = true;
            stats_.lost.push_back({light, fmt::format("the maps of all lights do not fit into {}, not at {} texels a side", where, kLeastSide)});
        }
        std::erase_if(maps_, [&](const PlannedMap& map) { return goes.contains(map.light); });
    }
    const uvec2 wanted = extentFor(texels, most, largestSide);
    const uvec2 have = pages_.extent();
    if (uint64_t(wanted.x) * wanted.y > uint64_t(have.x) * have.y || uint64_t(have.x) * have.y > most) {
        kept_ = {};
        pages_ = PageAllocator(wanted);
        std::vector<PlannedMap> again = std::move(maps_);
        maps_.clear();
        for (PlannedMap& map : again) {
            const uint32_t side = map.side;
            add(in, std::move(map));
            maps_.back().side = side;
        }
    }
    stats_.texels = texels;
}

/// Whether a map's page has the size for it. One size too large is as good, and moving closer and back again draws nothing anew.
bool ShadowPlan::fits(const PlannedMap& map, const Kept& kept) const {
    return kept.page.side == map.side || (kept.page.side == 2 * map.side && stats_.coarser == 0);
}

/// The maps that have to be drawn, the most visible first. What waits counts for more with each frame, so that no map waits for ever.
std::vector<uint32_t> ShadowPlan::due(const Inputs& in) const {
    std::vector<uint32_t> found;
    for (uint32_t i = 0; i < maps_.size(); ++i) {
        if (maps_[i].side == 0) continue;
        const Kept& kept = kept_.at({maps_[i].light, maps_[i].face});
        if (!fits(maps_[i], kept) || kept.drawn != signatureOfPage(in, kept.page, kept.casting)) found.push_back(i);
    }
    std::ranges::stable_sort(found, std::greater{}, [&](uint32_t i) {
        return std::max(maps_[i].pixels, 1.0) * (1 + kept_.at({maps_[i].light, maps_[i].face}).waited);
    });
    return found;
}

void ShadowPlan::placePages(const Inputs& in) {
    std::vector<bool> waits(maps_.size());  // in a page of whatever size: it holds something
    if (const uint32_t most = in.settings.shadowRedraws; most != 0) {
        const std::vector<uint32_t> order = due(in);
        for (const uint32_t i : order | std::views::drop(most)) waits[i] = true;
    }
    const auto free = [&](Kept& kept) {
        if (kept.page.side != 0) pages_.free(kept.page);
        kept.page = {};
        kept.drawn = kept.still = 0;
    };
    std::vector<PlannedMap*> missing;
    for (uint32_t i = 0; i < maps_.size(); ++i) {
        PlannedMap& map = maps_[i];
        Kept& kept = kept_.at({map.light, map.face});
        if (!fits(map, kept) && !waits[i]) free(kept);
        if (kept.page.side == 0 && map.side != 0) missing.push_back(&map);
    }
    std::ranges::stable_sort(missing, std::greater{}, &PlannedMap::side);
    const auto allocateAll = [&] {
        for (PlannedMap* map : missing) {
            Kept& kept = kept_.at({map->light, map->face});
            if (kept.page.side != 0) continue;
            const std::optional<Page> page = pages_.allocate(map->side);
            if (!page) return false;
            kept.page = *page;
        }
        return true;
    };
    if (!allocateAll()) {
        // First what this frame does not need goes; then everything is packed anew, by falling size, which leaves no gap.
        for (auto& [key, kept] : kept_)
            if (!kept.wanted) free(kept);
        if (!allocateAll()) {
            for (auto& [key, kept] : kept_) kept.page = {}, kept.drawn = kept.still = 0;
            pages_ = PageAllocator(pages_.extent());
            missing.clear();
            for (PlannedMap& map : maps_)
                if (map.side != 0) missing.push_back(&map);
            std::ranges::stable_sort(missing, std::greater{}, &PlannedMap::side);
            allocateAll();
        }
    }
    std::erase_if(kept_, [](const auto& entry) { return !entry.second.wanted && entry.second.page.side == 0; });
    for (PlannedMap& map : maps_) map.page = kept_.at({map.light, map.face}).page;
}

uint64_t ShadowPlan::signatureOfPage(const Inputs& in, const Page& page, uint64_t casting) {
    return signature(Hash().add(casting).add(page.first).add(page.side).add(uint32_t(in.settings.shadowCasters)));
}

void ShadowPlan::chooseDirty(const Inputs& in) {
    for (PlannedMap& map : maps_) {
        if (map.side == 0) continue;
        ++stats_.maps;
        map.drawn = kept_.at({map.light, map.face}).drawn != 0;
    }
    dirty_ = due(in);
    if (const uint32_t most = in.settings.shadowRedraws; most != 0 && dirty_.size() > most) {
        std::vector<bool> told(in.lights.size());
        for (const uint32_t i : std::span(dirty_).subspan(most)) {
            PlannedMap& map = maps_[i];
            Kept& kept = kept_.at({map.light, map.face});
            if (map.drawn) map.frustum = kept.frustum;
            ++kept.waited;
            if (!told[map.light])
                stats_.waiting.push_back({map.light, fmt::format("its map waits to be drawn, as {} a frame are (shadow-redraws)", most)});
            told[map.light] = true;
        }
        dirty_.resize(most);
    }
    for (const uint32_t i : dirty_) {
        PlannedMap& map = maps_[i];
        Kept& kept = kept_.at({map.light, map.face});
        kept.frustum = map.frustum;
        kept.waited = 0;
        map.overStill = kept.anyMoves;
        map.stillDirty = kept.anyMoves && kept.still != signatureOfPage(in, map.page, kept.standing);
        for (uint32_t caster = 0; caster < in.casters.size(); ++caster) {
            if (!castsInto(in, map, caster)) continue;
            if (!map.overStill || in.casters[caster].version > 0)
                map.casters.push_back(caster);
            else if (map.stillDirty)
                map.stillCasters.push_back(caster);
        }
        if (map.stillDirty) kept.still = signatureOfPage(in, map.page, kept.standing);
        kept.drawn = signatureOfPage(in, map.page, kept.casting);
        map.drawn = true;
        ++stats_.drawn;
    }
    std::vector<uint32_t> lights;
    for (const PlannedMap& map : maps_)
        if (lights.empty() || lights.back() != map.light) lights.push_back(map.light);
    stats_.lights = uint32_t(lights.size());
}

namespace {

/// Half the width of what the page shows, at a distance of 1: what the light needs, and the border for taps.
double halfWidth(const PlannedMap& map) {
    const double side = map.page.side;
    return map.frustum.tangent * side / (side - 2 * pageBorder(float(side)));
}

/// From the light (axes of world space) to the clip space of the page. \param origin of positions, world space
dmat4 clipFromLight(const PlannedMap& map, dvec3 origin) {
    const ShadowFrustum& f = map.frustum;
    const double half = halfWidth(map);
    dmat4 rows(0);  // transposed below
    rows[0] = dvec4(f.right / half, 0);
    rows[1] = dvec4(f.down / half, 0);
    if (f.orthographic) {
        rows[2] = dvec4(-f.forward / f.depth, 1);
        rows[3] = dvec4(0, 0, 0, 1);
    } else {
        rows[2] = dvec4(0, 0, 0, kShadowMapNear);
        rows[3] = dvec4(f.forward, 0);
    }
    dmat4 move(1);
    move[3] = dvec4(origin - f.origin, 1);
    return transpose(rows) * move;
}

}  // namespace

shared::ShadowPush ShadowPlan::push(const PlannedMap& map) {
    const vec3 origin(map.frustum.origin);
    return {mat4(clipFromLight(map, dvec3(origin))), origin};
}

shared::ShadowMap ShadowPlan::constants(const PlannedMap& map, float softness, dvec3 eyeWorld) {
    shared::ShadowMap result{};
    if (map.page.side == 0 || !map.drawn) return result;
    const ShadowFrustum& f = map.frustum;
    result.page = packPage(map.page.first, uint32_t(std::countr_zero(map.page.side)), softness);
    result.scale = float(0.5 * map.page.side / halfWidth(map));
    result.right = vec3(f.right);
    result.down = vec3(f.down);
    result.forward = vec3(f.forward);
    result.origin = vec3(f.origin - eyeWorld);
    result.fall = float(1 / f.depth);
    return result;
}

}  // namespace luciole::render
