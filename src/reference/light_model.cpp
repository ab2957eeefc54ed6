#include "reference/light_model.hpp"

#include <algorithm>
#include <cmath>

namespace luciole::reference {
namespace {

/// Zero if V and L are opposite: any half vector is as good, and none must not make a NaN.
dvec3 halfVector(dvec3 V, dvec3 L) {
    const dvec3 sum = V + L;
    const double norm = length(sum);
    return norm > 0 ? sum / norm : dvec3(0);
}

double luminance(dvec3 color) { return dot(color, dvec3(0.2126, 0.7152, 0.0722)); }

}  // namespace

// Calver 2003, "Photo-realistic Deferred Lighting", "Full screen lights", with a sky and a ground colour. glTF 2.0,
// 3.9.3: occlusion darkens indirect light only.
dvec3 initialLight(const SurfacePoint& s, const Ambience& ambience) {
    if (s.equation == LightEquation::unlit) return s.Cs0;
    const double up = 0.5 + 0.5 * dot(s.N, normalize(dvec3(ambience.upWorld)));
    const dvec3 A = mix(dvec3(ambience.ground), dvec3(ambience.sky), up);
    const dvec3 ambient = s.equation == LightEquation::shaped ? s.Kamb * A : s.Cs0 * s.occlusion * A;
    return ambient + s.Kemm * s.Cs1;
}

dvec3 reflectedLight(const SurfacePoint& s, dvec3 V, const Arrival& light, LightContribution contribution) {
    switch (s.equation) {
        case LightEquation::shaped:
            return shapedBlinnPhong(s, V, light, contribution);
        case LightEquation::metallicRoughness:
            return metallicRoughness(s, V, light, contribution);
        case LightEquation::unlit:
            return dvec3(0);
    }
    return dvec3(0);
}

// Calver 2003, "Photo-realistic Deferred Lighting", "Light Model". We differ in two places: H = V + L, where he prints
// N + L, and the colourless term of the highlight keeps the light's strength (docs/conventions.md says why).
dvec3 shapedBlinnPhong(const SurfacePoint& s, dvec3 V, const Arrival& light, LightContribution contribution) {
    const dvec3 H = halfVector(V, light.L);
    const dvec3 Cl = light.E / kPi;
    const dvec2 diffuse = (*s.Fa)(dot(s.N, light.L));  // shape, cascade multiplier
    const double specular = (*s.Fb)(dot(s.N, H)).x;
    dvec3 radiance(0);
    if (contribution != LightContribution::specularOnly) radiance += s.Cs0 * Cl * diffuse.x;
    if (contribution != LightContribution::diffuseOnly)
        radiance += specular * mix(s.Cs1 * Cl, s.Cs1 * luminance(Cl), s.specularBlend) * diffuse.y;
    return radiance;
}

// glTF 2.0, Appendix B.3: Lambert with Schlick's Fresnel term, GGX with the height-correlated Smith term.
dvec3 metallicRoughness(const SurfacePoint& s, dvec3 V, const Arrival& light, LightContribution contribution) {
    const double NoL = dot(s.N, light.L);
    if (!(NoL > 0)) return dvec3(0);
    const dvec3 H = halfVector(V, light.L);
    const double NoV = std::max(std::abs(dot(s.N, V)), 1e-4);
    const double NoH = dot(s.N, H), VoH = dot(V, H);
    const double alpha = std::pow(std::max(s.roughness, 0.045), 2);
    const double alpha2 = alpha * alpha;

    const dvec3 cDiff = s.Cs0 * (1 - s.metallic);
    const dvec3 F0 = mix(dvec3(0.04), s.Cs0, s.metallic);
    const double oneMinusVoH2 = (1 - VoH) * (1 - VoH);
    const dvec3 F = F0 + (1.0 - F0) * (oneMinusVoH2 * oneMinusVoH2 * (1 - VoH));
    const double d = NoH * NoH * (alpha2 - 1) + 1;
    const double D = alpha2 / (kPi * d * d);
    const double Vis =
        0.5 / (NoL * std::sqrt(NoV * NoV * (1 - alpha2) + alpha2) + NoV * std::sqrt(NoL * NoL * (1 - alpha2) + alpha2));
    dvec3 f(0);
    if (contribution != LightContribution::specularOnly) f += (1.0 - F) * cDiff / kPi;
    if (contribution != LightContribution::diffuseOnly) f += F * D * Vis;
    return f * light.E * NoL;
}

}  // namespace luciole::reference
