#version 460
#extension GL_GOOGLE_include_directive : require
#define WITHOUT_PIXELS
#include "render/geometry/gbuffer_read.glsl"
#include "render/lighting/bounce.shared.h"
#include "render/lighting/light_volume.shared.h"
#include "render/shaders/illuminate.glsl"

layout(local_size_x = 64) in;
layout(set = 1, binding = kPassStorage, scalar) buffer Table { PackedLight table[]; };  // of all lights, once more
layout(push_constant, scalar) uniform Push { BouncePush push; };

// The share of light that the surface throws back evenly.
vec3 albedo(Surface s) {
    const uint equation = materialAt(s.material).equation;
    if (equation == kEquationMetallicRoughness) return s.Cs0 * (1.0 - s.specularBlend);
    return equation == kEquationShaped ? s.Cs0 : vec3(0);
}

// A small light at what the light that bounces sees through a texel (docs/conventions.md, "Bounce"). `view` is that light's own, so
// that it stands at the origin of shading space.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    const uint count = push.grid * push.grid;
    if (i >= count) return;
    const LightConstants source = lightInWorld(push.light);
    PackedLight light = table[push.first + i];  // without a range it reaches nothing
    light.position = source.position;
    light.range = 0.0;
    const Surface s = readSurface(ivec2(i % push.grid, i / push.grid));
    const float r = length(s.P);
    const vec3 d = s.P / max(r, kBounceNear);
    const float cosIncidence = -dot(s.N, d);
    if (s.seen && cosIncidence > 0.0 && linked(source.linkGroup, s.objectId)) {
        const float width = 2.0 * push.tanOuter / float(push.grid);
        const float cosAxis = dot(d, source.direction);
        const float dw = width * width * cosAxis * cosAxis * cosAxis;  // (1 + u^2 + v^2)^(-3/2) is the cosine's cube
        const vec3 I = albedo(s) / kPi * source.color * attenuate(source, r) * angularAttenuate(source, cosAxis) * (r * r * dw);
        const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
        const float faint = kBounceShare / float(count) * max(dot(source.color, luminance), 1e-30) / (r * r);
        light.position = source.position + s.P;
        light.direction = s.N;
        light.color = I;
        light.range = min(sqrt(dot(I, luminance) / faint), 0.5 * kBoundless);
        light.coneScale = r * r * dw / (max(cosIncidence, 0.1) * kPi);
    }
    table[push.first + i] = light;
}
