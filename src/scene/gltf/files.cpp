#include "scene/gltf/files.hpp"

#include <algorithm>
#include <array>
#include <system_error>

#include "io/file.hpp"

namespace luciole::gltf {

namespace fs = std::filesystem;

namespace {

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// RFC 3986, section 2.1.
std::string percentDecoded(const JsonNode& uri) {
    const std::string& text = uri.string();
    std::string result;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            result += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hexDigit(text[i + 2]) : -1;
        if (high < 0 || low < 0) uri.fail("two hexadecimal digits after %");
        result += char(high * 16 + low);
        i += 2;
    }
    return result;
}

/// `file:`, `http:`, `C:` ... (RFC 3986, section 3.1).
bool hasScheme(std::string_view uri) {
    const size_t colon = uri.find(':');
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto mayFollow = [&](char c) {
        return isLetter(c) || (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
    };
    return colon != uri.npos && colon > 0 && isLetter(uri[0]) &&
           std::all_of(uri.begin(), uri.begin() + std::ptrdiff_t(colon), mayFollow);
}

bool isInside(const fs::path& file, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

/// Value of each base64 character (RFC 4648, section 4), -1 for all others.
constexpr std::array<int, 256> kBase64 = [] {
    std::array<int, 256> values{};
    values.fill(-1);
    constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < kAlphabet.size(); ++i) values[uint8_t(kAlphabet[i])] = int(i);
    return values;
}();

}  // namespace

fs::path Files::resolve(const JsonNode& uri) const {
    const std::string name = percentDecoded(uri);
    if (name.empty() || name.find('\0') != name.npos) uri.fail("the name of a file");
    if (hasScheme(uri.string()) || hasScheme(name)) uri.fail("a relative path or a data URI");
    if (fs::path(name).is_absolute()) uri.fail("a relative path");
    if (folder_.empty()) uri.fail("a data URI, as the scene has no folder");
    std::error_code code;
    const fs::path folder = fs::canonical(folder_, code);
    fs::path file = fs::weakly_canonical(folder / name, code);
    if (code) uri.fail(fmt::format("a file that can be found ({})", code.message()));
    if (!allowExternal_ && !isInside(file, folder)) uri.fail("a file in the scene's folder");
    return file;
}

std::vector<std::byte> Files::read(const fs::path& file, const JsonNode& uri) const {
    try {
        return readFile(file, maxBytes_);
    } catch (const Error& e) {
        throw Error(e.kind(), fmt::format("{}: {}", uri.where(), e.what()));
    }
}

bool isDataUri(const JsonNode& uri) { return uri.string().starts_with("data:"); }

std::vector<std::byte> decodeDataUri(const JsonNode& uri) {
    constexpr std::string_view kMarker = ";base64,";
    std::string_view text = uri.string();
    const size_t marker = text.find(kMarker);
    if (marker == text.npos) uri.fail("data:TYPE;base64,DATA");
    text.remove_prefix(marker + kMarker.size());
    while (text.ends_with('=')) text.remove_suffix(1);

    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;  // read and not yet written, at the low end
    int bitCount = 0;
    for (const char c : text) {
        const int value = kBase64[uint8_t(c)];
        if (value < 0) uri.fail("base64 data");
        bits = (bits << 6 | uint32_t(value)) & 0xffff;
        bitCount += 6;
        if (bitCount < 8) continue;
        bitCount -= 8;
        bytes.push_back(std::byte(bits >> bitCount & 0xff));
    }
    return bytes;
}

BufferView Buffers::view(const JsonNode& reference) {
    const JsonNode json = resolve(root_, "bufferViews", reference);
    const auto bytes = buffer(indexInto(root_, "buffers", json.at("buffer")));
    const uint64_t offset = integerOr(json, "byteOffset", 0, 0, bytes.size());
    const uint64_t length = json.at("byteLength").integer(0, bytes.size() - offset);
    const uint64_t stride = integerOr(json, "byteStride", 0, 1, 252);
    return {bytes.subspan(offset, length), stride};
}

uint64_t Buffers::suppliedBytes() const {
    uint64_t sum = binaryChunk_.size();
    for (const auto& [index, bytes] : embedded_) sum += bytes.size();
    for (const auto& [path, bytes] : external_) sum += bytes.size();
    return sum;
}

std::span<const std::byte> Buffers::buffer(uint32_t index) {
    if (const auto found = buffers_.find(index); found != buffers_.end()) return found->second;
    const JsonNode json = root_.at("buffers")[index];
    const auto bytes = load(index, json);
    const uint64_t length = json.at("byteLength").integer(0, bytes.size());
    return buffers_[index] = bytes.first(length);
}

std::span<const std::byte> Buffers::load(uint32_t index, const JsonNode& buffer) {
    const auto uri = buffer.find("uri");
    if (!uri && index == 0 && !binaryChunk_.empty()) return binaryChunk_;
    if (!uri) buffer.failWith("expected a key \"uri\", as this buffer is not the binary chunk of a GLB file");
    if (isDataUri(*uri)) return embedded_[index] = decodeDataUri(*uri);
    const fs::path file = files_.resolve(*uri);
    if (const auto known = external_.find(file); known != external_.end()) return known->second;
    return external_[file] = files_.read(file, *uri);
}

}  // namespace luciole::gltf
