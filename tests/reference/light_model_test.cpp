#include <doctest/doctest.h>

#include <cmath>

#include "reference/light_model.hpp"

using namespace luciole;
using namespace luciole::reference;
using doctest::Approx;

namespace {

constexpr auto kBoth = LightContribution::diffuseAndSpecular;
constexpr dvec3 kUp{0, 0, 1};

/// Unit direction at an angle to +Z whose cosine is given, turned round it by `azimuth`.
dvec3 direction(double cosine, double azimuth = 0) {
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

SurfacePoint metal(double roughness, dvec3 color = dvec3(1)) {
    return {
        .equation = LightEquation::metallicRoughness, .N = kUp, .Cs0 = color, .metallic = 1, .roughness = roughness};
}

SurfacePoint dielectric(double roughness, dvec3 color = dvec3(1)) {
    SurfacePoint surface = metal(roughness, color);
    surface.metallic = 0;
    return surface;
}

FunctionTable table(Function::Kind kind, double parameter = 0, std::vector<vec2> samples = {}) {
    return {Function{.name = "", .kind = kind, .parameter = float(parameter), .samples = std::move(samples)}, -1};
}

SurfacePoint shaped(const FunctionTable& Fa, const FunctionTable& Fb) {
    return {.equation = LightEquation::shaped, .N = kUp, .Cs0 = dvec3(1), .Cs1 = dvec3(1), .Fa = &Fa, .Fb = &Fb};
}

/// Share of the light from V's side that a metal reflects. By quadrature over half vectors in GGX's own measure: with
/// tan^2 = alpha^2 u / (1 - u), D (N.H) d(omega_h) = du d(phi) / (2 pi), and d(omega_l) = 4 (V.H) d(omega_h) (Walter et
/// al. 2007, eq. 14 and 35). So even a mirror-like lobe is spread evenly over the samples.
double directionalAlbedo(const SurfacePoint& surface, double NoV) {
    constexpr int kSteps = 200;
    const double alpha = std::pow(std::max(surface.roughness, 0.045), 2);
    const dvec3 V = direction(NoV);
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double u = (i + 0.5) / kSteps;
        const double cosine = std::sqrt((1 - u) / (1 + (alpha * alpha - 1) * u));
        const double D = std::pow(alpha / (1 + (alpha * alpha - 1) * cosine * cosine), 2) / kPi;
        for (int j = 0; j < kSteps; ++j) {
            const dvec3 H = direction(cosine, 2 * kPi * (j + 0.5) / kSteps);
            const double VoH = dot(V, H);
            if (VoH <= 0) continue;
            const Arrival light{2 * VoH * H - V, dvec3(1)};
            sum += metallicRoughness(surface, V, light, kBoth).r * 4 * VoH / (D * cosine);
        }
    }
    return sum / (kSteps * kSteps);
}

}  // namespace

TEST_CASE("metallic-roughness: at normal incidence a metal shows F0 / (4 pi alpha^2)") {
    // D = 1 / (pi alpha^2) and Vis = 1 / 4.
    for (const double roughness : {0.1, 0.3, 0.7, 1.0}) {
        const double alpha = roughness * roughness;
        const dvec3 radiance = metallicRoughness(metal(roughness, {1, 0.5, 0.1}), kUp, {kUp, dvec3(3)}, kBoth);
        const dvec3 expected = dvec3(1, 0.5, 0.1) * 3.0 / (4 * kPi * alpha * alpha);
        CHECK(length(radiance - expected) < 1e-12 * length(expected));
    }
}

TEST_CASE("metallic-roughness: roughness is no less than 0.045") {
    const Arrival light{direction(0.7), dvec3(1)};
    CHECK(metallicRoughness(metal(0), direction(0.7, kPi), light, kBoth) ==
          metallicRoughness(metal(0.045), direction(0.7, kPi), light, kBoth));
}

TEST_CASE("metallic-roughness: a dielectric's diffuse term is Lambert's less what Fresnel reflects") {
    const dvec3 radiance =
        metallicRoughness(dielectric(0.5, {0.8, 0.4, 0.2}), kUp, {kUp, dvec3(kPi)}, LightContribution::diffuseOnly);
    CHECK(length(radiance - 0.96 * dvec3(0.8, 0.4, 0.2)) < 1e-14);
}

TEST_CASE("metallic-roughness: diffuse and specular parts add up to the whole") {
    SurfacePoint surface = dielectric(0.3, {0.8, 0.4, 0.2});
    surface.metallic = 0.25;
    const Arrival light{direction(0.6, 1), dvec3(2, 3, 4)};
    const dvec3 V = direction(0.8, -1);
    const dvec3 parts = metallicRoughness(surface, V, light, LightContribution::diffuseOnly) +
                        metallicRoughness(surface, V, light, LightContribution::specularOnly);
    CHECK(length(parts - metallicRoughness(surface, V, light, kBoth)) < 1e-14);
}

TEST_CASE("metallic-roughness: a light at or below the horizon adds nothing") {
    CHECK(metallicRoughness(metal(0.5), kUp, {direction(0), dvec3(1)}, kBoth) == dvec3(0));
    CHECK(metallicRoughness(metal(0.5), kUp, {direction(-0.5), dvec3(1)}, kBoth) == dvec3(0));
    CHECK(metallicRoughness(metal(0.5), kUp, {dvec3(0), dvec3(1)}, kBoth) == dvec3(0));
}

TEST_CASE("metallic-roughness: swapping light and eye changes nothing (Helmholtz)") {
    for (const double roughness : {0.05, 0.4, 1.0}) {
        for (const double NoV : {0.05, 0.5, 0.95}) {
            for (const double NoL : {0.1, 0.6, 1.0}) {
                const dvec3 V = direction(NoV), L = direction(NoL, 2);
                const double there = metallicRoughness(metal(roughness), V, {L, dvec3(1)}, kBoth).r / NoL;
                const double back = metallicRoughness(metal(roughness), L, {V, dvec3(1)}, kBoth).r / NoV;
                CHECK(there == Approx(back).epsilon(1e-12));
            }
        }
    }
}

TEST_CASE("metallic-roughness: no white metal reflects more light than arrives, and a smooth one nearly all") {
    // Midpoint rule with 200 x 200 samples: the sum is within 1e-3 where the lobe is smooth in (u, phi).
    for (const double roughness : {0.045, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0}) {
        for (const double NoV : {0.02, 0.1, 0.3, 0.6, 0.9, 1.0}) {
            CAPTURE(roughness);
            CAPTURE(NoV);
            const double albedo = directionalAlbedo(metal(roughness), NoV);
            CHECK(albedo <= 1.001);
            CHECK(albedo > 0.3);
        }
    }
    CHECK(directionalAlbedo(metal(0.045), 0.6) == Approx(1).epsilon(1e-3));
}

TEST_CASE("shaped: every function of N.L scales the diffuse term by its value") {
    // N.L = 0.5 lies on a sample of the table, so the values are exact up to floats in the functions' parameters.
    const auto black = table(Function::Kind::constant, 0);
    const auto diffuse = [&](const FunctionTable& Fa, double NoL) {
        return shapedBlinnPhong(shaped(Fa, black), kUp, {direction(NoL), dvec3(kPi)}, kBoth).r;
    };
    using Kind = Function::Kind;
    CHECK(diffuse(table(Kind::lambert), 0.5) == Approx(0.5));
    CHECK(diffuse(table(Kind::lambert), -0.5) == 0);
    CHECK(diffuse(table(Kind::wrap, 0.5), 0.5) == Approx(2.0 / 3));
    CHECK(diffuse(table(Kind::wrap, 0.5), -0.25) == Approx(1.0 / 6));
    CHECK(diffuse(table(Kind::wrap, 0.5), -0.75) == 0);
    CHECK(diffuse(table(Kind::orenNayar, 0.5), 1) == Approx(1 - 0.125 / 0.58));  // A alone, as t = 0
    CHECK(diffuse(table(Kind::blinnPhong, 3), 0.5) == Approx(0.125));
    CHECK(diffuse(table(Kind::constant, 0.25), -0.5) == Approx(0.25));
    CHECK(diffuse(table(Kind::toon, 3), 0.5) == Approx(2.0 / 3));
    CHECK(diffuse(table(Kind::toon, 3), -0.5) == 0);
    CHECK(diffuse(table(Kind::sampled, 0, {vec2(0), vec2(0.5f), vec2(4)}), 0.5) == Approx(2.25));
}

TEST_CASE("shaped: the highlight is Fb of N.H times the cascade multiplier of Fa") {
    using Kind = Function::Kind;
    const auto lambert = table(Kind::lambert), wrap = table(Kind::wrap, 0.5), square = table(Kind::blinnPhong, 2),
               one = table(Kind::constant, 1);
    const auto specular = [&](const FunctionTable& Fa, const FunctionTable& Fb, double NoL, dvec3 V) {
        return shapedBlinnPhong(shaped(Fa, Fb), V, {direction(NoL), dvec3(kPi)}, LightContribution::specularOnly).r;
    };
    // L at 60 degrees, V straight up: H at 30 degrees, cos^2 = 0.75. Between two samples: within h^2 / 8 * 2 = 6e-8.
    CHECK(specular(lambert, square, 0.5, kUp) == Approx(0.75).epsilon(1e-7));
    CHECK(specular(lambert, one, -0.25, kUp) == 0);       // behind: the multiplier kills it
    CHECK(specular(wrap, one, -0.25, kUp) == Approx(1));  // wrapped light still has its highlight
    CHECK(specular(one, one, 0.5, kUp) == Approx(0.5));   // a constant's cascade is max(x, 0)
}

TEST_CASE("shaped: specular blend goes from the light's colour to the surface's alone") {
    const auto lambert = table(Function::Kind::lambert), one = table(Function::Kind::constant, 1);
    SurfacePoint surface = shaped(lambert, one);
    surface.Cs1 = {0.9, 0.5, 0.1};
    const dvec3 Cl(0.2, 0.4, 0.6);
    const auto highlight = [&](double blend) {
        surface.specularBlend = blend;
        return shapedBlinnPhong(surface, kUp, {kUp, kPi * Cl}, LightContribution::specularOnly);
    };
    const double luminance = 0.2126 * 0.2 + 0.7152 * 0.4 + 0.0722 * 0.6;
    CHECK(length(highlight(0) - surface.Cs1 * Cl) < 1e-15);
    CHECK(length(highlight(1) - surface.Cs1 * luminance) < 1e-15);
    CHECK(length(highlight(0.5) - surface.Cs1 * (Cl + luminance) / 2.0) < 1e-15);
}

TEST_CASE("shaped: a light opposite to the eye, or exactly at the surface, gives finite numbers") {
    const auto wrap = table(Function::Kind::wrap, 1), one = table(Function::Kind::constant, 1);
    const SurfacePoint surface = shaped(wrap, one);
    CHECK(shapedBlinnPhong(surface, direction(0.5), {-direction(0.5), dvec3(kPi)}, kBoth).r == Approx(0.25 + 1));
    CHECK(shapedBlinnPhong(surface, kUp, {dvec3(0), dvec3(kPi)}, kBoth).r == Approx(0.5 + 1));
}

TEST_CASE("initial light: the sky from above, the ground from below, their mean at the side, plus what glows") {
    const auto lambert = table(Function::Kind::lambert);
    SurfacePoint surface = shaped(lambert, lambert);
    const Ambience ambience{.sky = vec3(1, 2, 3), .ground = vec3(0.5f, 0, 1), .upWorld = vec3(0, 1, 0)};
    surface.Kamb = {1, 0.5, 0};
    surface.N = {0, 1, 0};
    CHECK(initialLight(surface, ambience) == dvec3(1, 1, 0));
    surface.N = {0, -1, 0};
    CHECK(initialLight(surface, ambience) == dvec3(0.5, 0, 0));
    surface.N = {0, 0, 1};
    CHECK(initialLight(surface, ambience) == dvec3(0.75, 0.5, 0));
    surface.Kemm = 2;
    surface.Cs1 = {0.25, 0.5, 1};
    CHECK(initialLight(surface, ambience) == dvec3(1.25, 1.5, 2));
}

TEST_CASE("initial light: occlusion darkens a metallic-roughness surface, and unlit shows its colour") {
    SurfacePoint surface = dielectric(1, {0.5, 0.25, 1});
    surface.N = {0, 1, 0};
    surface.occlusion = 0.5;
    const Ambience ambience{.sky = vec3(1, 2, 3)};
    CHECK(initialLight(surface, ambience) == dvec3(0.25, 0.25, 1.5));
    surface.equation = LightEquation::unlit;
    CHECK(initialLight(surface, ambience) == dvec3(0.5, 0.25, 1));
    CHECK(reflectedLight(surface, kUp, {kUp, dvec3(1)}, kBoth) == dvec3(0));
}
