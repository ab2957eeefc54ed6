#include "io/image_codec.hpp"

#include <fmt/format.h>
#include <spng.h>

#include <cstdlib>
#include <luciole/error.hpp>
#include <memory>
#include <new>

namespace luciole {
namespace {

void check(int code) {
    if (code == SPNG_EMEM) throw std::bad_alloc();
    if (code != 0) throw Error(ErrorKind::usage, fmt::format("can't encode PNG: {}", spng_strerror(code)));
}

uint8_t colorType(uint32_t channels) {
    switch (channels) {
        case 1:
            return SPNG_COLOR_TYPE_GRAYSCALE;
        case 3:
            return SPNG_COLOR_TYPE_TRUECOLOR;
        case 4:
            return SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
        default:
            throw Error(ErrorKind::usage, fmt::format("PNG: expected 1, 3 or 4 channels, got {}", channels));
    }
}

template <typename Sample>
std::vector<std::byte> encode(uint32_t width, uint32_t height, uint32_t channels, std::span<const Sample> samples) {
    if (samples.size() != size_t(width) * height * channels)
        throw Error(ErrorKind::usage,
                    fmt::format("PNG: expected {} x {} x {} samples, got {}", width, height, channels, samples.size()));
    const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
    if (!context) throw std::bad_alloc();
    spng_ihdr header{width, height, uint8_t(8 * sizeof(Sample)), colorType(channels), 0, 0, SPNG_INTERLACE_NONE};
    check(spng_set_ihdr(context.get(), &header));
    check(spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1));
    check(spng_encode_image(context.get(), samples.data(), samples.size_bytes(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE));
    int code = 0;
    size_t size = 0;
    const std::unique_ptr<void, decltype(&std::free)> buffer(spng_get_png_buffer(context.get(), &size, &code),
                                                             std::free);
    check(code);
    const auto* begin = static_cast<const std::byte*>(buffer.get());
    return {begin, begin + size};
}

}  // namespace

std::vector<std::byte> encodePng(uint32_t width, uint32_t height, uint32_t channels, std::span<const uint8_t> samples) {
    return encode(width, height, channels, samples);
}

std::vector<std::byte> encodePng(uint32_t width, uint32_t height, uint32_t channels,
                                 std::span<const uint16_t> samples) {
    return encode(width, height, channels, samples);
}

}  // namespace luciole
