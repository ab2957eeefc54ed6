#include "gpu/resources.hpp"

#include <fmt/format.h>

#include <luciole/error.hpp>

#include <algorithm>

namespace luciole::gpu {

namespace {

/// What serves `residence` best, of what the device has: Vulkan guarantees host-visible coherent memory and device-local
/// memory, not their combinations.
vk::MemoryPropertyFlags propertiesOf(const Context& context, const vk::MemoryRequirements& requirements, Residence residence) {
    using Property = vk::MemoryPropertyFlagBits;
    if (residence == Residence::device) return Property::eDeviceLocal;
    const vk::MemoryPropertyFlags visible = Property::eHostVisible | Property::eHostCoherent;
    const auto better = visible | (residence == Residence::hostCached ? Property::eHostCached : Property::eDeviceLocal);
    return context.hasMemory(requirements, better) ? better : visible;
}

void addViews(const Context& context, const std::string& name, Image& image, vk::Image handle) {
    const auto viewOf = [&](vk::ImageAspectFlags aspects) {
        return vk::raii::ImageView(context.device(), {.image = handle,
                                                      .viewType = vk::ImageViewType::e2D,
                                                      .format = image.format,
                                                      .subresourceRange = {aspects, 0, image.mipLevels, 0, 1}});
    };
    image.view = viewOf(aspectOf(image.format));
    if (hasStencil(image.format)) image.depthView = viewOf(vk::ImageAspectFlagBits::eDepth);
    context.name(*image.view, name);
}

}  // namespace

Buffer makeBuffer(const Context& context, const std::string& name, uint64_t bytes, vk::BufferUsageFlags usage,
                  Residence residence) {
    bytes = std::max<uint64_t>(bytes, 16);
    if ((usage & vk::BufferUsageFlagBits::eStorageBuffer) && bytes > context.limits().maxStorageBufferRange)
        throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} bytes (the device's largest storage buffer), got {}",
                                                  name, context.limits().maxStorageBufferRange, bytes));
    if (bytes > context.maxBufferBytes())
        throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} bytes (the device's largest buffer), got {}", name,
                                                  context.maxBufferBytes(), bytes));
    Buffer buffer;
    buffer.bytes = bytes;
    buffer.handle = vk::raii::Buffer(context.device(), {.size = bytes, .usage = usage});
    const auto requirements = buffer.handle.getMemoryRequirements();
    buffer.memory = context.allocate(requirements, propertiesOf(context, requirements, residence));
    buffer.handle.bindMemory(*buffer.memory, 0);
    context.name(*buffer.handle, name);
    return buffer;
}

bool hasStencil(vk::Format format) { return format == vk::Format::eD32SfloatS8Uint; }

vk::ImageAspectFlags aspectOf(vk::Format format) {
    if (hasStencil(format)) return vk::ImageAspectFlagBits::eDepth | vk::ImageAspectFlagBits::eStencil;
    return format == vk::Format::eD32Sfloat ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
}

uint32_t bytesPerTexel(vk::Format format) {
    switch (format) {
        case vk::Format::eR8Unorm: return 1;
        case vk::Format::eR8G8Unorm:
        case vk::Format::eR16Unorm: return 2;
        case vk::Format::eD32Sfloat:
        case vk::Format::eR16G16Unorm:
        case vk::Format::eR8G8B8A8Unorm:
        case vk::Format::eR8G8B8A8Srgb: return 4;
        case vk::Format::eR16G16B16A16Unorm:
        case vk::Format::eR16G16B16A16Sfloat:
        case vk::Format::eD32SfloatS8Uint:  // as devices align it
        case vk::Format::eR32G32Sfloat: return 8;
        case vk::Format::eR32G32B32A32Sfloat: return 16;
        default: throw std::logic_error(fmt::format("bytesPerTexel: {} is not in the table", vk::to_string(format)));
    }
}

Image makeImage(const Context& context, const std::string& name, const ImageRequest& request) {
    const uint32_t limit = context.limits().maxImageDimension2D;
    if (request.extent.width > limit || request.extent.height > limit)
        throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} x {} texels (the device's limit), got {} x {}", name,
                                                  limit, limit, request.extent.width, request.extent.height));
    Image image;
    image.format = request.format;
    image.extent = request.extent;
    image.mipLevels = request.mipLevels;
    image.handle = vk::raii::Image(context.device(), {.imageType = vk::ImageType::e2D,
                                                      .format = request.format,
                                                      .extent = {request.extent.width, request.extent.height, 1},
                                                      .mipLevels = request.mipLevels,
                                                      .arrayLayers = 1,
                                                      .samples = request.samples,
                                                      .tiling = vk::ImageTiling::eOptimal,
                                                      .usage = request.usage});
    const auto requirements = image.handle.getMemoryRequirements();
    image.bytes = requirements.size;
    image.memory = context.allocate(requirements, vk::MemoryPropertyFlagBits::eDeviceLocal);
    try {
        image.handle.bindMemory(*image.memory, 0);
    } catch (const vk::OutOfDeviceMemoryError&) {  // where Mesa's software driver says that an image is too large
        throw Error(ErrorKind::limit, fmt::format("{}: expected an image that {} can hold, got {} x {} texels, {} bytes", name,
                                                  context.info().name, request.extent.width, request.extent.height, requirements.size));
    }
    addViews(context, name, image, *image.handle);
    context.name(*image.handle, name);
    return image;
}

Image viewImage(const Context& context, const std::string& name, vk::Image handle, vk::Format format) {
    Image image;
    image.format = format;
    addViews(context, name, image, handle);
    return image;
}

Buffer uploadBuffer(const Context& context, const std::string& name, std::span<const std::byte> data,
                    vk::BufferUsageFlags usage) {
    Buffer target = makeBuffer(context, name, data.size(), usage | vk::BufferUsageFlagBits::eTransferDst);
    MappedBuffer staging;
    updateBuffer(context, target, data, staging);
    return target;
}

void updateBuffer(const Context& context, const Buffer& target, std::span<const std::byte> data, MappedBuffer& staging) {
    if (data.empty()) return;
    if (data.size() > staging.bytes()) staging = MappedBuffer(context, "staging", data.size(), vk::BufferUsageFlagBits::eTransferSrc);
    staging.write(data);
    context.runOnce([&](const vk::raii::CommandBuffer& commands) {
        commands.copyBuffer(staging.handle(), *target.handle, vk::BufferCopy{.size = data.size()});
        const vk::MemoryBarrier2 visible{.srcStageMask = vk::PipelineStageFlagBits2::eTransfer,
                                         .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                         .dstStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                         .dstAccessMask = vk::AccessFlagBits2::eMemoryRead};
        commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &visible});
    });
}

bool Table::update(const Context& context, const std::string& name, std::span<const std::byte> data, uint64_t least) {
    const uint64_t bytes = std::max<uint64_t>(data.size(), least);
    const bool larger = bytes > buffer_.bytes;
    using Usage = vk::BufferUsageFlagBits;
    if (larger) buffer_ = makeBuffer(context, name, bytes, Usage::eStorageBuffer | Usage::eUniformBuffer | Usage::eTransferDst);
    if (!larger && std::ranges::equal(held_, data)) return false;
    updateBuffer(context, buffer_, data, staging_);
    held_.assign(data.begin(), data.end());
    return larger;
}

void transitionImage(const vk::raii::CommandBuffer& commands, const Image& image, vk::ImageLayout from, vk::ImageLayout to) {
    const vk::ImageMemoryBarrier2 barrier{.srcStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                          .srcAccessMask = vk::AccessFlagBits2::eMemoryWrite,
                                          .dstStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                          .dstAccessMask = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite,
                                          .oldLayout = from,
                                          .newLayout = to,
                                          .image = *image.handle,
                                          .subresourceRange = {aspectOf(image.format), 0, image.mipLevels, 0, 1}};
    commands.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
}

Image uploadImage(const Context& context, const std::string& name, vk::Format format, vk::Extent2D extent,
                  std::span<const std::span<const std::byte>> levels) {
    const auto levelCount = uint32_t(levels.size());
    Image image = makeImage(context, name, {.format = format,
                                            .extent = extent,
                                            .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst,
                                            .mipLevels = levelCount});
    uint64_t bytes = 0;
    for (const auto& level : levels) bytes += level.size();
    MappedBuffer staging(context, name + " staging", bytes, vk::BufferUsageFlagBits::eTransferSrc);
    std::vector<vk::BufferImageCopy> copies;
    uint64_t offset = 0;
    for (uint32_t level = 0; level < levelCount; ++level) {
        staging.write(levels[level], offset);
        copies.push_back({.bufferOffset = offset,
                          .imageSubresource = {vk::ImageAspectFlagBits::eColor, level, 0, 1},
                          .imageExtent = {std::max(1u, extent.width >> level), std::max(1u, extent.height >> level), 1}});
        offset += levels[level].size();
    }
    context.runOnce([&](const vk::raii::CommandBuffer& commands) {
        transitionImage(commands, image, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
        commands.copyBufferToImage(staging.handle(), *image.handle, vk::ImageLayout::eTransferDstOptimal, copies);
        transitionImage(commands, image, vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::eShaderReadOnlyOptimal);
    });
    return image;
}

}  // namespace luciole::gpu
