#pragma once
#include <string>

#include <luciole/renderer.hpp>

namespace luciole::bench {

/// Where figures come from: they say nothing without.
struct Machine {
    std::string processor;  ///< as the system names it, "unknown" if it does not
    unsigned threads = 0;   ///< that the system runs at once
    std::string driverThreads;  ///< LP_NUM_THREADS, which Mesa's software driver heeds; empty: not set
    std::string system;     ///< name, release and architecture
    std::string device, driver;
    std::string version;    ///< of Luciole
    std::string commit;     ///< it was built from, "unknown" outside of a repository; ends in "-changed" if files differed from it
};
Machine machineOf(const DeviceInfo& device);

/// All of it in a line or two.
std::string describe(const Machine& machine);

}  // namespace luciole::bench
