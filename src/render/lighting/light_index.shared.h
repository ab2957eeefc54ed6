// Light-indexed deferred rendering (Trebilco 2009): what its shaders and its host code agree on. Read by both compilers.
#ifndef LUCIOLE_LIGHT_INDEX_SHARED_H
#define LUCIOLE_LIGHT_INDEX_SHARED_H
#include "render/lighting/light_volume.shared.h"
#include "render/lighting/prefix_sum.shared.h"
SHARED_BEGIN

// How light indices lie in the channels of the index images. Index i stands for light i - 1 of the table, 0 for none.
const uint kPackedBits = 0u;      // "Bit Shifting": each channel holds one digit of several indices
const uint kPackedChannels = 1u;  // "CPU Sorting": a channel an index
const uint kPackedExtremes = 2u;  // "Multi-pass Max Blend Equation": the largest index, 1 - the smallest

// The largest index that a packing holds.
SHARED_FN uint indexLimit(uint kind, uint indexBits, uint unit) { return kind == kPackedBits ? (1u << indexBits) - 1u : unit; }

// How much of a light arrives, packed as its index is (Trebilco 2009, "Shadow Maps": "Pre-pass"): 1 for none of it, 0 says that nothing is there.
SHARED_FN uint packedShare(float lit, uint limit) { return 1u + uint(lit * float(limit - 1u) + 0.5f); }
SHARED_FN float litShare(uint packedShare_, uint limit) { return float(packedShare_ - 1u) / float(limit - 1u); }

// What light volumes do about shadows while they write indices.
const uint kIndexLitOrNot = 0u;  // nothing
const uint kIndexIfLit = 1u;     // where less than half of the light arrives, there is no index
const uint kIndexShare = 2u;     // instead of the index, how much arrives

// Specialization constants, from 3 on in the passes that draw lights, from 8 on in those that draw surfaces.
struct IndexPacking {
    uint kind;
    uint indexBits;  // 4, 8 or 16
    uint entryBits;  // of an index in one channel
    uint perPass;    // indices that the images of one pass hold; a power of two for bits and extremes
    uint passes;
    uint images;     // of one pass
    uint unit;       // what 1 in an image stands for
};

// Sampled images and storage buffers by slot.
const uint kIndexDepth = 4u;       // where lights are drawn: the depth that decides
const uint kIndexImages = 0u;      // up to 4
const uint kIndexMoreImages = 5u;  // up to 4: those of the second type of light
const uint kIndexTables = 9u;      // 5 textures of light data (light_tables.frag)
const uint kIndexOrder = 0u;       // storage buffers: the lights in the order that they are drawn in
const uint kIndexShapes = 1u;      // by light: kShape*
const uint kIndexCounters = 2u;
const uint kIndexOffsets = 3u;     // by pixel: where its list begins; one more at the end
const uint kIndexEntries = 4u;
const uint kIndexCounts = 2u;      // by pixel, while lists are made

// All lights are drawn with one mesh, so that one draw keeps them in order; the fragment shader knows who is really inside.
const uint kIndexLod = 2u;

// How a light is drawn.
const uint kShapeNone = 0u;    // covers no pixel
const uint kShapeMesh = 1u;
const uint kShapeCut = 2u;     // the same, but the near plane cuts it
const uint kShapeScreen = 3u;  // the whole picture

// The shape that encloses a light: for one that a mesh bounds a ball around the mesh.
SHARED_FN LightShape indexShape(ViewConstants view, LightConstants light, vec4 meshBounds) {
    const LightShape plain = lightShape(light);
    const LightShape reach = inflate(plain, slackOf(view, plain));
    LightShape ball = {vec3(meshBounds), vec3(0, 0, 1), meshBounds.w, kHalfTurn};
    if (light.volume != kNoIndex) return ball;
    return reach;
}

SHARED_FN uint indexShapeOf(ViewConstants view, LightConstants light, LightShape shape) {
    const bool bounded = light.volume != kNoIndex || (light.type != kLightDirectional && light.range < kBoundless);
    if (!bounded) return kShapeScreen;
    const LightShape plain = lightShape(light);
    if (view.cullLights != 0u && !coversPixel(shapeBounds(view, shape).rectangle, view.extent)) return kShapeNone;
    const bool vague = light.volume == kNoIndex && slackOf(view, plain) > 0.25f * (length(plain.apex) + plain.radius);
    if (vague || volumeLod(radiusInPixels(view, boundingBall(shape))) == kVolumeScreen) return kShapeScreen;
    const vec4 around = meshBall(shape, kIndexLod);
    const bool before = view.orthographic != 0u || -around.z - around.w > 1.00001f * view.zNear;
    return before ? kShapeMesh : kShapeCut;
}

// Counters of a frame.
const uint kCounterPixels = kResultOver;     // over capacity
const uint kCounterPairs = kResultExcess;    // of a light and a pixel, over capacity
const uint kCounterMost = kResultMost;       // lights at one pixel
const uint kCounterEntries = kResultTotal;   // of the lists
const uint kCounterCount = kResultCount;

// What a light lost, after the counters: pairs, then its radiance in 2^-16, low and high word.
const uint kLostWords = 3u;

SHARED_END
#endif
