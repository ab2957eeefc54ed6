// Tiles of the picture and slices of their depth.
#ifndef LUCIOLE_LIGHT_TILES_GLSL
#define LUCIOLE_LIGHT_TILES_GLSL
#include "render/geometry/gbuffer.glsl"
#include "render/lighting/light_lists.shared.h"

uvec2 tilesOf(uint tileSize) {
    const uvec2 extent = uvec2(view.extent);
    return uvec2(tilesAcross(extent.x, tileSize), tilesAcross(extent.y, tileSize));
}
uint tileOf(uvec2 pixel, uint tileSize) { return pixel.y / tileSize * tilesOf(tileSize).x + pixel.x / tileSize; }

// The slice of a depth, counted from depth 0 on: four to an octave, as the bits of a float tell (exponential spacing but for the straight
// lines within an octave: distance is near / depth). Nobody rounds on the way, so all agree on the slice of a surface. Orthographic depth
// is linear in distance, and so are its slices.
const uint kSliceShift = 23u - kSlicesPerOctaveBits;
uint sliceFrom0(float depth) { return view.orthographic != 0u ? uint(depth * float(kSlices - 1u)) : floatBitsToUint(depth) >> kSliceShift; }
float sliceEnd(uint sliceFrom0_) {
    return view.orthographic != 0u ? float(sliceFrom0_) / float(kSlices - 1u) : uintBitsToFloat(sliceFrom0_ << kSliceShift);
}
uint sliceOf(float depth, float farthest) { return min(sliceFrom0(depth) - sliceFrom0(farthest), kSlices - 1u); }

// Whether there can be a surface: in perspective depth 0 is infinitely far.
bool holdsSurface(float depth) { return depth > 0.0 || view.orthographic != 0u; }

// Metres along the view axis; no more than what can be squared twice.
float distanceOf(float depth) {
    const vec2 z = vec2(view.clipFromView[2].z, view.clipFromView[3].z), w = vec2(view.clipFromView[2].w, view.clipFromView[3].w);
    const float far = 1e9;
    return depth > 0.0 || view.orthographic != 0u ? min((z.y - depth * w.y) / (z.x - depth * w.x), far) : far;
}
#endif
