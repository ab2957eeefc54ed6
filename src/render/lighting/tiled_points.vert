#version 460
#extension GL_GOOGLE_include_directive : require
#define WITHOUT_PIXELS
#extension GL_EXT_control_flow_attributes : require
#include "render/lighting/light_texels.glsl"
#include "render/lighting/light_tiles.glsl"
#include "render/lighting/tiled_points.shared.h"

// A point as large as a tile, which brings along the lights of a batch.
layout(constant_id = 3) const uint kTileSize = 16u;
layout(constant_id = 4) const uint kBatchLights = 1u;
layout(set = 1, binding = kPassStorage + kBatches, scalar) readonly buffer Batches { Batch batches[]; };
layout(set = 1, binding = kPassStorage + kListEntries, scalar) readonly buffer Entries { uint entries[]; };
layout(location = 0) flat out uvec2 lightsAndFirst;
layout(location = 1) flat out vec4 texels[kBatchTexels];

void main() {
    const Batch batch = batches[gl_VertexIndex];
    const uvec2 across = tilesOf(kTileSize);
    const vec2 center = (vec2(batch.tile % across.x, batch.tile / across.x) + 0.5) / vec2(across);  // the viewport ends with the last tiles
    gl_Position = vec4(center * 2.0 - 1.0, 0, 1);
    gl_PointSize = float(kTileSize);
    lightsAndFirst = uvec2(batch.lights, batch.first);
    const uint each = texelsOfLight(kLights);
    [[unroll]] for (uint i = 0u; i < kBatchTexels / 2u; ++i) {
        if (i >= kBatchLights) break;
        LightTexels light = LightTexels(vec4(0), vec4(0), vec4(0), vec4(0), vec4(-1));  // black
        const uint entry = batch.firstEntry + i;
        if (i < batch.lights && entry < uint(entries.length())) light = toTexels(lightAt(entries[entry]));
        const vec4 all[5] = vec4[](light.place, light.color, light.direction, light.kind, light.rows);
        for (uint t = 0u; t < each; ++t) texels[i * each + t] = all[t];
    }
}
