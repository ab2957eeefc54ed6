// The light model: one light at one surface point. Every technique calls `illuminate` and none repeats it.
// Formulas and units: docs/conventions.md.
#ifndef LUCIOLE_ILLUMINATE_GLSL
#define LUCIOLE_ILLUMINATE_GLSL
#include "render/shaders/frame.glsl"
#include "render/shaders/surface.glsl"

const float kPi = 3.14159265358979;

bool usesLights(uint bit) { return (kLights & bit) != 0u; }
bool usesEquation(uint equation) { return (kEquations & (1u << equation)) != 0u; }

// Linear along the function, none between functions (Calver 2003, "Linear Interpolation", the manual method: it is exact
// where a filter unit keeps 8 bits of the weight). `t` in [0, 1] spans the function's domain.
vec2 lookUp(uint row, float t) {
    const float x = clamp(t, 0.0, 1.0) * float(kFunctionSamples - 1u);
    const int i = min(int(x), int(kFunctionSamples) - 2);
    const vec2 a = texelFetch(functions, ivec2(i, row), 0).xy;
    const vec2 b = texelFetch(functions, ivec2(i + 1, row), 0).xy;
    return mix(a, b, x - float(i));
}
float bias(float dotProduct) { return 0.5 * dotProduct + 0.5; }

// KHR_lights_punctual "Range Property", or Calver 2003 "Shaped Lights": Attenuate.
float attenuate(LightConstants light, float dist) {
    if (dist >= light.range) return 0.0;
    const float x = dist * light.inverseRange;
    const float x2 = x * x;
    const float d = max(dist, 0.01);
    const float inverseSquare = clamp(1.0 - x2 * x2, 0.0, 1.0) / (d * d);
    return usesLights(kUsesCurves) && light.attenuation != kNoIndex ? lookUp(light.attenuation, x).x : inverseSquare;
}

// KHR_lights_punctual "Inner and Outer Cone Angles", or Calver 2003 "Shaped Lights": AngularAttenuate.
float angularAttenuate(LightConstants light, float cosAngle) {
    const float cone = clamp(cosAngle * light.coneScale + light.coneOffset, 0.0, 1.0);
    if (!usesLights(kUsesCurves) || light.falloff == kNoIndex) return cone * cone;
    return cosAngle > light.cosOuter ? lookUp(light.falloff, bias(cosAngle)).x : 0.0;
}

// Calver 2003, "More Control over Lighting".
bool linked(uint group, uint objectId) {
    return group == kNoIndex || (links[group * view.linkWords + (objectId >> 5u)] >> (objectId & 31u) & 1u) != 0u;
}

// What arrives at a point: L to the light, E the irradiance on a plane that faces it.
struct Arrival {
    vec3 L;
    vec3 E;
};

Arrival arrivalAt(LightConstants light, vec3 P) {
    Arrival arrival = Arrival(-light.direction, light.color);
    if (usesLights(kUsesLocal) && light.type != kLightDirectional) {
        const vec3 toLight = light.position - P;
        const float dist = length(toLight);
        arrival.L = toLight / max(dist, 1e-6);
        float strength = attenuate(light, dist);
        if (usesLights(kUsesSpot) && light.type == kLightSpot)
            strength *= angularAttenuate(light, -dot(arrival.L, light.direction));
        arrival.E *= strength;
    }
    return arrival;
}

// Calver 2003, "Light Model": Illuminate. Kd and Ks are folded into Cs0 and Cs1.
vec3 illuminateShaped(Surface s, MaterialConstants m, vec3 V, vec3 L, vec3 E, vec2 keep) {
    const vec3 H = normalize(V + L);
    const vec3 Cl = E / kPi;
    const vec2 diffuse = lookUp(m.diffuseFunction, bias(dot(s.N, L)));
    const float specular = lookUp(m.specularFunction, bias(dot(s.N, H))).x;
    const float strength = dot(Cl, vec3(0.2126, 0.7152, 0.0722));
    const vec3 highlight = s.Cs1 * mix(Cl, vec3(strength), s.specularBlend);
    return keep.x * s.Cs0 * Cl * diffuse.x + keep.y * specular * highlight * diffuse.y;
}

// glTF 2.0, Appendix B: GGX distribution, height-correlated Smith, Schlick's Fresnel.
vec3 illuminateMetallicRoughness(Surface s, vec3 V, vec3 L, vec3 E, vec2 keep) {
    const float NoL = dot(s.N, L);
    if (NoL <= 0.0) return vec3(0);
    const vec3 H = normalize(V + L);
    const float NoV = max(abs(dot(s.N, V)), 1e-4);
    const float NoH = dot(s.N, H);
    const float VoH = max(dot(V, H), 0.0);
    const float alpha = max(s.roughness, 0.045) * max(s.roughness, 0.045);
    const float a2 = alpha * alpha;
    const float u = 1.0 - VoH;
    const float u2 = u * u;
    const vec3 F0 = mix(vec3(0.04), s.Cs0, s.specularBlend);
    const vec3 F = F0 + (1.0 - F0) * (u2 * u2 * u);
    // 1 - (N.H)^2 as |N x H|^2: near the peak of a smooth surface the difference has no digits left.
    const vec3 NxH = cross(s.N, H);
    const float d = NoH * NoH * a2 + dot(NxH, NxH);
    const float D = NoH > 0.0 ? a2 / (kPi * d * d) : 0.0;
    const float Vis = 0.5 / (NoL * sqrt(NoV * NoV * (1.0 - a2) + a2) + NoV * sqrt(NoL * NoL * (1.0 - a2) + a2));
    const vec3 diffuse = (1.0 - F) * s.Cs0 * ((1.0 - s.specularBlend) / kPi);
    return (keep.x * diffuse + keep.y * F * (D * Vis)) * E * NoL;
}

// Direction from the surface to the eye.
vec3 toEye(vec3 P) { return view.orthographic != 0u ? vec3(0, 0, 1) : normalize(-P); }

// Radiance that `s` sends to the eye from this light.
vec3 illuminate(Surface s, MaterialConstants m, LightConstants light) {
    const Arrival arrival = arrivalAt(light, s.P);
    if (usesLights(kUsesLinks) && !linked(light.linkGroup, s.objectId)) return vec3(0);
    vec2 keep = vec2(1);
    vec3 V = toEye(s.P);
    vec3 eyeOfShaped = V;
    if (usesLights(kUsesContributions)) {
        keep = vec2(light.flags & kLightDiffuse, (light.flags & kLightSpecular) >> 1u);
        if ((light.flags & kLightInfiniteViewer) != 0u) eyeOfShaped = vec3(0, 0, 1);
    }
    vec3 radiance = vec3(0);
    if (usesEquation(kEquationMetallicRoughness) && m.equation == kEquationMetallicRoughness)
        radiance = illuminateMetallicRoughness(s, V, arrival.L, arrival.E, keep);
    if (usesEquation(kEquationShaped) && m.equation == kEquationShaped)
        radiance = illuminateShaped(s, m, eyeOfShaped, arrival.L, arrival.E, keep);
    return radiance;
}

// The light that is there before any light: Calver 2003, "Full screen lights", HemisphereEmissiveLightShader.
vec3 initialLight(Surface s, MaterialConstants m) {
    const vec3 ambience = mix(view.ground, view.sky, 0.5 + 0.5 * dot(s.N, view.upView));
    const vec3 ambient = m.equation == kEquationMetallicRoughness ? s.Cs0 * s.occlusion : m.kAmbient;
    return ambient * ambience + m.kEmissive * s.Cs1;
}
#endif
