#pragma once
#include <cstdint>

namespace luciole {

/// PCG32 (O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms", XSH RR 64/32).
/// Our own, as the standard's distributions differ between libraries: the same seed is the same scene everywhere.
class Random {
public:
    explicit Random(uint64_t seed, uint64_t stream = 0) : increment_((stream << 1) | 1) {
        next();
        state_ += seed;
        next();
    }

    /// Uniform over all 32-bit numbers.
    uint32_t next() {
        const uint64_t old = state_;
        state_ = old * 6364136223846793005ull + increment_;
        const auto shifted = uint32_t(((old >> 18) ^ old) >> 27);
        const auto turn = uint32_t(old >> 59);
        return (shifted >> turn) | (shifted << ((32 - turn) & 31));
    }

    double unit() { return next() * 0x1p-32; }                                       ///< uniform in [0, 1)
    double between(double low, double high) { return low + (high - low) * unit(); }  ///< uniform in [low, high)
    /// Uniform in [0, count), count > 0; the bias of at most count / 2^32 is of no matter here.
    uint32_t below(uint32_t count) { return uint32_t((uint64_t(next()) * count) >> 32); }

private:
    uint64_t state_ = 0;
    uint64_t increment_;
};

}  // namespace luciole
