#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <luciole/error.hpp>
#include <luciole/output.hpp>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/file.hpp"

namespace luciole {
namespace {

constexpr uint64_t kMaxExrBytes = 16ull << 30;
constexpr int64_t kMaxExrSide = 16384;  ///< keeps a forged header from asking for all memory

/// OpenEXR seeks back to fill in its offset table.
class MemoryOutput : public Imf::OStream {
public:
    MemoryOutput() : OStream("memory") {}
    void write(const char data[], int size) override {
        const auto end = position_ + size_t(size);
        if (end > bytes_.size()) bytes_.resize(end);
        std::memcpy(bytes_.data() + position_, data, size_t(size));
        position_ = end;
    }
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = position; }
    std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
    size_t position_ = 0;
};

class MemoryInput : public Imf::IStream {
public:
    explicit MemoryInput(std::span<const std::byte> bytes) : IStream("memory"), bytes_(bytes) {}
    bool read(char data[], int size) override {
        if (position_ > bytes_.size() || size_t(size) > bytes_.size() - position_)
            throw std::runtime_error("the file ends too early");
        std::memcpy(data, bytes_.data() + position_, size_t(size));
        position_ += size_t(size);
        return position_ < bytes_.size();
    }
    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override { position_ = position; }

private:
    std::span<const std::byte> bytes_;
    size_t position_ = 0;
};

/// Channel names by count, in the order in which an Image holds them.
std::string_view channelLetters(size_t channels) {
    switch (channels) {
        case 1:
            return "Y";
        case 3:
            return "RGB";
        case 4:
            return "RGBA";
        default:
            return "";
    }
}

std::string channelName(const std::string& layer, char letter) {
    return layer.empty() ? std::string(1, letter) : fmt::format("{}.{}", layer, letter);
}

/// Layers whose numbers half can't hold exactly.
bool alwaysFloat(std::string_view layer) {
    constexpr std::array kNames{
        "depth", "material", "id", "light-count", "evaluations", "useful-evaluations", "light-fingerprint", "list-length", "list-slice"};
    return std::find(kNames.begin(), kNames.end(), layer) != kNames.end();
}

/// A finite value beyond half's range becomes its largest one: an infinite highlight would spread in any filter.
std::vector<half> toHalf(const std::vector<float>& values) {
    std::vector<half> result(values.size());
    std::transform(values.begin(), values.end(), result.begin(), [](float value) {
        return half(std::isfinite(value) ? std::clamp(value, -float(HALF_MAX), float(HALF_MAX)) : value);
    });
    return result;
}

void requireLayers(const std::map<std::string, Image>& layers) {
    if (layers.empty()) throw Error(ErrorKind::usage, "EXR: expected at least one layer, got none");
    const Image& first = layers.begin()->second;
    for (const auto& [name, image] : layers) {
        if (channelLetters(image.channels).empty())
            throw Error(ErrorKind::usage,
                        fmt::format("EXR layer \"{}\": expected 1, 3 or 4 channels, got {}", name, image.channels));
        if (image.width != first.width || image.height != first.height || image.data.empty())
            throw Error(ErrorKind::usage, fmt::format("EXR layer \"{}\": expected {} x {} pixels, got {} x {}", name,
                                                      first.width, first.height, image.width, image.height));
    }
}

/// Where OpenEXR finds or puts one channel of interleaved samples. \param x, y coordinates of the first pixel
template <typename Sample>
Imf::Slice slice(Imf::PixelType type, const Sample* data, size_t channels, size_t channel, size_t width, int64_t x = 0,
                 int64_t y = 0) {
    const size_t pixelBytes = sizeof(Sample) * channels;
    // OpenEXR wants the address that pixel (0, 0) would have, which may lie outside the buffer: no pointer arithmetic.
    const auto base = reinterpret_cast<uintptr_t>(data + channel) - uintptr_t((y * int64_t(width) + x) * pixelBytes);
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    return {type, reinterpret_cast<char*>(base), pixelBytes, pixelBytes * width};
}

std::map<std::string, Image> decodeExr(std::span<const std::byte> bytes) {
    MemoryInput stream(bytes);
    Imf::InputFile file(stream);
    const Imath::Box2i window = file.header().dataWindow();
    const int64_t width = int64_t(window.max.x) - window.min.x + 1;
    const int64_t height = int64_t(window.max.y) - window.min.y + 1;
    if (width < 1 || height < 1 || width > kMaxExrSide || height > kMaxExrSide)
        throw std::runtime_error(
            fmt::format("expected 1 to {} pixels a side, got {} x {}", kMaxExrSide, width, height));

    std::map<std::string, std::string> lettersOfLayer;
    const Imf::ChannelList& list = file.header().channels();
    for (auto channel = list.begin(); channel != list.end(); ++channel) {
        const std::string name = channel.name();
        const size_t dot = name.rfind('.');
        const std::string layer = dot == std::string::npos ? "" : name.substr(0, dot);
        const std::string letter = dot == std::string::npos ? name : name.substr(dot + 1);
        if (letter.size() != 1 || channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            throw std::runtime_error(fmt::format("channel {}: expected R, G, B, A or Y of full size", name));
        lettersOfLayer[layer] += letter;
    }

    std::map<std::string, Image> layers;
    Imf::FrameBuffer frame;
    for (auto& [layer, found] : lettersOfLayer) {
        const std::string_view letters = channelLetters(found.size());
        if (!std::is_permutation(letters.begin(), letters.end(), found.begin(), found.end()))
            throw std::runtime_error(fmt::format("layer \"{}\": expected channels Y, RGB or RGBA", layer));
        Image& image = layers[layer] = Image(uint32_t(width), uint32_t(height), uint32_t(letters.size()));
        for (size_t i = 0; i < letters.size(); ++i)
            frame.insert(channelName(layer, letters[i]), slice(Imf::FLOAT, image.data.data(), letters.size(), i,
                                                               size_t(width), window.min.x, window.min.y));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    return layers;
}

}  // namespace

void writeExr(const std::filesystem::path& file, const std::map<std::string, Image>& layers, ExrType type) {
    requireLayers(layers);
    const Image& first = layers.begin()->second;
    Imf::Header header(int(first.width), int(first.height));
    header.compression() = Imf::ZIP_COMPRESSION;

    Imf::FrameBuffer frame;
    std::map<std::string, std::vector<half>> halves;
    for (const auto& [name, image] : layers) {
        const std::string_view letters = channelLetters(image.channels);
        const bool asHalf = type == ExrType::half && !alwaysFloat(name);
        if (asHalf) halves[name] = toHalf(image.data);
        for (size_t i = 0; i < letters.size(); ++i) {
            const std::string channel = channelName(name, letters[i]);
            header.channels().insert(channel, Imf::Channel(asHalf ? Imf::HALF : Imf::FLOAT));
            frame.insert(channel, asHalf ? slice(Imf::HALF, halves[name].data(), letters.size(), i, image.width)
                                         : slice(Imf::FLOAT, image.data.data(), letters.size(), i, image.width));
        }
    }

    MemoryOutput stream;
    {
        Imf::OutputFile output(stream, header);
        output.setFrameBuffer(frame);
        output.writePixels(int(first.height));
    }
    writeFileAtomically(file, stream.bytes());
}

std::map<std::string, Image> readExr(const std::filesystem::path& file) {
    const std::vector<std::byte> bytes = readFile(file, kMaxExrBytes);
    try {
        return decodeExr(bytes);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(ErrorKind::io, fmt::format("{}: can't read: {}", file.string(), error.what()));
    }
}

}  // namespace luciole
