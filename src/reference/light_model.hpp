#pragma once
#include <luciole/scene.hpp>

#include "reference/function_table.hpp"

/// The light equations (docs/conventions.md, "The equations"), in the papers' symbols. Directions are unit vectors in
/// world space; colours are linear Rec. 709.
namespace luciole::reference {

/// A surface as the equations see it.
struct SurfacePoint {
    LightEquation equation = LightEquation::unlit;
    dvec3 P{0};  ///< metres, world space
    dvec3 N{0};
    dvec3 Cs0{0}, Cs1{0};
    double alpha = 1;  ///< [0, 1]: how much it hides of what is behind, if its material blends
    dvec3 Kamb{0};
    double Kemm = 0;
    double specularBlend = 0;                           ///< shaped
    const FunctionTable *Fa = nullptr, *Fb = nullptr;   ///< shaped
    double metallic = 0, roughness = 0, occlusion = 1;  ///< metallic-roughness; roughness is perceptual
};

/// What arrives from one light.
struct Arrival {
    dvec3 L;  ///< to the light; zero where the light is exactly at the surface
    dvec3 E;  ///< irradiance on a plane that faces the light, lux per channel
};

/// What is there before any light is added: ambient and emissive light. Radiance.
dvec3 initialLight(const SurfacePoint& surface, const Ambience& ambience);

/// Radiance towards V that one light adds, by the surface's equation.
dvec3 reflectedLight(const SurfacePoint& surface, dvec3 V, const Arrival& light, LightContribution contribution);

dvec3 shapedBlinnPhong(const SurfacePoint& surface, dvec3 V, const Arrival& light, LightContribution contribution);
dvec3 metallicRoughness(const SurfacePoint& surface, dvec3 V, const Arrival& light, LightContribution contribution);

}  // namespace luciole::reference
