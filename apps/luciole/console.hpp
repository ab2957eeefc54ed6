#pragma once
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
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

/// A line that says what is going on and for how long, or how much of it is done. Drawn from one second on, on a terminal
/// only, by a thread of its own: neither a driver nor a reader calls back while it works.
class ProgressLine {
public:
    ProgressLine(const Console& console, std::string label);
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine();  ///< wipes the line

    void show(double share) { share_ = share; }  ///< \param share done, [0, 1]; never called: the time is shown

private:
    void draw(const std::stop_token& stop);

    std::string label_;
    std::atomic<double> share_ = -1;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::jthread thread_;  // last: it uses the others
};

}  // namespace luciole::cli
