#include "sample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace luciole::bench {
namespace {

/// The largest r for which the r-th values from below and above, counted from 1, enclose the median with 95 % confidence; 0 if none does.
size_t rankOfInterval(size_t count) {
    double chance = std::exp2(-double(count)), below = chance;  // that at most r - 1 values lie below the median
    size_t r = 0;
    for (; below <= 0.025 && r < count / 2; below += chance) {
        ++r;
        chance *= double(count - r + 1) / double(r);
    }
    return r;
}

}  // namespace

Sample sampleOf(std::vector<double> values) {
    std::ranges::sort(values);
    const size_t count = values.size(), r = rankOfInterval(count);
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / double(count);
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return {.count = count,
            .median = (values[(count - 1) / 2] + values[count / 2]) / 2,
            .low = values[r == 0 ? 0 : r - 1],
            .high = values[r == 0 ? count - 1 : count - r],
            .p95 = values[size_t(std::ceil(0.95 * double(count))) - 1],
            .least = values[0],
            .variation = count > 1 && mean > 0 ? std::sqrt(squares / double(count - 1)) / mean : 0};
}

std::vector<std::vector<Timed>> rank(std::vector<Timed> all) {
    std::ranges::stable_sort(all, {}, [](const Timed& timed) { return timed.ms.median; });
    std::vector<std::vector<Timed>> groups;
    for (Timed& timed : all) {
        if (groups.empty() || toldApart(groups.back().front().ms, timed.ms)) groups.emplace_back();
        groups.back().push_back(std::move(timed));
    }
    return groups;
}

std::string verdict(const std::vector<Timed>& all) {
    std::string text;
    for (const auto& group : rank(all)) {
        text += text.empty() ? "Fastest: " : "; then ";
        for (size_t i = 0; i < group.size(); ++i) text += (i == 0 ? "" : i + 1 == group.size() ? " and " : ", ") + group[i].name;
        if (group.size() > 1) text += group.size() == 2 ? ", which these frames do not tell apart" : ", which these frames do not tell apart from the first";
    }
    return text + ".";
}

}  // namespace luciole::bench
