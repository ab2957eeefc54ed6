#include "render/driver_cache.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

#include "io/temporary_folder.hpp"

using namespace luciole;
using namespace luciole::render;
using luciole::test::TemporaryFolder;

namespace {

const DeviceInfo kDevice{.name = "a device", .driver = "its driver 1.0"};

DriverCache cacheIn(const TemporaryFolder& folder, uint32_t version = 1, const DeviceInfo& device = kDevice) {
    return {folder.path().string(), "test", version, device};
}

std::filesystem::path onlyFile(const TemporaryFolder& folder) {
    REQUIRE(folder.count() == 1);
    return std::filesystem::directory_iterator(folder.path())->path();
}

std::string textOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void keepTwo(const TemporaryFolder& folder) {
    DriverCache cache = cacheIn(folder);
    cache.keep("one", "1.5 metres");
    cache.keep("two", "");
}

}  // namespace

TEST_CASE("driver cache: what was kept is found at the next start") {
    const TemporaryFolder folder;
    keepTwo(folder);
    const DriverCache again = cacheIn(folder);
    REQUIRE(again.find("one"));
    CHECK(*again.find("one") == "1.5 metres");
    REQUIRE(again.find("two"));
    CHECK(again.find("two")->empty());
    CHECK(again.find("three") == nullptr);
}

TEST_CASE("driver cache: another device, driver or version finds nothing, even in the same file") {
    const TemporaryFolder folder;
    keepTwo(folder);
    CHECK(cacheIn(folder, 2).find("one") == nullptr);
    CHECK(cacheIn(folder, 1, {.name = "a device", .driver = "its driver 1.1"}).find("one") == nullptr);
    CHECK(cacheIn(folder, 1, {.name = "another", .driver = "its driver 1.0"}).find("one") == nullptr);
    // Names that become the same file name.
    const DeviceInfo alike{.name = "a+device", .driver = "its driver 1.0"};
    CHECK(cacheIn(folder, 1, alike).find("one") == nullptr);
    CHECK(cacheIn(folder).find("one") != nullptr);
}

TEST_CASE("driver cache: a damaged file is as good as none, and is made anew") {
    const TemporaryFolder folder;
    keepTwo(folder);
    const std::filesystem::path file = onlyFile(folder);
    const std::string whole = textOf(file);
    const auto holds = [&](const std::string& text) {
        std::ofstream(file, std::ios::binary) << text;
        return cacheIn(folder).find("one") != nullptr;
    };
    REQUIRE(holds(whole));
    for (size_t length = 0; length < whole.size(); ++length) CHECK_FALSE(holds(whole.substr(0, length)));
    for (size_t at = 0; at < whole.size(); ++at) {
        std::string flipped = whole;
        flipped[at] = char(flipped[at] ^ 1);
        CHECK_FALSE(holds(flipped));
    }
    CHECK_FALSE(holds(whole + whole));
    CHECK_FALSE(holds(std::string(2 << 20, '\0')));
    cacheIn(folder).keep("one", "again");
    CHECK(*cacheIn(folder).find("one") == "again");
}

TEST_CASE("driver cache: without a folder that can be written it lasts as long as the process") {
    for (const char* folder : {"", "/dev/null/nowhere", "/proc/nowhere"}) {
        DriverCache cache(folder, "test", 1, kDevice);
        cache.keep("one", "1");
        REQUIRE(cache.find("one"));
        CHECK(*cache.find("one") == "1");
        CHECK(DriverCache(folder, "test", 1, kDevice).find("one") == nullptr);
    }
    // A folder stands where the file should.
    const TemporaryFolder folder;
    keepTwo(folder);
    const std::filesystem::path file = onlyFile(folder);
    std::filesystem::remove(file);
    std::filesystem::create_directories(file / "inside");
    DriverCache cache = cacheIn(folder);
    CHECK(cache.find("one") == nullptr);
    cache.keep("one", "1");
    CHECK(*cache.find("one") == "1");
}
