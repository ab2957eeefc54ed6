#include "console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace luciole::cli {

namespace {

/// What is left if the rest goes on as the part before. \param seconds it took so far
std::string timeLeft(double share, int64_t seconds) {
    if (share <= 0) return "";
    const auto left = int64_t(double(seconds) * (1 - share) / share);
    return left < 120 ? fmt::format(", {} s left", left) : fmt::format(", {} min left", (left + 30) / 60);
}

}  // namespace

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

ProgressLine::ProgressLine(const Console& console, std::string label) : label_(std::move(label)) {
    if (!console.quiet && ::isatty(STDERR_FILENO) != 0) thread_ = std::jthread([this](const std::stop_token& stop) { draw(stop); });
}

ProgressLine::~ProgressLine() = default;

void ProgressLine::draw(const std::stop_token& stop) {
    using namespace std::chrono_literals;
    const auto start = std::chrono::steady_clock::now();
    const auto pause = [&](std::chrono::milliseconds time) {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, stop, time, [] { return false; });
    };
    size_t width = 0;
    for (pause(1s); !stop.stop_requested(); pause(200ms)) {
        const double share = share_;
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - start).count();
        const std::string line = share < 0 ? fmt::format("{} {} s", label_, seconds) : fmt::format("{} {:3.0f} %{}", label_, 100 * share, timeLeft(share, seconds));
        width = std::max(width, line.size());
        say(fmt::format("\r{:{}}", line, width));
        std::fflush(stderr);
    }
    if (width > 0) say(fmt::format("\r{:{}}\r", "", width));
}

}  // namespace luciole::cli
