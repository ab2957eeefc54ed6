#include "reference/function_table.hpp"

#include <algorithm>

namespace luciole::reference {
namespace {

constexpr size_t kIntervals = 4096;

}  // namespace

FunctionTable::FunctionTable(const Function& function, double low) : low_(low) {
    samples_.reserve(kIntervals + 1);
    for (size_t i = 0; i <= kIntervals; ++i)
        samples_.push_back(evaluate(function, low + (1 - low) * double(i) / kIntervals, low));
}

dvec2 FunctionTable::operator()(double x) const {
    const double position = std::clamp((x - low_) / (1 - low_), 0.0, 1.0) * kIntervals;
    const size_t left = std::min(size_t(position), kIntervals - 1);
    return mix(samples_[left], samples_[left + 1], position - double(left));
}

FunctionTables::FunctionTables(const Scene& scene) {
    for (const Function& function : scene.functions) {
        ofCosine_.emplace_back(function, -1);
        ofDistance_.emplace_back(function, 0);
    }
}

}  // namespace luciole::reference
