#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "render/geometry/gbuffer_read.glsl"
#include "render/lighting/contribution.glsl"
#include "render/lighting/light_texels.glsl"
#include "render/lighting/tiled_points.shared.h"

// The lights of a batch, summed in registers. Which they are is the same for all pixels and known by position, so that no light is loaded
// from memory here, and no loop is left.
layout(constant_id = 4) const uint kBatchLights = 1u;
layout(location = 0) flat in uvec2 lightsAndFirst;
layout(location = 1) flat in vec4 texels[kBatchTexels];
layout(location = 0) out vec4 sum;

void main() {
    const Surface s = readSurface(ivec2(gl_FragCoord.xy));
    const ShadingPoint p = shadingPoint(s);
    sum = vec4(0);
    if (lightsAndFirst.y != 0u && !usesLights(kCountsLights)) sum = vec4(initialLight(s, materialAt(s.material)), 1);
    const uint each = texelsOfLight(kLights);
    [[unroll]] for (uint i = 0u; i < kBatchTexels / 2u; ++i) {
        if (i >= kBatchLights) break;
        const uint t = i * each;
        const bool more = each > 2u, rows = each > 4u;
        const LightConstants light = toLight(LightTexels(texels[t], texels[t + 1u], more ? texels[t + 2u] : vec4(0), more ? texels[t + 3u] : vec4(0), rows ? texels[t + 4u] : vec4(-1)));
        const vec4 here = addend(p, light);
        sum += !usesLights(kCountsLights) || i < lightsAndFirst.x ? here : vec4(0);
    }
    sum = sumOf(p, sum);
}
