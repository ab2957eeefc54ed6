#include <doctest/doctest.h>

#include <cmath>

#include "reference/procedural.hpp"

using namespace luciole;
using namespace luciole::reference;
using doctest::Approx;

TEST_CASE("marble: lattice hashes are the formula's numbers") {
    // Computed from docs/conventions.md with Python's integers.
    CHECK(latticeHash(0, 0, 0) == 129708002u);
    CHECK(latticeHash(1, 0, 0) == 2340206819u);
    CHECK(latticeHash(0, 1, 0) == 1478043691u);
    CHECK(latticeHash(0, 0, 1) == 1752554849u);
    CHECK(latticeHash(-1, 2, -3) == 2587648815u);
    CHECK(latticeHash(1000, -7, 5) == 853206957u);
}

TEST_CASE("marble: noise is the hash at lattice points, the mean in the middle, and steady across cells") {
    CHECK(valueNoise({-1, 2, -3}) == latticeHash(-1, 2, -3) / 4294967296.0);
    const double ends = (double(latticeHash(0, 0, 0)) + double(latticeHash(1, 0, 0))) / 4294967296.0;
    CHECK(valueNoise({0.5, 0, 0}) == Approx(ends / 2).epsilon(1e-15));  // the weight of 0.5 is 0.5
    CHECK(valueNoise({3 - 1e-9, 0.3, 0.7}) == Approx(valueNoise({3 + 1e-9, 0.3, 0.7})).epsilon(1e-12));
}

TEST_CASE("marble: veins lie in [0, 1] and follow the sine of x where turbulence is known") {
    for (int i = 0; i < 1000; ++i) {
        const double m = marble({0.37 * i, -0.11 * i, 0.05 * i});
        CHECK(m >= 0);
        CHECK(m <= 1);
    }
    double turbulence = 0;  // at lattice points all octaves read lattice points
    for (int o = 0; o < 5; ++o)
        turbulence += std::abs(double(latticeHash(2 << o, 4 << o, 6 << o)) / 2147483648.0 - 1) / (1 << o);
    CHECK(marble({2, 4, 6}) == Approx(std::pow(0.5 + 0.5 * std::sin(2 * kPi * 0.7 * turbulence), 3)).epsilon(1e-9));
}

TEST_CASE("checker: cells alternate along every axis") {
    const auto at = [](double x, double y, double z) { return checker({x, y, z}, dvec3(0), dvec3(0)); };
    const double here = at(0, 0, 0);
    CHECK((here == Approx(0).epsilon(1e-9) || here == Approx(1).epsilon(1e-9)));
    CHECK(at(1, 0, 0) == Approx(1 - here).epsilon(1e-9));
    CHECK(at(0, -1, 0) == Approx(1 - here).epsilon(1e-9));
    CHECK(at(0, 0, 5) == Approx(1 - here).epsilon(1e-9));
    CHECK(at(1, 1, 0) == Approx(here).epsilon(1e-9));
    CHECK(at(1, 1, 1) == Approx(1 - here).epsilon(1e-9));
    CHECK(at(0.6179, 0, 0) == Approx(here).epsilon(1e-9));  // the boundary is at 1 - 0.381966
    CHECK(at(0.6182, 0, 0) == Approx(1 - here).epsilon(1e-9));
}

TEST_CASE("checker: a pixel on a boundary gets the covered share, one as wide as two cells gets the mean") {
    const double here = checker({0, 0, 0}, dvec3(0), dvec3(0));
    const double boundary = 1 - 0.381966;
    const auto filtered = [&](double x, double width) { return checker({x, 0, 0}, {width, 0, 0}, dvec3(0)); };
    CHECK(filtered(boundary, 0.2) == Approx(0.5).epsilon(1e-9));
    CHECK(filtered(boundary - 0.05, 0.2) == Approx(here == 1 ? 0.75 : 0.25).epsilon(1e-9));
    CHECK(filtered(0.123, 2) == Approx(0.5).epsilon(1e-9));
    CHECK(checker({0, 0, 0}, dvec3(1e30), dvec3(1e30)) == Approx(0.5).epsilon(1e-9));
}
