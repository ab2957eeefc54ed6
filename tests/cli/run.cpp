#include "cli/run.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace luciole::test {
namespace {

namespace fs = std::filesystem;

std::vector<char*> pointersTo(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

fs::path makeFolder() {
    std::string name = (fs::temp_directory_path() / "luciole-run-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("can't make a folder for the test");
    return name;
}

}  // namespace

Process::Process(std::vector<std::string> command, const std::vector<std::string>& environment)
    : folder_(makeFolder()) {
    std::vector<std::string> variables = environment;  // the first of a name counts
    for (char** variable = ::environ; *variable; ++variable) variables.emplace_back(*variable);

    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    const std::string out = folder_ / "out", err = folder_ / "err";
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT, 0600);
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawnattr_t attributes;  // what runs the tests may ignore Ctrl-C
    ::posix_spawnattr_init(&attributes);
    sigset_t defaults;
    ::sigemptyset(&defaults);
    ::sigaddset(&defaults, SIGINT);
    ::posix_spawnattr_setsigdefault(&attributes, &defaults);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    const int code = ::posix_spawn(&pid_, command.front().c_str(), &actions, &attributes, pointersTo(command).data(),
                                   pointersTo(variables).data());
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    if (code != 0) throw std::runtime_error("can't start " + command.front());
}

Process::~Process() {
    if (pid_ > 0) {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
    }
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

void Process::interrupt() const { ::kill(pid_, SIGINT); }

std::string Process::errSoFar() const { return textOf(folder_ / "err"); }

Run Process::wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOf(folder_ / "out"), textOf(folder_ / "err")};
}

std::vector<std::string> lucioleCommand(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{LUCIOLE_BINARY};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return command;
}

Run runLuciole(const std::vector<std::string>& arguments, const std::vector<std::string>& environment) {
    return Process(lucioleCommand(arguments), environment).wait();
}

std::vector<std::string> withoutDrivers() { return {"VK_ICD_FILENAMES=/nonexistent", "VK_DRIVER_FILES=/nonexistent"}; }

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

std::string textOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void writeText(const fs::path& file, std::string_view text) { std::ofstream(file, std::ios::binary) << text; }

}  // namespace luciole::test
