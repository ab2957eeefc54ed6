#include <fmt/format.h>
#include <spng.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <luciole/error.hpp>
#include <luciole/output.hpp>
#include <memory>
#include <new>
#include <string>

#include "io/file.hpp"
#include "io/image_codec.hpp"

namespace luciole {
namespace {

constexpr uint64_t kMaxPngBytes = 4ull << 30;
constexpr uint32_t kMaxPngSide = 16384;  ///< keeps a forged header from asking for all memory

template <typename Sample>
std::vector<std::byte> quantiseAndEncode(const Image& image) {
    constexpr float kMax = std::numeric_limits<Sample>::max();
    std::vector<Sample> samples(image.data.size());
    for (size_t i = 0; i < samples.size(); ++i) {
        const float value = image.data[i];
        // Written so that NaN fails the comparison and becomes 0.
        samples[i] = value > 0 ? Sample(std::lround(std::min(value, 1.0f) * kMax)) : Sample(0);
    }
    return encodePng(image.width, image.height, image.channels, std::span<const Sample>(samples));
}

}  // namespace

std::vector<std::byte> pngOf(const Image& image, int bits) {
    if (bits != 8 && bits != 16) throw Error(ErrorKind::usage, fmt::format("PNG: expected 8 or 16 bits, got {}", bits));
    return bits == 8 ? quantiseAndEncode<uint8_t>(image) : quantiseAndEncode<uint16_t>(image);
}

void writePng(const std::filesystem::path& file, const Image& image, int bits) { writeFileAtomically(file, pngOf(image, bits)); }

Image readPng(const std::filesystem::path& file) {
    const std::vector<std::byte> bytes = readFile(file, kMaxPngBytes);
    const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context(spng_ctx_new(0), spng_ctx_free);
    if (!context) throw std::bad_alloc();
    const auto check = [&](int code) {
        if (code == SPNG_EMEM) throw std::bad_alloc();
        if (code != 0)
            throw Error(ErrorKind::io, fmt::format("{}: can't read: {}", file.string(), spng_strerror(code)));
    };
    check(spng_set_image_limits(context.get(), kMaxPngSide, kMaxPngSide));
    check(spng_set_png_buffer(context.get(), bytes.data(), bytes.size()));
    spng_ihdr header{};
    check(spng_get_ihdr(context.get(), &header));
    spng_trns transparency{};
    const bool alpha = (header.color_type & 4) != 0 || spng_get_trns(context.get(), &transparency) == 0;

    // 16 bits hold all depths: n / 255 and 257 n / 65535 are the same number.
    std::vector<uint16_t> samples(size_t(header.width) * header.height * 4);
    check(spng_decode_image(context.get(), samples.data(), samples.size() * sizeof(uint16_t), SPNG_FMT_RGBA16,
                            SPNG_DECODE_TRNS));
    Image image(header.width, header.height, alpha ? 4 : 3);
    for (size_t i = 0; i < image.data.size(); ++i) {
        const size_t pixel = i / image.channels;
        image.data[i] = float(samples[4 * pixel + i % image.channels]) / 65535.0f;
    }
    return image;
}

}  // namespace luciole
