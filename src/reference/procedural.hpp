#pragma once
#include <cstdint>

#include <luciole/math.hpp>

/// Surface patterns over object space (docs/conventions.md, "Surface").
namespace luciole::reference {

/// The pseudo-random number of a lattice point, 32 bits.
uint32_t latticeHash(int64_t i, int64_t j, int64_t k);

/// Value noise in [0, 1), smooth to the second derivative.
double valueNoise(dvec3 p);

/// Share of the first colour, [0, 1], in a checkerboard with cells of size 1.
/// \param p position in cells; \param dx, dy its differences to the neighbouring pixels
double checker(dvec3 p, dvec3 dx, dvec3 dy);

/// Share of the veins' colour, [0, 1], in marble with one vein per unit along x.
double marble(dvec3 p);

}  // namespace luciole::reference
