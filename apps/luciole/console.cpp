#include "console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace luciole::cli {

void say(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

std::string printable(std::string_view text) {
    std::string result(text);
    std::replace_if(
        result.begin(), result.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    return result;
}

void Console::note(std::string_view text) const {
    if (!quiet) say(fmt::format("luciole: {}\n", printable(text)));
}

void Console::detail(std::string_view text) const {
    if (verbose) say(fmt::format("luciole: {}\n", printable(text)));
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
    if (percent_ >= 0) say(fmt::format("\r{:{}}\r", "", label_.size() + 6));
}

void ProgressLine::show(double share) {
    const int percent = int(100 * share);
    if (!enabled_ || percent == percent_ || Clock::now() - start_ < std::chrono::seconds(1)) return;
    percent_ = percent;
    say(fmt::format("\r{} {:3} %", label_, percent));
    std::fflush(stderr);
}

}  // namespace luciole::cli
