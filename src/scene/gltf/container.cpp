#include "scene/gltf/container.hpp"

#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include <luciole/error.hpp>

namespace luciole::gltf {

namespace {

std::string_view asText(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Walks through the bytes of a GLB file (glTF 2.0, section 4.4), never past their end.
class GlbBytes {
public:
    GlbBytes(std::span<const std::byte> bytes, const std::string& file) : rest_(bytes), file_(file) {}

    bool empty() const { return rest_.empty(); }
    std::span<const std::byte> take(uint64_t count, std::string_view what) {
        if (rest_.size() < count) {
            fail(fmt::format("expected {} bytes of {}, got {}", count, what, rest_.size()));
        }
        const auto taken = rest_.first(count);
        rest_ = rest_.subspan(count);
        return taken;
    }
    uint32_t takeUint(std::string_view what) {
        uint32_t value = 0;
        std::memcpy(&value, take(4, what).data(), 4);
        return value;
    }
    /// Nothing beyond the next `count` bytes belongs to the file.
    void limit(uint64_t count) {
        if (rest_.size() < count) fail(fmt::format("expected a length of {} bytes, got {}", count, rest_.size()));
        rest_ = rest_.first(count);
    }
    [[noreturn]] void fail(std::string_view why) const {
        throw Error(ErrorKind::scene, fmt::format("{}: GLB: {}", file_, why));
    }

private:
    std::span<const std::byte> rest_;
    const std::string& file_;
};

constexpr std::string_view kGlbMagic = "glTF";
constexpr uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr uint32_t kHeaderBytes = 12;

}  // namespace

Container splitContainer(std::span<const std::byte> bytes, const std::string& file) {
    if (!asText(bytes).starts_with(kGlbMagic)) {
        const size_t first = asText(bytes).find_first_not_of(" \t\r\n");
        if (first != std::string_view::npos && std::string_view("{[\"\xEF").find(asText(bytes)[first]) == std::string_view::npos)
            throw Error(ErrorKind::scene, fmt::format("{}: expected \"glTF\" (GLB) or a JSON object at the beginning", file));
        return {asText(bytes), {}};
    }
    GlbBytes glb(bytes, file);
    glb.take(kGlbMagic.size(), "header");
    if (const uint32_t version = glb.takeUint("header"); version != 2) {
        glb.fail(fmt::format("expected version 2, got {}", version));
    }
    const uint32_t length = glb.takeUint("header");
    if (length < kHeaderBytes) glb.fail(fmt::format("expected a length of at least {}, got {}", kHeaderBytes, length));
    glb.limit(length - kHeaderBytes);

    Container container;
    for (uint32_t chunk = 0; !glb.empty(); ++chunk) {
        const uint32_t size = glb.takeUint("chunk header"), type = glb.takeUint("chunk header");
        const auto data = glb.take(size, "chunk");
        if ((chunk == 0) != (type == kJsonChunk)) glb.fail("expected one JSON chunk, the first");
        if (chunk == 0) container.json = asText(data);
        if (chunk == 1 && type == kBinaryChunk) container.binaryChunk = data;
    }
    return container;
}

}  // namespace luciole::gltf
