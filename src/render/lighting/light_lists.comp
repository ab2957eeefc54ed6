#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_tiles.glsl"
#include "render/lighting/light_tree.shared.h"
#include "render/lighting/light_volume.glsl"

// The lights that may reach a tile or a cluster, found in the hierarchy over the lights (Olsson et al. 2012, section 4.4), which is
// gone through in the order of the table. Twice: the lists' lengths first, then, when each has got its place, the lists.
// Variants: CLUSTERED, a list for each cluster instead of each tile; FILL, the second time.
layout(constant_id = 3) const uint kTileSize = 16u;
layout(constant_id = 4) const uint kParts = 1u;
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ListPush push; };
layout(set = 1, binding = kPassStorage + kListTiles, scalar) readonly buffer Tiles { Tile tiles[]; };
#ifdef CLUSTERED
layout(set = 1, binding = kPassStorage + kListFirstClusters, scalar) readonly buffer FirstClusters { uint firstClusters[]; };
layout(set = 1, binding = kPassStorage + kListClusters, scalar) readonly buffer Clusters { uint clusters[]; };
const bool kClustered = true;
#else
const bool kClustered = false;
#endif
#ifdef FILL
layout(set = 1, binding = kPassStorage + kListOffsets, scalar) readonly buffer Offsets { uint offsets[]; };
layout(set = 1, binding = kPassStorage + kListEntries, scalar) writeonly buffer Entries { uint entries[]; };
layout(set = 1, binding = kPassStorage + kListCounts, scalar) buffer Counters { uint counters[]; };
#else
layout(set = 1, binding = kPassStorage + kListCounts, scalar) writeonly buffer Counts { uint counts[]; };
#endif

// What a list's lights have to touch: the part of a tile's frustum between two distances. Sideways by slopes, x / distance, in an
// orthographic view by x; y counts downwards, as in the picture.
struct Cell {
    vec2 low, high;
    vec2 inverseLow, inverseHigh;  // 1 / sqrt(1 + slope^2)
    float near, far;
    float slack;                   // that a surface in here may seem to be away from where it is
    vec3 boxLow, boxHigh;          // x, y, distance
    uint slices;                   // those that count, from the tile's farthest on; of a cluster all
    float farthest;                // depth
};

Cell cellOf(uint tileIndex, uint slice) {
    const Tile tile = tiles[tileIndex];
    const uvec2 at = uvec2(tileIndex % tilesOf(kTileSize).x, tileIndex / tilesOf(kTileSize).x) * kTileSize;
    Cell cell;
    cell.low = (vec2(at) / view.extent * 2.0 - 1.0) / view.clipScale;
    cell.high = (vec2(min(at + kTileSize, uvec2(view.extent))) / view.extent * 2.0 - 1.0) / view.clipScale;
    cell.inverseLow = inversesqrt(1.0 + cell.low * cell.low);
    cell.inverseHigh = inversesqrt(1.0 + cell.high * cell.high);
    vec2 depths = vec2(tile.farthest, tile.nearest);
    cell.slices = tile.slices;
    cell.farthest = tile.farthest;
    if (kClustered) {
        const uint first = sliceFrom0(tile.farthest) + slice;
        depths.x = max(depths.x, sliceEnd(first));
        if (slice < kSlices - 1u) depths.y = min(depths.y, sliceEnd(first + 1u));
        cell.slices = ~0u;
    }
    cell.near = distanceOf(depths.y);
    cell.far = distanceOf(depths.x);
    const vec2 atNear = view.orthographic != 0u ? vec2(1) : vec2(cell.near);
    const vec2 atFar = view.orthographic != 0u ? vec2(1) : vec2(cell.far);
    cell.boxLow = vec3(min(cell.low * atNear, cell.low * atFar), cell.near);
    cell.boxHigh = vec3(max(cell.high * atNear, cell.high * atFar), cell.far);
    // As slackOf, which looks from the lights' side, with what distances round here.
    const float farthest = length(vec3(max(abs(cell.boxLow.xy), abs(cell.boxHigh.xy)), cell.far));
    cell.slack = view.slack.x + farthest * (view.slack.y + farthest * (view.slack.z + view.slack.w / max(view.zNear, cell.near)));
    return cell;
}

float depthAt(float distance_) {
    const vec2 clip = view.clipFromView[2].zw * -distance_ + view.clipFromView[3].zw;
    return clamp(clip.x / clip.y, 0.0, 1.0);
}

// Whether a ball touches the cell's box and the sides of its frustum. \param ball view space
bool touches(Cell cell, vec4 ball) {
    const vec3 center = vec3(ball.x, -ball.y, -ball.z);
    const vec3 away = center - clamp(center, cell.boxLow, cell.boxHigh);
    bool hit = dot(away, away) <= ball.w * ball.w;
    if (view.orthographic == 0u) {
        const vec2 beyondLow = (cell.low * center.z - center.xy) * cell.inverseLow;
        const vec2 beyondHigh = (center.xy - cell.high * center.z) * cell.inverseHigh;
        hit = hit && max(max(beyondLow.x, beyondLow.y), max(beyondHigh.x, beyondHigh.y)) <= ball.w;
    }
    return hit;
}

// Whether a ball touches a slice that counts. A little more than the ball, for what depths round.
bool touchesSlices(Cell cell, vec4 ball) {
    const float near = max(-ball.z - ball.w, cell.near) * 0.99999;
    const float far = min(-ball.z + ball.w, cell.far) * 1.00001;
    const uint last = sliceOf(max(depthAt(near), cell.farthest), cell.farthest);
    const uint first = sliceOf(max(depthAt(far), cell.farthest), cell.farthest);
    return (cell.slices & bitfieldInsert(0u, ~0u, int(first), int(last + 1u - min(first, last)))) != 0u;
}

// Whether a cone's inside comes as near to the cell as the ball around its box is large.
bool coneTouches(Cell cell, LightShape shape) {
    const vec3 center = 0.5 * (cell.boxLow + cell.boxHigh) * vec3(1, -1, -1);
    const float radius = 0.5 * distance(cell.boxLow, cell.boxHigh);
    const vec3 v = center - shape.apex;
    const float along = dot(v, shape.axis);
    const float across = sqrt(max(dot(v, v) - along * along, 0.0));
    return across * cos(shape.angle) - along * sin(shape.angle) <= radius * 1.0001;
}

// What floats round of distances from a ball.
float rounding(vec3 center, float radius) { return 4e-6 * (abs(center.x) + abs(center.y) + abs(center.z) + radius); }

bool lightTouches(Cell cell, uint index) {
    const LightConstants light = lightInView(index);
    if ((kLights & kUsesVolumes) != 0u && light.volume != kNoIndex) return touches(cell, volumeBall(view, volumes[light.volume]));
    if (light.type == kLightDirectional || light.range >= kBoundless) return true;
    const LightShape plain = shapeOf(light);
    const LightShape shape = inflate(plain, cell.slack + rounding(plain.apex, plain.radius));
    const vec4 ball = boundingBall(shape);
    bool hit = touches(cell, ball);
    if (!kClustered) hit = hit && touchesSlices(cell, ball);
    if ((kLights & kUsesSpot) != 0u && light.type == kLightSpot) hit = hit && coneTouches(cell, shape);
    return hit;
}

bool nodeTouches(Cell cell, uint place) {
    const vec4 ball = texelFetch(lightTree, ivec2(place % kTreeWidth, place / kTreeWidth), 0);
    const vec3 center = mat3(view.viewFromWorld) * (ball.xyz - view.worldFromView[3].xyz);
    return ball.w >= kBoundless || touches(cell, vec4(center, ball.w + cell.slack + rounding(center, ball.w)));
}

void main() {
    const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    const uint index = group / kParts * 64u + gl_LocalInvocationIndex;
    const uint part = group % kParts;
#ifdef CLUSTERED
    const uint lists = firstClusters[push.tiles];
    if (index >= lists) return;
    const uint tile = clusters[index] >> kSliceBits;
    const uint slice = clusters[index] & (kSlices - 1u);
#else
    const uint lists = push.tiles;
    if (index >= lists) return;
    const uint tile = index, slice = 0u;
#endif
    const Cell cell = cellOf(tile, slice);
    const uint partLights = 1u << (kTreeBits * push.rootLevel);
    uint light = push.first + part * partLights;
    const uint end = tiles[tile].slices != 0u ? min(light + partLights, push.first + push.count) : 0u;
    const uint list = index * kParts + part;
#ifdef FILL
    uint place = offsets[list];
    const uint room = uint(entries.length());  // the host sees how much is missing
    if (part == 0u) atomicMax(counters[kListLongest], offsets[(index + 1u) * kParts] - offsets[index * kParts]);
    if (list == 0u) {
        counters[kListFound] = lists;
        const uint more = offsets[lists * kParts];
        counters[kListAllEntries] += more;
        if (counters[kListAllEntries] < more) ++counters[kListAllEntriesHigh];
    }
#else
    uint place = 0u;
#endif
    // Depth first, without a stack: whether a node is done with, the next light's number tells.
    uint level = push.rootLevel;
    uint node = treePlace(level, light);
    while (light < end) {
        const bool hit = level > 0u ? nodeTouches(cell, node) : lightTouches(cell, light);
        if (hit && level > 0u) {
            --level;
            ++node;
            continue;
        }
        if (level > 0u) node += treeSize(level);
        if (hit) {
#ifdef FILL
            if (place < room) entries[place] = light;
#endif
            ++place;
        }
        light = ((light >> (kTreeBits * level)) + 1u) << (kTreeBits * level);
        level = min(push.rootLevel, uint(findLSB(light)) / kTreeBits);
    }
#ifndef FILL
    counts[list] = place;
#endif
}
