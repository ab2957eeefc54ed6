#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/geometry/gbuffer_read.glsl"
#include "render/lighting/bounce.shared.h"
#include "render/lighting/light_volume.shared.h"
#include "render/shaders/illuminate.glsl"

layout(local_size_x = 64) in;
layout(set = 1, binding = kPassStorage, scalar) buffer LightsInView { LightConstants lightsInView[]; };
layout(push_constant, scalar) uniform Push { BouncePush push; };

// The share of light that the surface throws back evenly.
vec3 albedo(Surface s) {
    const uint equation = materialAt(s.material).equation;
    if (equation == kEquationMetallicRoughness) return s.Cs0 * (1.0 - s.specularBlend);
    return equation == kEquationShaped ? s.Cs0 : vec3(0);
}

// A small light at what the light that bounces sees through a texel (docs/conventions.md, "Bounce"). `view` is that light's own.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    const uint count = push.grid * push.grid;
    if (i >= count) return;
    const LightConstants source = lightsInView[push.light];
    LightConstants light = lightsInView[push.first + i];  // as it is, it reaches nothing
    light.position = source.position;
    const Surface s = readSurface(ivec2(i % push.grid, i / push.grid));
    const float r = length(s.P);
    const vec3 d = s.P / max(r, kBounceNear);
    const float cosIncidence = -dot(s.N, d);
    if (s.material != 0u && cosIncidence > 0.0 && linked(source.linkGroup, s.objectId)) {
        const float width = 2.0 * push.tanOuter / float(push.grid);
        const float dw = width * width * -d.z * d.z * d.z;  // (1 + u^2 + v^2)^(-3/2) is the cosine's cube
        const vec3 I = albedo(s) / kPi * source.color * attenuate(source, r) * angularAttenuate(source, -d.z) * (r * r * dw);
        const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
        const float faint = kBounceShare / float(count) * max(dot(source.color, luminance), 1e-30) / (r * r);
        light.position = (push.viewFromLight * vec4(s.P, 1)).xyz;
        light.direction = mat3(push.viewFromLight) * s.N;
        light.color = I;
        light.range = min(sqrt(dot(I, luminance) / faint), 0.5 * kBoundless);
        light.inverseRange = 1.0 / max(light.range, 1e-30);
        light.coneScale = r * r * dw / (max(cosIncidence, 0.1) * kPi);
    }
    lightsInView[push.first + i] = light;
}
