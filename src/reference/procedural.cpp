#include "reference/procedural.hpp"

#include <algorithm>
#include <cmath>

namespace luciole::reference {
namespace {

constexpr double kLattice = 4294967296.0;  ///< 2^32: hashes have 32 bits, and so have the lattice's coordinates

}  // namespace

// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering" (PCG), over a mix of the coordinates by Teschner et al.
// 2003, "Optimized Spatial Hashing for Collision Detection of Deformable Objects".
uint32_t latticeHash(int64_t i, int64_t j, int64_t k) {
    uint32_t h = (uint32_t(i) * 73856093u) ^ (uint32_t(j) * 19349663u) ^ (uint32_t(k) * 83492791u);
    h = h * 747796405u + 2891336453u;
    h = ((h >> ((h >> 28u) + 4u)) ^ h) * 277803737u;
    return (h >> 22u) ^ h;
}

double valueNoise(dvec3 p) {
    const dvec3 cell = floor(p);
    const dvec3 f = p - cell;
    const dvec3 weight = f * f * f * (f * (6.0 * f - 15.0) + 10.0);
    const dvec3 wrapped = mod(cell, kLattice);
    const auto value = [&](int x, int y, int z) {
        return double(latticeHash(int64_t(wrapped.x) + x, int64_t(wrapped.y) + y, int64_t(wrapped.z) + z)) / kLattice;
    };
    const auto alongX = [&](int y, int z) { return glm::mix(value(0, y, z), value(1, y, z), weight.x); };
    const auto alongY = [&](int z) { return glm::mix(alongX(0, z), alongX(1, z), weight.y); };
    return glm::mix(alongY(0), alongY(1), weight.z);
}

double checker(dvec3 p, dvec3 dx, dvec3 dy) {
    const auto s = [](dvec3 q) { return abs(fract(q / 2.0) - 0.5); };
    const dvec3 w = max(max(abs(dx), abs(dy)), 1e-4);
    const dvec3 shifted = p + 0.381966;
    const dvec3 i = 2.0 * (s(shifted - w / 2.0) - s(shifted + w / 2.0)) / w;
    return 0.5 - 0.5 * i.x * i.y * i.z;
}

// Perlin 1985, "An Image Synthesizer", section "Marble": a sine displaced by turbulence.
double marble(dvec3 p) {
    double turbulence = 0;
    for (int octave = 0; octave < 5; ++octave) {
        const double frequency = std::exp2(octave);
        turbulence += std::abs(2 * valueNoise(p * frequency) - 1) / frequency;
    }
    return std::pow(0.5 + 0.5 * std::sin(2 * kPi * (p.x + 0.5 * p.y + 0.7 * turbulence)), 3);
}

}  // namespace luciole::reference
