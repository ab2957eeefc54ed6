#pragma once
// The example's Vulkan: a device, images, buffers, barriers. Nothing here is of Luciole but the features that it wants enabled and, in
// Device::forLuciole, the handles that it is given.
#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>

#include <luciole/light_indexer.hpp>
#include <string>
#include <vector>

namespace host {

struct Device {
    vk::raii::Context loader;
    vk::raii::Instance instance = nullptr;
    vk::raii::DebugUtilsMessengerEXT messenger = nullptr;
    vk::raii::PhysicalDevice physical = nullptr;
    uint32_t queueFamily = 0;
    vk::raii::Device device = nullptr;
    vk::raii::Queue queue = nullptr;
    vk::raii::CommandPool commandPool = nullptr;

    /// \param messages of the validation layer; null: without it
    explicit Device(std::vector<std::string>* messages) {
        const vk::ApplicationInfo application{.apiVersion = VK_API_VERSION_1_3};
        const char* const layers[] = {"VK_LAYER_KHRONOS_validation"};
        const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
        const auto synchronization = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
        const vk::ValidationFeaturesEXT features{.enabledValidationFeatureCount = 1, .pEnabledValidationFeatures = &synchronization};
        vk::InstanceCreateInfo info{.pApplicationInfo = &application};
        if (messages) info.setPNext(&features).setPEnabledLayerNames(layers).setPEnabledExtensionNames(extensions);
        instance = vk::raii::Instance(loader, info);
        if (messages)
            messenger = vk::raii::DebugUtilsMessengerEXT(
                instance, {.messageSeverity = vk::DebugUtilsMessageSeverityFlagBitsEXT::eWarning | vk::DebugUtilsMessageSeverityFlagBitsEXT::eError,
                           .messageType = vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation,
                           .pfnUserCallback =
                               [](VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                  const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
                                   static_cast<std::vector<std::string>*>(user)->emplace_back(data->pMessage);
                                   return VK_FALSE;
                               },
                           .pUserData = messages});
        physical = std::move(vk::raii::PhysicalDevices(instance).front());
        const auto families = physical.getQueueFamilyProperties();
        const auto wanted = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
        while (queueFamily < families.size() && (families[queueFamily].queueFlags & wanted) != wanted) ++queueFamily;
        const float priority = 1;
        const vk::DeviceQueueCreateInfo queues{.queueFamilyIndex = queueFamily, .queueCount = 1, .pQueuePriorities = &priority};
        // This renderer's own features, dynamic rendering and synchronization2, are among those of LightIndexer.
        vk::PhysicalDeviceVulkan13Features v13;
        vk::PhysicalDeviceVulkan12Features v12{.pNext = &v13};
        vk::PhysicalDeviceFeatures v10;
        luciole::LightIndexer::enableFeatures(v10, v12, v13);
        device = vk::raii::Device(physical, {.pNext = &v12, .queueCreateInfoCount = 1, .pQueueCreateInfos = &queues, .pEnabledFeatures = &v10});
        queue = device.getQueue(queueFamily, 0);
        commandPool = vk::raii::CommandPool(device, {.queueFamilyIndex = queueFamily});
    }

    luciole::HostDevice forLuciole() const {
        return {*instance, *physical, *device, queueFamily, *queue, loader.getDispatcher()->vkGetInstanceProcAddr};
    }

    vk::raii::DeviceMemory allocate(const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags wanted) const {
        const auto memory = physical.getMemoryProperties();
        uint32_t type = 0;
        while ((requirements.memoryTypeBits >> type & 1) == 0 || (memory.memoryTypes[type].propertyFlags & wanted) != wanted) ++type;
        return {device, vk::MemoryAllocateInfo{.allocationSize = requirements.size, .memoryTypeIndex = type}};
    }
};

struct Image {
    vk::raii::Image handle;
    vk::raii::DeviceMemory memory;
    vk::raii::ImageView view;
};

inline Image makeImage(const Device& vulkan, vk::Format format, vk::Extent2D extent, vk::ImageUsageFlags usage, vk::ImageAspectFlags aspect) {
    vk::raii::Image handle(vulkan.device, {.imageType = vk::ImageType::e2D,
                                           .format = format,
                                           .extent = {extent.width, extent.height, 1},
                                           .mipLevels = 1,
                                           .arrayLayers = 1,
                                           .usage = usage});
    auto memory = vulkan.allocate(handle.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal);
    handle.bindMemory(*memory, 0);
    vk::raii::ImageView view(vulkan.device,
                             {.image = *handle, .viewType = vk::ImageViewType::e2D, .format = format, .subresourceRange = {aspect, 0, 1, 0, 1}});
    return {std::move(handle), std::move(memory), std::move(view)};
}

struct Buffer {
    vk::raii::Buffer handle;
    vk::raii::DeviceMemory memory;
    void* mapped;
};

inline Buffer makeBuffer(const Device& vulkan, uint64_t bytes, vk::BufferUsageFlags usage) {
    vk::raii::Buffer handle(vulkan.device, {.size = bytes, .usage = usage});
    auto memory =
        vulkan.allocate(handle.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent);
    handle.bindMemory(*memory, 0);
    void* const mapped = memory.mapMemory(0, VK_WHOLE_SIZE);
    return {std::move(handle), std::move(memory), mapped};
}

inline void transition(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageAspectFlags aspect, vk::ImageLayout from,
                       vk::ImageLayout to) {
    const vk::ImageMemoryBarrier2 barrier{.srcStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                          .srcAccessMask = vk::AccessFlagBits2::eMemoryWrite,
                                          .dstStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                          .dstAccessMask = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite,
                                          .oldLayout = from,
                                          .newLayout = to,
                                          .image = image,
                                          .subresourceRange = {aspect, 0, 1, 0, 1}};
    commands.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
}

}  // namespace host
