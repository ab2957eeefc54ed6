#include <fmt/format.h>
#include <spng.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <luciole/error.hpp>
#include <memory>
#include <new>

#include "io/image_codec.hpp"

namespace luciole {
namespace {

/// One picture being decoded: its bytes, its name in messages, and what it may cost.
struct Source {
    std::span<const std::byte> bytes;
    const std::string& name;
    uint32_t maxSide;
    uint64_t maxBytes;

    [[noreturn]] void fail(std::string_view why) const {
        throw Error(ErrorKind::scene, fmt::format("{}: {}", name, why));
    }

    void checkSize(uint64_t width, uint64_t height) const {
        if (width == 0 || height == 0) fail(fmt::format("expected a picture, got {} x {} texels", width, height));
        if (std::max(width, height) > maxSide) {
            throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} texels a side, got {} x {}", name,
                                                      maxSide, width, height));
        }
        if (width * height * 4 > maxBytes) {
            throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} bytes decoded, got {} x {} x 4", name,
                                                      maxBytes, width, height));
        }
    }

    /// A header may claim any size: nothing is allocated for more texels than the data could hold at best.
    void checkPromise(uint64_t leastBytes) const {
        if (bytes.size() < leastBytes) {
            fail(fmt::format("expected at least {} bytes for the size it claims, got {}", leastBytes, bytes.size()));
        }
    }
};

bool startsWith(std::span<const std::byte> bytes, std::span<const uint8_t> signature) {
    return bytes.size() >= signature.size() &&
           std::equal(signature.begin(), signature.end(), bytes.begin(),
                      [](uint8_t expected, std::byte got) { return std::byte(expected) == got; });
}

Rgba8 decodePng(const Source& source) {
    const auto check = [&](int code) {
        if (code == SPNG_EMEM) throw std::bad_alloc();
        if (code != 0) source.fail(fmt::format("expected a PNG picture: {}", spng_strerror(code)));
    };
    const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context(spng_ctx_new(0), spng_ctx_free);
    if (!context) throw std::bad_alloc();
    const size_t longestChunk = std::min<size_t>(source.bytes.size(), 0x7fffffff);  // PNG's own limit
    check(spng_set_chunk_limits(context.get(), longestChunk, source.bytes.size()));
    check(spng_set_png_buffer(context.get(), source.bytes.data(), source.bytes.size()));
    spng_ihdr header{};
    check(spng_get_ihdr(context.get(), &header));
    source.checkSize(header.width, header.height);
    constexpr uint64_t kDeflateRatio = 1032;  // the most that zlib's deflate expands (zlib Technical Details)
    const uint64_t channels = header.color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA   ? 4
                              : header.color_type == SPNG_COLOR_TYPE_TRUECOLOR       ? 3
                              : header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA ? 2
                                                                                     : 1;
    source.checkPromise(header.height * (uint64_t(header.width) * channels * header.bit_depth / 8) / kDeflateRatio);

    Rgba8 image{header.width, header.height, {}};
    image.texels.resize(size_t(header.width) * header.height * 4);
    check(spng_decode_image(context.get(), image.texels.data(), image.texels.size(), SPNG_FMT_RGBA8, SPNG_DECODE_TRNS));
    return image;
}

Rgba8 decodeJpeg(const Source& source) {
    const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), tjDestroy);
    if (!decoder) throw std::bad_alloc();
    const auto refuse = [&] { source.fail(fmt::format("expected a JPEG picture: {}", tjGetErrorStr2(decoder.get()))); };
    const auto* data = reinterpret_cast<const unsigned char*>(source.bytes.data());
    int width = 0, height = 0, subsampling = 0, colorSpace = 0;
    if (tjDecompressHeader3(decoder.get(), data, source.bytes.size(), &width, &height, &subsampling, &colorSpace) != 0)
        refuse();
    source.checkSize(uint64_t(width), uint64_t(height));
    constexpr uint64_t kTexelsPerByte = 16ull * 16 * 8;  // a bit at least for each of the blocks, of 16 x 16 at most
    source.checkPromise(uint64_t(width) * uint64_t(height) / kTexelsPerByte);

    Rgba8 image{uint32_t(width), uint32_t(height), {}};
    image.texels.resize(size_t(width) * size_t(height) * 4);
    // Warnings (data cut off, corrupt segments) count as errors: a picture is read as it was meant or not at all. The
    // limit on scans stops small files that take minutes.
    if (tjDecompress2(decoder.get(), data, source.bytes.size(), image.texels.data(), width, 0, height, TJPF_RGBA,
                      TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS | TJFLAG_STOPONWARNING) != 0)
        refuse();
    return image;
}

}  // namespace

Rgba8 decodeImage(std::span<const std::byte> bytes, const std::string& nameForErrors, uint32_t maxSide,
                  uint64_t maxBytes) {
    constexpr std::array<uint8_t, 8> kPng{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    constexpr std::array<uint8_t, 3> kJpeg{0xff, 0xd8, 0xff};
    const Source source{bytes, nameForErrors, maxSide, maxBytes};
    if (startsWith(bytes, kPng)) return decodePng(source);
    if (startsWith(bytes, kJpeg)) return decodeJpeg(source);
    source.fail("expected a PNG or JPEG picture, got neither's signature");
}

}  // namespace luciole
