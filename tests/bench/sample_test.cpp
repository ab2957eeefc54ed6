#include "sample.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace luciole::bench;

namespace {

/// 1, 2, ..., count, in another order.
Sample countingTo(size_t count) {
    std::vector<double> values;
    for (size_t i = 0; i < count; ++i) values.push_back(double((i * 7) % count) + 1);
    return sampleOf(values);
}

Timed timed(const char* name, double low, double median, double high) { return {name, {.count = 9, .median = median, .low = low, .high = high}}; }

}  // namespace

TEST_CASE("sample: medians and their intervals are those of the tables") {
    // Ranks of the 95 % interval of a median: Hahn and Meeker 1991, Statistical Intervals, table A.15.
    struct Row {
        size_t count, low, high;
    };
    for (const Row& row : {Row{6, 1, 6}, {8, 1, 8}, {9, 2, 8}, {10, 2, 9}, {20, 6, 15}, {30, 10, 21}, {40, 14, 27}}) {
        CAPTURE(row.count);
        const Sample sample = countingTo(row.count);
        CHECK(sample.count == row.count);
        CHECK(sample.median == double(row.count + 1) / 2);
        CHECK(sample.low == double(row.low));
        CHECK(sample.high == double(row.high));
        CHECK(sample.least == 1);
        CHECK(sample.p95 == std::ceil(0.95 * double(row.count)));
    }
    CHECK(countingTo(5).low == 1);  // of so few there is no such interval
    CHECK(countingTo(5).high == 5);
    const Sample one = sampleOf({3});
    CHECK(one.low == 3);
    CHECK(one.high == 3);
    CHECK(one.variation == 0);
    CHECK(sampleOf({1, 3}).variation == doctest::Approx(std::sqrt(2.0) / 2));
    CHECK(countingTo(10).halfWidth() == doctest::Approx(7 / 2.0 / 5.5));
}

TEST_CASE("sample: the interval holds the median as often as it says") {
    std::mt19937 random(1);
    std::lognormal_distribution<double> times(0, 1);  // with a median of 1, and as skew as frame times
    int held = 0;
    constexpr int kTrials = 4000;
    for (int i = 0; i < kTrials; ++i) {
        std::vector<double> values(10);
        for (double& value : values) value = times(random);
        const Sample sample = sampleOf(values);
        held += sample.low <= 1 && sample.high >= 1;
    }
    CHECK(double(held) / kTrials == doctest::Approx(1 - 2 * 11 / 1024.0).epsilon(0.01));  // two tails of the binomial distribution
}

TEST_CASE("sample: only those are ranked whose intervals do not overlap") {
    CHECK(verdict({timed("slow", 5, 6, 7), timed("fast", 1, 2, 3)}) == "Fastest: fast; then slow.");
    CHECK(verdict({timed("a", 1, 2, 3), timed("b", 2.9, 4, 5)}) == "Fastest: a and b, which these frames do not tell apart.");
    // c overlaps b, but not a, the fastest of the group.
    CHECK(verdict({timed("a", 1, 2, 3), timed("b", 2.5, 4, 5), timed("c", 4.5, 6, 7)}) ==
          "Fastest: a and b, which these frames do not tell apart; then c.");
    CHECK(verdict({timed("a", 1, 2, 3), timed("b", 1, 2, 3), timed("c", 1, 2, 3)}) ==
          "Fastest: a, b and c, which these frames do not tell apart from the first.");
    CHECK(toldApart({.low = 1, .high = 2}, {.low = 2.1, .high = 3}));
    CHECK_FALSE(toldApart({.low = 1, .high = 2}, {.low = 2, .high = 3}));
}
