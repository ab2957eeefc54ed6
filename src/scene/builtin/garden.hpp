#pragma once
#include <luciole/scene.hpp>

#include "scene/random.hpp"

/// Meshes of the garden in builtin:fireflies. All stand on y = 0. Vertex colours are part of the look: they darken
/// what lies deep and vary what repeats.
namespace luciole::garden {

constexpr float kWaterLevel = 0;

/// Below 1 within pond and stream, above on land.
float pondEdge(vec2 xz);
/// Height of the ground; below kWaterLevel in the pond.
float groundHeight(vec2 xz);
/// The path of stepping stones from the front to the lantern, t in [0, 1].
vec2 pathAt(float t);

Mesh ground();
Mesh water();
/// Inside of a dome, dusk painted into its vertex colours, brightest towards `glow` (unit).
Mesh sky(vec3 glow);
/// A range of hills all around, seen as a silhouette.
Mesh hills(float distance, float height, Random random);

Mesh grassTuft(Random random);
Mesh reeds(Random random);
Mesh stone(Random random);
Mesh lilyPad();
Mesh lotus();

struct Tree {
    Mesh wood;
    Mesh leaves;
};
/// \param tint colour of the leaves, varied from leaf to leaf; \param levels how often its limbs fork, 5 for a near one
Tree tree(Random random, float height, vec3 tint, int levels);

/// A stone lantern: the stone, and the paper in its windows. Its flame burns at kFlameHeight.
struct Lantern {
    Mesh stone;
    Mesh paper;
};
inline constexpr float kFlameHeight = 0.98f;
Lantern lantern();

/// Arched footbridge along x, `length` metres.
Mesh bridge(float length);

}  // namespace luciole::garden
