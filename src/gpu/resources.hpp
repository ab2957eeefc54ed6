#pragma once
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "gpu/context.hpp"

namespace luciole::gpu {

/// A buffer with its memory.
struct Buffer {
    vk::raii::Buffer handle = nullptr;
    Context::Allocation memory;
    uint64_t bytes = 0;
};

/// An image with its memory and a view of all of it. What has a stencil, has one more view of its depth alone, to sample.
struct Image {
    vk::raii::Image handle = nullptr;
    Context::Allocation memory;
    vk::raii::ImageView view = nullptr;
    vk::raii::ImageView depthView = nullptr;
    vk::Format format = vk::Format::eUndefined;
    vk::Extent2D extent;
    uint32_t mipLevels = 1;
    uint64_t bytes = 0;
};

/// Memory that is best for the device, that the host writes (and the device reads), or that the host reads.
enum class Residence { device, hostVisible, hostCached };

/// \throws Error(limit) for a buffer beyond the device's limits; an empty request gives the smallest buffer, since
/// Vulkan has no empty ones
Buffer makeBuffer(const Context& context, const std::string& name, uint64_t bytes, vk::BufferUsageFlags usage,
                  Residence residence = Residence::device);

struct ImageRequest {
    vk::Format format;
    vk::Extent2D extent;
    vk::ImageUsageFlags usage;
    uint32_t mipLevels = 1;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
};
Image makeImage(const Context& context, const std::string& name, const ImageRequest& request);

/// Somebody else's image of one level: views of it, and neither its handle nor its memory.
Image viewImage(const Context& context, const std::string& name, vk::Image handle, vk::Format format);

bool hasStencil(vk::Format format);
vk::ImageAspectFlags aspectOf(vk::Format format);
uint32_t bytesPerTexel(vk::Format format);

/// A host-visible buffer whose content is replaced from the host between frames.
class MappedBuffer {
public:
    MappedBuffer() = default;
    MappedBuffer(const Context& context, const std::string& name, uint64_t bytes, vk::BufferUsageFlags usage,
                 Residence residence = Residence::hostVisible)
        : buffer_(makeBuffer(context, name, bytes, usage, residence)), mapped_(buffer_.memory.map()) {}
    template <typename T>
    void write(std::span<const T> values, uint64_t offset = 0) {
        std::memcpy(static_cast<char*>(mapped_) + offset, values.data(), values.size_bytes());
    }
    template <typename T>
    std::span<const T> read() const { return {static_cast<const T*>(mapped_), buffer_.bytes / sizeof(T)}; }
    vk::Buffer handle() const { return *buffer_.handle; }
    uint64_t bytes() const { return buffer_.bytes; }

private:
    Buffer buffer_;
    void* mapped_ = nullptr;
};

/// A device buffer that holds `data`.
Buffer uploadBuffer(const Context& context, const std::string& name, std::span<const std::byte> data,
                    vk::BufferUsageFlags usage);
template <typename T>
Buffer uploadBuffer(const Context& context, const std::string& name, const std::vector<T>& data, vk::BufferUsageFlags usage) {
    return uploadBuffer(context, name, std::as_bytes(std::span(data)), usage);
}

/// Puts `data` at the beginning of a buffer by way of `staging`, which is made larger if need be, and waits. No frame may be on its way.
void updateBuffer(const Context& context, const Buffer& target, std::span<const std::byte> data, MappedBuffer& staging);

/// A table in the device's memory that shaders read, as storage or uniform buffer, and that the host replaces between frames.
class Table {
public:
    /// Waits, but for data that is there already. No frame may be on its way. \param least bytes of the buffer \return whether it is another buffer
    bool update(const Context& context, const std::string& name, std::span<const std::byte> data, uint64_t least);
    vk::Buffer handle() const { return *buffer_.handle; }

private:
    Buffer buffer_;
    MappedBuffer staging_;
    std::vector<std::byte> held_;
};

/// Takes a whole image to another layout, once: waits for everything before, and all that comes after waits.
void transitionImage(const vk::raii::CommandBuffer& commands, const Image& image, vk::ImageLayout from, vk::ImageLayout to);

/// A sampled image in the layout that shaders read. `levels[i]` holds the texels of mip level i, tightly packed.
Image uploadImage(const Context& context, const std::string& name, vk::Format format, vk::Extent2D extent,
                  std::span<const std::span<const std::byte>> levels);

}  // namespace luciole::gpu
