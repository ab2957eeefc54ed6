#pragma once
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace luciole::test {

/// How one run of the command line ended.
struct Run {
    int exitCode = -1;  ///< -1 if a signal ended it
    std::string out;
    std::string err;
};

/// One process; `environment` holds NAME=VALUE, added to our own.
class Process {
public:
    explicit Process(std::vector<std::string> command, const std::vector<std::string>& environment = {});
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    ~Process();

    void interrupt() const;  ///< as Ctrl-C does
    std::string errSoFar() const;
    Run wait();

private:
    std::filesystem::path folder_;  ///< holds what it prints
    pid_t pid_ = -1;
};

/// `luciole ARGUMENTS...` from start to end.
Run runLuciole(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {});

/// `luciole` with its arguments, as words for a Process.
std::vector<std::string> lucioleCommand(const std::vector<std::string>& arguments);

/// Hides every Vulkan driver from the loader.
std::vector<std::string> withoutDrivers();

bool has(const std::string& text, std::string_view part);
std::string textOf(const std::filesystem::path& file);
void writeText(const std::filesystem::path& file, std::string_view text);

}  // namespace luciole::test
