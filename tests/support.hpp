#pragma once
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <doctest/doctest.h>

namespace luciole::test {

/// Folder of test assets that the project does not ship: $LUCIOLE_ASSETS, or ../shared/assets beside the checkout.
inline std::optional<std::filesystem::path> assets() {
    if (const char* path = std::getenv("LUCIOLE_ASSETS")) return std::filesystem::path(path);
    const auto beside = std::filesystem::path(LUCIOLE_SOURCE_DIR) / ".." / "shared" / "assets";
    if (std::filesystem::is_directory(beside)) return beside;
    return std::nullopt;
}

}  // namespace luciole::test

/// Leaves the test with a message where the assets are absent; else declares `name` as their folder.
#define LUCIOLE_ASSETS_OR_SKIP(name)                                                                          \
    const auto name##Found = luciole::test::assets();                                                         \
    if (!name##Found) {                                                                                       \
        MESSAGE("skipped: no test assets; set LUCIOLE_ASSETS or put them into ../shared/assets");             \
        return;                                                                                               \
    }                                                                                                         \
    const std::filesystem::path name = *name##Found
