#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace luciole::bench {

/// What repeated measurements of one thing say.
struct Sample {
    size_t count = 0;
    double median = 0;
    double low = 0, high = 0;  ///< the median's 95 % confidence interval: between two of the values (Hahn and Meeker 1991, Statistical
                               ///< Intervals, section 5.2), whatever their distribution; of fewer than 6, which can't give one, all of them
    double p95 = 0;            ///< 95 % of the values are at most that
    double least = 0;
    double variation = 0;      ///< coefficient of variation: standard deviation / mean

    double halfWidth() const { return median > 0 ? (high - low) / 2 / median : 0; }  ///< of the interval, relative to the median
};
Sample sampleOf(std::vector<double> values);  ///< \param values at least one

/// Whether the intervals do not overlap, so that one may be called faster.
inline bool toldApart(const Sample& a, const Sample& b) { return a.high < b.low || b.high < a.low; }

struct Timed {
    std::string name;
    Sample ms;
};
/// From fast to slow by medians, in groups: members of a group are not told apart from the group's fastest.
std::vector<std::vector<Timed>> rank(std::vector<Timed> all);

/// The ranking in a sentence: who is fastest, and who is not told apart from whom. \param all at least one
std::string verdict(const std::vector<Timed>& all);

}  // namespace luciole::bench
