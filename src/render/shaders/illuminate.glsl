// The light model: one light at one surface point. Every technique calls `illuminate`, or its two halves, and none repeats it.
// Positions and directions are in shading space. Formulas, units and spaces: docs/conventions.md.
#ifndef LUCIOLE_ILLUMINATE_GLSL
#define LUCIOLE_ILLUMINATE_GLSL
#include "luciole/light_index.glsl"
#include "render/shaders/frame.glsl"
#include "render/shaders/surface.glsl"
#include "render/shadow/shadow.glsl"

const float kPi = 3.14159265358979;


// Linear along the function, none between functions (Calver 2003, "Linear Interpolation", the manual method: it is exact
// where a filter unit keeps 8 bits of the weight). `t` in [0, 1] spans the function's domain.
vec2 lookUp(uint row, float t) { return lucioleLookUp(functions, row, t); }
float bias(float dotProduct) { return 0.5 * dotProduct + 0.5; }

bool lambertian(LightConstants light) { return usesLights(kUsesLambertian) && (light.flags & kLightLambertian) != 0u; }

// KHR_lights_punctual "Range Property", or Calver 2003 "Shaped Lights": Attenuate.
float attenuate(LightConstants light, float dist) {
    if (dist >= light.range) return 0.0;
    const float x = dist / light.range;
    if (usesLights(kUsesCurves) && light.attenuation != kNoIndex) return lookUp(light.attenuation, x).x;
    if (!lambertian(light)) return lucioleInverseSquare(dist, light.range);
    const float x2 = x * x;
    return clamp(1.0 - x2 * x2, 0.0, 1.0) / (dist * dist + light.coneScale);
}

// KHR_lights_punctual "Inner and Outer Cone Angles", or Calver 2003 "Shaped Lights": AngularAttenuate.
float angularAttenuate(LightConstants light, float cosAngle) {
    if (lambertian(light)) return max(cosAngle, 0.0);
    if (!usesLights(kUsesCurves) || light.falloff == kNoIndex) return lucioleCone(cosAngle, light.cosOuter, light.coneScale);
    return cosAngle > light.cosOuter ? lookUp(light.falloff, bias(cosAngle)).x : 0.0;
}

// Calver 2003, "More Control over Lighting".
bool linked(uint group, uint objectId) {
    return group == kNoIndex || (links[group * view.linkWords + (objectId >> 5u)] >> (objectId & 31u) & 1u) != 0u;
}

// Which way edge (a, b) passes the origin. The edge's other triangle asks for (b, a) and must hear the opposite, to the bit:
// so it is computed in one order only.
bool passesLeft(vec2 a, vec2 b) {
    const bool swapped = a.x != b.x ? a.x > b.x : a.y > b.y;
    const vec2 u = swapped ? b : a;
    const vec2 v = swapped ? a : b;
    precise const float side = u.x * v.y - u.y * v.x;
    return (side >= 0.0) != swapped;
}

// Whether the volume's surface winds about P (Calver 2003, "Concave Light Volume"): how often a ray along +z leaves it less
// how often it enters.
bool insideVolume(uint volume, vec3 positionWorld) {
    const VolumeConstants bounds = volumes[volume];
    const bool outside = any(lessThan(positionWorld, bounds.low)) || any(greaterThan(positionWorld, bounds.high));
    const uint vertexCount = outside ? 0u : bounds.vertexCount;
    int winding = 0;
    for (uint i = 0u; i < vertexCount; i += 3u) {
        const vec3 a = volumeVertices[bounds.firstVertex + i] - positionWorld;
        const vec3 b = volumeVertices[bounds.firstVertex + i + 1u] - positionWorld;
        const vec3 c = volumeVertices[bounds.firstVertex + i + 2u] - positionWorld;
        const bool left = passesLeft(a.xy, b.xy);
        if (passesLeft(b.xy, c.xy) == left && passesLeft(c.xy, a.xy) == left) {
            const vec3 normal = cross(b - a, c - a);  // of the side that sees its corners counter-clockwise
            const bool above = (dot(normal, a) >= 0.0) == (normal.z >= 0.0);
            if (above) winding += left ? 1 : -1;
        }
    }
    return winding != 0;
}

bool inVolume(LightConstants light, vec3 P) {
    return light.volume == kNoIndex || insideVolume(light.volume, P + eyeWorld);
}

// Whether any light can arrive: linked, within range, cone and volume. The volume last, as it costs most.
bool reaches(LightConstants light, vec3 P, uint objectId) {
    if (usesLights(kUsesLinks) && !linked(light.linkGroup, objectId)) return false;
    if (light.type != kLightDirectional) {
        const vec3 toLight = light.position - P;
        const float dist = length(toLight);
        const bool inCone = light.type != kLightSpot || -dot(toLight, light.direction) > light.cosOuter * dist;
        if (dist >= light.range || !inCone) return false;
    }
    return !usesLights(kUsesVolumes) || inVolume(light, P);
}

// What arrives at a point: L to the light, E the irradiance on a plane that faces it.
struct Arrival {
    vec3 L;
    vec3 E;
};

Arrival arrivalAt(LightConstants light, vec3 P) {
    Arrival arrival = Arrival(-light.direction, light.color);
    if (usesLights(kUsesLocal) && (!usesLights(kUsesDirectional) || light.type != kLightDirectional)) {
        const vec3 toLight = light.position - P;
        const float dist = length(toLight);
        arrival.L = toLight * (1.0 / max(dist, 1e-6));
        float strength = attenuate(light, dist);
        if (usesLights(kUsesSpot)) strength *= angularAttenuate(light, -dot(arrival.L, light.direction));
        arrival.E *= strength;
    }
    return arrival;
}

// A surface point with all that the equations need of it and that no light changes, so that it is computed once.
struct ShadingPoint {
    Surface s;
    MaterialConstants m;
    vec3 V;        // to the eye
    // metallic-roughness:
    vec3 diffuse;  // (1 - F0) c_diff / pi
    vec3 F0;
    float a2;      // alpha^2
    float NoV;
    float smithV;  // the term of Vis that depends on V
};

ShadingPoint shadingPoint(Surface s, MaterialConstants m) {
    ShadingPoint p;
    p.s = s;
    p.m = m;
    p.V = view.orthographic != 0u ? view.worldFromView[2].xyz : normalize(-s.P);
    const float alpha = max(s.roughness, 0.045) * max(s.roughness, 0.045);
    p.F0 = mix(vec3(0.04), s.Cs0, s.specularBlend);
    p.diffuse = (1.0 - p.F0) * s.Cs0 * ((1.0 - s.specularBlend) / kPi);
    p.a2 = alpha * alpha;
    p.NoV = max(abs(dot(s.N, p.V)), 1e-4);
    p.smithV = sqrt(p.NoV * p.NoV * (1.0 - p.a2) + p.a2);
    return p;
}

ShadingPoint shadingPoint(Surface s) { return shadingPoint(s, materialAt(s.material)); }

// Zero, not NaN, for a light that shines straight at the eye.
vec3 halfVector(vec3 V, vec3 L) {
    const vec3 sum = V + L;
    return sum * inversesqrt(max(dot(sum, sum), 1e-12));
}

// What a light adds at a surface point, but for the surface's colours: both equations are linear in these, so that terms of many lights
// may be summed before they are given colour.
struct LightTerms {
    vec3 diffuse;
    vec3 specular;
    vec3 grazing;  // metallic-roughness: the part of the highlight that is white
};
// As many shares of the irradiance E.
LightTerms termsOf(vec3 shares, vec3 E) { return LightTerms(shares.x * E, shares.y * E, shares.z * E); }

// Calver 2003, "Light Model": Illuminate. Kd and Ks are folded into Cs0 and Cs1. `keep`: diffuse and specular, 0 or 1.
vec3 sharesShaped(ShadingPoint p, vec3 V, vec3 L, vec2 keep) {
    const vec3 H = halfVector(V, L);
    const vec2 diffuse = lookUp(p.m.diffuseFunction, bias(dot(p.s.N, L)));
    const float specular = lookUp(p.m.specularFunction, bias(dot(p.s.N, H))).x;
    return vec3(keep.x * diffuse.x, keep.y * specular * diffuse.y, 0) / kPi;
}
vec3 shadeShaped(ShadingPoint p, LightTerms terms) {
    const float strength = dot(terms.specular, vec3(0.2126, 0.7152, 0.0722));
    return p.s.Cs0 * terms.diffuse + p.s.Cs1 * mix(terms.specular, vec3(strength), p.s.specularBlend);
}

// glTF 2.0, Appendix B: GGX distribution, height-correlated Smith, Schlick's Fresnel, which with k = (1 - V.H)^5 is
// F = (1 - k) F0 + k, and 1 - F = (1 - k) (1 - F0).
vec3 sharesMetallicRoughness(ShadingPoint p, vec3 L, vec2 keep) {
    const float NoL = dot(p.s.N, L);
    if (NoL <= 0.0) return vec3(0);
    const vec3 H = halfVector(p.V, L);
    const float NoH = dot(p.s.N, H);
    const float u = 1.0 - max(dot(p.V, H), 0.0);
    const float u2 = u * u;
    const float k = u2 * u2 * u;
    // 1 - (N.H)^2 as |N x H|^2: near the peak of a smooth surface the difference has no digits left.
    const vec3 NxH = cross(p.s.N, H);
    const float d = NoH * NoH * p.a2 + dot(NxH, NxH);
    const float smithL = sqrt(NoL * NoL * (1.0 - p.a2) + p.a2);
    // D Vis = a^2 / (pi d^2) * 0.5 / (NoL smithV + NoV smithL)
    const float DVis = NoH > 0.0 ? 0.5 * p.a2 / (kPi * d * d * (NoL * p.smithV + p.NoV * smithL)) : 0.0;
    return NoL * vec3(keep.x * (1.0 - k), keep.y * DVis * (1.0 - k), keep.y * DVis * k);
}
vec3 shadeMetallicRoughness(ShadingPoint p, LightTerms terms) { return p.diffuse * terms.diffuse + p.F0 * terms.specular + terms.grazing; }

bool hasEquation(ShadingPoint p, uint equation) { return isEquation(equation, p.m); }

LightTerms lightTerms(ShadingPoint p, LightConstants light) {
    Arrival arrival = arrivalAt(light, p.s.P);
    vec3 shares = vec3(0);
    if (usesLights(kUsesLinks) && !linked(light.linkGroup, p.s.objectId)) return termsOf(shares, vec3(0));
    if (usesLights(kUsesVolumes) && arrival.E != vec3(0) && !inVolume(light, p.s.P)) return termsOf(shares, vec3(0));
    vec2 keep = vec2(1);
    vec3 shapedV = p.V;
    if (usesLights(kUsesContributions)) {
        keep = vec2(light.flags & kLightDiffuse, (light.flags & kLightSpecular) >> 1u);
        if ((light.flags & kLightInfiniteViewer) != 0u) shapedV = view.worldFromView[2].xyz;
    }
    if (hasEquation(p, kEquationMetallicRoughness)) shares = sharesMetallicRoughness(p, arrival.L, keep);
    if (hasEquation(p, kEquationShaped)) shares = sharesShaped(p, shapedV, arrival.L, keep);
    if (usesLights(kUsesShadows) && shadowsAsked && shares != vec3(0) && arrival.E != vec3(0)) arrival.E *= unshadowed(light, p.s.P, p.s.N, arrival.L);
    return termsOf(shares, arrival.E);
}

// Radiance that the point sends to the eye for the terms of a light, or the sums of those of several.
vec3 shade(ShadingPoint p, LightTerms terms) {
    vec3 radiance = vec3(0);
    if (hasEquation(p, kEquationMetallicRoughness)) radiance = shadeMetallicRoughness(p, terms);
    if (hasEquation(p, kEquationShaped)) radiance = shadeShaped(p, terms);
    return radiance;
}

vec3 illuminate(ShadingPoint p, LightConstants light) { return shade(p, lightTerms(p, light)); }

// The light that is there before any light: Calver 2003, "Full screen lights", HemisphereEmissiveLightShader.
vec3 initialLight(Surface s, MaterialConstants m) {
    const vec3 ambience = mix(view.ground, view.sky, 0.5 + 0.5 * dot(s.N, view.upWorld));
    const vec3 ambient = isEquation(kEquationMetallicRoughness, m) ? s.Cs0 * s.occlusion : m.kAmbient;
    return ambient * ambience + (usesMaterials(kMaterialsEmit) ? m.kEmissive * s.Cs1 : vec3(0));
}
#endif
