#include "io/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <luciole/error.hpp>
#include <system_error>
#include <utility>

namespace luciole {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, std::string_view action, int code) {
    throw Error(ErrorKind::io,
                fmt::format("{}: can't {}: {}", file.string(), action, std::generic_category().message(code)));
}

class Descriptor {
public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Descriptor& operator=(Descriptor&&) = delete;
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    int get() const { return fd_; }

    /// Some file systems report a failed write only here.
    int close() { return ::close(std::exchange(fd_, -1)); }

private:
    int fd_;
};

/// A file with a name of its own in the target's folder; removed again unless it is renamed.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& target) : target_(target), descriptor_(create()) {}
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (!path_.empty()) ::unlink(path_.c_str());
    }

    void write(std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_.get(), bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) fail(target_, "write", errno);
            bytes = bytes.subspan(size_t(written));
        }
        if (::fsync(descriptor_.get()) != 0) fail(target_, "write", errno);
        if (descriptor_.close() != 0) fail(target_, "write", errno);
    }

    void renameToTarget() {
        if (std::rename(path_.c_str(), target_.c_str()) != 0) fail(target_, "write", errno);
        path_.clear();
    }

private:
    Descriptor create() {
        static std::atomic<uint32_t> counter = 0;
        for (;;) {
            // Not built on the target's name, which may already be as long as the file system allows.
            path_ = target_.parent_path() / fmt::format(".luciole-{}-{}.tmp", ::getpid(), counter++);
            const int fd = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            if (fd >= 0) {
                struct stat old {};  // a private file stays private
                if (::stat(target_.c_str(), &old) == 0) ::fchmod(fd, old.st_mode & 0777);
                return Descriptor(fd);
            }
            if (errno == EEXIST || errno == EINTR) continue;
            const int code = errno;
            path_.clear();
            fail(target_, "write", code);
        }
    }

    fs::path target_;
    fs::path path_;
    Descriptor descriptor_;
};

/// Where the bytes have to go: links are followed, so that a link stays one, even one to nothing yet; a device or
/// folder is refused, as renaming over it would replace it.
fs::path resolveTarget(const fs::path& file) {
    std::error_code code;
    const fs::file_status status = fs::status(file, code);
    if (status.type() == fs::file_type::regular) return fs::canonical(file, code);
    if (status.type() == fs::file_type::directory) fail(file, "write", EISDIR);
    if (status.type() == fs::file_type::none) fail(file, "write", code.value());  // a long name, a loop of links
    if (fs::exists(status))
        throw Error(ErrorKind::io, fmt::format("{}: can't write: not a regular file", file.string()));
    if (file.filename().empty()) fail(file, "write", file.empty() ? ENOENT : EISDIR);
    fs::path target = file;  // nothing is there; `status` has refused a loop of links
    while (fs::is_symlink(fs::symlink_status(target, code)))
        target = target.parent_path() / fs::read_symlink(target, code);
    return target.has_parent_path() ? target : "." / target;
}

/// Makes the new name survive a power cut. A folder that can't be synced (some network file systems) is not an error:
/// the file itself is already safe.
void syncFolder(const fs::path& folder) {
    const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (descriptor.get() >= 0) ::fsync(descriptor.get());
}

}  // namespace

std::vector<std::byte> readFile(const fs::path& file, uint64_t maxBytes) {
    // Non-blocking, so that opening a FIFO without a writer returns and is refused below.
    const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (descriptor.get() < 0) fail(file, "read", errno);
    struct stat status {};
    if (::fstat(descriptor.get(), &status) != 0) fail(file, "read", errno);
    if (S_ISDIR(status.st_mode)) fail(file, "read", EISDIR);
    if (!S_ISREG(status.st_mode))
        throw Error(ErrorKind::io, fmt::format("{}: can't read: not a regular file", file.string()));
    const auto size = uint64_t(status.st_size);
    if (size > maxBytes)
        throw Error(ErrorKind::limit,
                    fmt::format("{}: expected at most {} bytes, got {}", file.string(), maxBytes, size));

    std::vector<std::byte> bytes(size);
    size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = ::read(descriptor.get(), bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(file, "read", errno);
        if (count == 0) break;  // somebody shortened it meanwhile
        done += size_t(count);
    }
    bytes.resize(done);
    return bytes;
}

void writeFileAtomically(const fs::path& file, std::span<const std::byte> bytes) {
    const fs::path target = resolveTarget(file);
    TemporaryFile temporary(target);
    temporary.write(bytes);
    temporary.renameToTarget();
    syncFolder(target.parent_path());
}

}  // namespace luciole
