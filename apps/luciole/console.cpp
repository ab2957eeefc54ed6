#include "console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace luciole::cli {

void Console::note(std::string_view text) const {
    if (!quiet) fmt::print(stderr, "luciole: {}\n", text);
}

void Console::detail(std::string_view text) const {
    if (verbose) fmt::print(stderr, "luciole: {}\n", text);
}

void Console::warn(const std::vector<std::string>& warnings) const {
    constexpr size_t kShown = 20;
    const size_t shown = verbose ? warnings.size() : std::min(warnings.size(), kShown);
    for (size_t i = 0; i < shown; ++i) note(fmt::format("warning: {}", warnings[i]));
    if (shown < warnings.size()) note(fmt::format("... and {} more warnings; -v shows all", warnings.size() - shown));
}

ProgressLine::ProgressLine(const Console& console, std::string label)
    : label_(std::move(label)), enabled_(!console.quiet && ::isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
    if (percent_ >= 0) fmt::print(stderr, "\r{:{}}\r", "", label_.size() + 6);
}

void ProgressLine::show(double share) {
    const int percent = int(100 * share);
    if (!enabled_ || percent == percent_ || Clock::now() - start_ < std::chrono::seconds(1)) return;
    percent_ = percent;
    fmt::print(stderr, "\r{} {:3} %", label_, percent);
    std::fflush(stderr);
}

}  // namespace luciole::cli
