#include "machine.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <cstdlib>
#include <fstream>
#include <thread>

#include "build_commit.hpp"

namespace luciole::bench {
namespace {

std::string processorName() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(std::min(line.find(':') + 2, line.size()));
    return "unknown";
}

std::string systemName() {
    utsname names{};
    if (::uname(&names) != 0) return "unknown";
    return fmt::format("{} {} {}", names.sysname, names.release, names.machine);
}

}  // namespace

Machine machineOf(const DeviceInfo& device) {
    const char* threads = std::getenv("LP_NUM_THREADS");
    return {.processor = processorName(),
            .threads = std::thread::hardware_concurrency(),
            .driverThreads = threads ? threads : "",
            .system = systemName(),
            .device = device.name,
            .driver = device.driver,
            .version = LUCIOLE_VERSION,
            .commit = kBuildCommit};
}

std::string describe(const Machine& machine) {
    return fmt::format("{}, {}; {}, {} threads{}; {}; luciole {}, commit {}", machine.device, machine.driver, machine.processor, machine.threads,
                       machine.driverThreads.empty() ? "" : ", LP_NUM_THREADS=" + machine.driverThreads, machine.system, machine.version, machine.commit);
}

}  // namespace luciole::bench
