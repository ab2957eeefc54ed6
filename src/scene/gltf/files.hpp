#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf/json.hpp"

namespace luciole::gltf {

/// Where a glTF file's URIs may lead: into the file's own folder, symbolic links resolved, and into data URIs.
class Files {
public:
    /// \param folder of the glTF file; empty: only data URIs
    Files(std::filesystem::path folder, const LoadOptions& options)
        : folder_(std::move(folder)), allowExternal_(options.allowExternal), maxBytes_(options.limits.maxFileBytes) {}

    /// The file that the string `uri` names.
    /// \throws Error(scene) for an absolute path or a scheme, and for what lies outside of the folder unless allowed
    std::filesystem::path resolve(const JsonNode& uri) const;
    /// \param file from `resolve`; \param uri to be named in messages
    /// \throws Error(io) if it can't be read, Error(limit)
    std::vector<std::byte> read(const std::filesystem::path& file, const JsonNode& uri) const;

private:
    std::filesystem::path folder_;
    bool allowExternal_;
    uint64_t maxBytes_;
};

bool isDataUri(const JsonNode& uri);
/// The bytes of the base64 data URI `uri`.
std::vector<std::byte> decodeDataUri(const JsonNode& uri);

/// A stretch of a buffer. `stride` is the distance between elements in bytes, 0 where the file gives none.
struct BufferView {
    std::span<const std::byte> bytes;
    uint64_t stride = 0;
};

/// The document's buffers, each read when it is first used.
class Buffers {
public:
    /// \param root of the document; must outlive this, as must `binaryChunk`, which is empty unless the file is a GLB
    Buffers(const JsonNode& root, std::span<const std::byte> binaryChunk, const Files& files)
        : root_(root), binaryChunk_(binaryChunk), files_(files) {}

    /// The buffer view that `reference` is the index of; lies within its buffer. Valid as long as this object.
    BufferView view(const JsonNode& reference);

    /// Bytes of the buffers read so far: what the file has supplied.
    uint64_t suppliedBytes() const;

private:
    std::span<const std::byte> buffer(uint32_t index);
    std::span<const std::byte> load(uint32_t index, const JsonNode& buffer);

    JsonNode root_;
    std::span<const std::byte> binaryChunk_;
    const Files& files_;
    std::map<uint32_t, std::span<const std::byte>> buffers_;
    std::map<uint32_t, std::vector<std::byte>> embedded_;
    // By path and not by index: a thousand buffers that name one large file cost it once.
    std::map<std::filesystem::path, std::vector<std::byte>> external_;
};

}  // namespace luciole::gltf
