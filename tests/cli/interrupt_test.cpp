#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "cli/run.hpp"
#include "io/temporary_folder.hpp"

using namespace luciole::test;

TEST_CASE("cli: Ctrl-C ends a rendering with 130 within a second and leaves nothing behind") {
    using namespace std::chrono;
    const TemporaryFolder folder;
    // Takes far longer than this test waits.
    Process process(lucioleCommand(
        {"render", "builtin:hall", "--lighting", "reference", "--size", "4096x4096", "-v", "-o", folder / "a.png"}));
    const auto deadline = steady_clock::now() + seconds(60);
    while (!has(process.errSoFar(), "scene loaded")) {
        REQUIRE(steady_clock::now() < deadline);
        std::this_thread::sleep_for(milliseconds(20));
    }
    const auto start = steady_clock::now();
    process.interrupt();
    const Run run = process.wait();
    CHECK(run.exitCode == 130);
    CHECK(run.out.empty());
    CHECK(steady_clock::now() - start < seconds(1));
    CHECK(folder.count() == 0);
}
