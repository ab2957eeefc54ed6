#pragma once
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace luciole::cli {

/// Prints to stderr. Where it is closed or full nobody is listening, and the work goes on.
void say(std::string_view text);

/// `text` with its control characters as spaces: names in files may hold line ends and a terminal's commands.
std::string printable(std::string_view text);

/// What is said to people: stderr only, stdout belongs to results.
class Console {
public:
    bool quiet = false;
    bool verbose = false;

    void note(std::string_view text) const;                     ///< unless quiet
    void detail(std::string_view text) const;                   ///< if verbose
    void warn(const std::vector<std::string>& warnings) const;  ///< unless quiet; the first ones, then a count
};

/// A line with the share done that is drawn over and over, from one second on, on a terminal only.
class ProgressLine {
public:
    ProgressLine(const Console& console, std::string label);
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine();  ///< wipes the line

    void show(double share);  ///< \param share done, [0, 1]

private:
    using Clock = std::chrono::steady_clock;
    std::string label_;
    bool enabled_;
    int percent_ = -1;  ///< what stands there now
    Clock::time_point start_ = Clock::now();
};

}  // namespace luciole::cli
