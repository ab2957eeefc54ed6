#include "io/file.hpp"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <luciole/error.hpp>
#include <string_view>

#include "io/temporary_folder.hpp"

using namespace luciole;
namespace fs = std::filesystem;

namespace {

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

std::string textOf(const fs::path& file) {
    const auto bytes = readFile(file, 1 << 20);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// What an error says; the test fails if there is none, or one of another kind.
template <typename Action>
std::string messageOf(ErrorKind kind, Action action) {
    try {
        action();
    } catch (const Error& error) {
        CHECK(error.kind() == kind);
        return error.what();
    }
    FAIL_CHECK("expected an error");
    return "";
}

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

/// Writes beyond `bytes` fail with "File too large", as on a full disk.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        previous_ = std::signal(SIGXFSZ, SIG_IGN);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, previous_);
    }

private:
    rlimit before_{};
    void (*previous_)(int) = SIG_DFL;
};

}  // namespace

TEST_CASE("file: what was written is read back, and the folder holds nothing else") {
    const test::TemporaryFolder folder;
    writeFileAtomically(folder / "a.bin", bytesOf("first"));
    writeFileAtomically(folder / "a.bin", bytesOf("second"));
    writeFileAtomically(folder / "empty.bin", {});
    CHECK(textOf(folder / "a.bin") == "second");
    CHECK(textOf(folder / "empty.bin").empty());
    CHECK(folder.count() == 2);
}

TEST_CASE("file: a name as long as the file system allows can be written") {
    const test::TemporaryFolder folder;
    const std::string name(255, 'x');
    writeFileAtomically(folder / name, bytesOf("long"));
    CHECK(textOf(folder / name) == "long");
}

TEST_CASE("file: a failed write names the file and the reason, keeps the old content and leaves nothing behind") {
    const test::TemporaryFolder folder;
    const fs::path file = folder / "picture.png";
    writeFileAtomically(file, bytesOf("old"));
    const std::string large(1 << 16, 'x');
    const FileSizeLimit limit(1 << 12);
    const std::string message = messageOf(ErrorKind::io, [&] { writeFileAtomically(file, bytesOf(large)); });
    CHECK(has(message, file.string()));
    CHECK(has(message, "File too large"));
    CHECK(textOf(file) == "old");
    CHECK(folder.count() == 1);
}

TEST_CASE("file: a missing folder, and a file in place of a folder, are refused with the system's reason") {
    const test::TemporaryFolder folder;
    writeFileAtomically(folder / "file", {});
    CHECK(has(messageOf(ErrorKind::io, [&] { writeFileAtomically(folder / "none/a.png", {}); }), "No such file"));
    CHECK(has(messageOf(ErrorKind::io, [&] { writeFileAtomically(folder / "file/a.png", {}); }), "Not a directory"));
    CHECK(has(messageOf(ErrorKind::io, [&] { writeFileAtomically(folder.path(), {}); }), "Is a directory"));
    CHECK(has(messageOf(ErrorKind::io, [&] { writeFileAtomically("", {}); }), "No such file"));
}

TEST_CASE("file: a folder without write permission is refused") {
    if (::geteuid() == 0) {
        MESSAGE("skipped: root may write anywhere");
        return;
    }
    const test::TemporaryFolder folder;
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
    CHECK(has(messageOf(ErrorKind::io, [&] { writeFileAtomically(folder / "a.png", {}); }), "Permission denied"));
    fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST_CASE("file: a device or FIFO is never replaced by a file, nor read") {
    const test::TemporaryFolder folder;
    const fs::path fifo = folder / "fifo";
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    CHECK(has(messageOf(ErrorKind::io, [&] { writeFileAtomically(fifo, {}); }), "not a regular file"));
    CHECK(has(messageOf(ErrorKind::io, [&] { readFile(fifo, 100); }), "not a regular file"));
    CHECK(fs::is_fifo(fifo));
}

TEST_CASE("file: writing through a symbolic link changes the file it points to") {
    const test::TemporaryFolder folder;
    const test::TemporaryFolder elsewhere;
    writeFileAtomically(elsewhere / "real", bytesOf("old"));
    fs::create_symlink(elsewhere / "real", folder / "link");
    writeFileAtomically(folder / "link", bytesOf("new"));
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(textOf(elsewhere / "real") == "new");
}

TEST_CASE("file: writing through a symbolic link to nothing makes the file that it points to") {
    const test::TemporaryFolder folder;
    fs::create_symlink("real", folder / "link");
    fs::create_symlink("link", folder / "link to link");
    writeFileAtomically(folder / "link to link", bytesOf("new"));
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(fs::is_symlink(folder / "link to link"));
    CHECK(textOf(folder / "real") == "new");
    fs::create_symlink("loop", folder / "loop");
    CHECK(has(messageOf(ErrorKind::io, [&] { writeFileAtomically(folder / "loop", {}); }), "symbolic links"));
}

TEST_CASE("file: a file keeps its permissions when it is written again") {
    const test::TemporaryFolder folder;
    writeFileAtomically(folder / "private", bytesOf("old"));
    fs::permissions(folder / "private", fs::perms::owner_read | fs::perms::owner_write);
    writeFileAtomically(folder / "private", bytesOf("new"));
    CHECK(fs::status(folder / "private").permissions() == (fs::perms::owner_read | fs::perms::owner_write));
    CHECK(textOf(folder / "private") == "new");
}

TEST_CASE("file: reading says why it can't, and keeps to its limit") {
    const test::TemporaryFolder folder;
    writeFileAtomically(folder / "five", bytesOf("12345"));
    CHECK(readFile(folder / "five", 5).size() == 5);
    const std::string message = messageOf(ErrorKind::limit, [&] { readFile(folder / "five", 4); });
    CHECK(has(message, "at most 4 bytes, got 5"));
    CHECK(has(messageOf(ErrorKind::io, [&] { readFile(folder / "none", 4); }), "No such file"));
    CHECK(has(messageOf(ErrorKind::io, [&] { readFile(folder.path(), 4); }), "Is a directory"));
}
