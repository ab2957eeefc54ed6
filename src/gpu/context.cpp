#include "gpu/context.hpp"

#include <luciole/error.hpp>
#include <luciole/light_indexer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <memory>
#include <mutex>

#include "gpu/bindings.shared.h"

namespace luciole::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

vk::raii::Context makeLoader() {
    try {
        return vk::raii::Context();
    } catch (const std::exception& error) {
        throw Error(ErrorKind::device, fmt::format("device: expected the Vulkan loader (libvulkan), found none ({})", error.what()));
    }
}

/// An instance of Vulkan 1.3.
struct InstanceParts {
    vk::raii::Instance instance = nullptr;
    bool labels = false;
};

InstanceParts makeInstance(const vk::raii::Context& loader, bool validation) {
    const vk::ApplicationInfo application{
        .pApplicationName = "luciole", .pEngineName = "luciole", .apiVersion = VK_API_VERSION_1_3};
    std::vector<const char*> layers, extensions;
    const auto available = loader.enumerateInstanceExtensionProperties();
    const bool labels = std::ranges::any_of(available, [](const auto& extension) {
        return std::strcmp(extension.extensionName, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) == 0;
    });
    if (labels) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

    const vk::ValidationFeatureEnableEXT synchronization = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
    const vk::ValidationFeaturesEXT features{.enabledValidationFeatureCount = 1,
                                             .pEnabledValidationFeatures = &synchronization};
    vk::InstanceCreateInfo info{.pApplicationInfo = &application};
    if (validation) {
        const auto known = loader.enumerateInstanceLayerProperties();
        if (std::ranges::none_of(known, [](const auto& layer) { return std::strcmp(layer.layerName, kValidationLayer) == 0; }))
            throw Error(ErrorKind::device,
                        fmt::format("validation: expected the layer {}, found none (Debian: vulkan-validationlayers)",
                                    kValidationLayer));
        layers.push_back(kValidationLayer);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);  // the layer's own
        info.pNext = &features;
    }
    info.enabledLayerCount = uint32_t(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = uint32_t(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    return {vk::raii::Instance(loader, info), labels};
}

VKAPI_ATTR VkBool32 VKAPI_CALL forwardMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto& onMessage = *static_cast<std::function<void(std::string_view)>*>(user);
    try {
        if (onMessage && data->pMessage) onMessage(data->pMessage);
    } catch (...) {  // must not unwind through the driver
    }
    return VK_FALSE;
}

std::optional<uint32_t> graphicsQueueFamily(const vk::raii::PhysicalDevice& device) {
    const auto families = device.getQueueFamilyProperties();
    for (uint32_t i = 0; i < families.size(); ++i) {
        const auto wanted = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
        if ((families[i].queueFlags & wanted) == wanted) return i;
    }
    return std::nullopt;
}

std::string whyUnusable(const vk::raii::PhysicalDevice& device) {
    const auto properties = device.getProperties();
    if (properties.apiVersion < VK_API_VERSION_1_3)
        return fmt::format("expected Vulkan 1.3, found {}.{}", VK_API_VERSION_MAJOR(properties.apiVersion),
                           VK_API_VERSION_MINOR(properties.apiVersion));
    const auto chain = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                                           vk::PhysicalDeviceVulkan13Features>();
    const auto& v12 = chain.get<vk::PhysicalDeviceVulkan12Features>();
    const auto& v13 = chain.get<vk::PhysicalDeviceVulkan13Features>();
    if (!device.getFeatures().depthClamp) return "lacks the feature depthClamp";
    if (!device.getFeatures().independentBlend) return "lacks the feature independentBlend";
    if (!device.getFeatures().fragmentStoresAndAtomics) return "lacks the feature fragmentStoresAndAtomics";
    if (!v12.scalarBlockLayout) return "lacks the feature scalarBlockLayout";
    if (!v13.dynamicRendering) return "lacks the feature dynamicRendering";
    if (!v12.separateDepthStencilLayouts) return "lacks the feature separateDepthStencilLayouts";
    if (!v13.shaderTerminateInvocation) return "lacks the feature shaderTerminateInvocation";
    // The size of workgroups may be a constant's; Vulkan 1.3 asks of devices that they have it.
    if (!v13.maintenance4) return "lacks the feature maintenance4";
    if (!v13.synchronization2) return "lacks the feature synchronization2";
    if (!graphicsQueueFamily(device)) return "has no queue for graphics and compute";
    // Those of bindings.shared.h; of the least that Vulkan guarantees, 4 and 16, no desktop driver is known.
    constexpr uint32_t kStorage = shared::kFrameStorageCount + shared::kPassStorageCount;
    constexpr uint32_t kSampled = shared::kFrameSampledCount + shared::kPassSampledCount + shared::kMaterialTextures;
    if (properties.limits.maxPerStageDescriptorStorageBuffers < kStorage)
        return fmt::format("expected {} storage buffers a stage, found {}", kStorage, properties.limits.maxPerStageDescriptorStorageBuffers);
    if (properties.limits.maxPerStageDescriptorSampledImages < kSampled || properties.limits.maxPerStageDescriptorSamplers < kSampled)
        return fmt::format("expected {} sampled images and samplers a stage, found {} and {}", kSampled,
                           properties.limits.maxPerStageDescriptorSampledImages, properties.limits.maxPerStageDescriptorSamplers);
    if (properties.limits.maxImageDimension2D < 8192)
        return fmt::format("expected images of 8192 texels, found {}", properties.limits.maxImageDimension2D);
    const auto blendable = vk::FormatFeatureFlagBits::eColorAttachmentBlend;
    for (const auto format : {vk::Format::eR32G32B32A32Sfloat, vk::Format::eR16G16B16A16Sfloat})
        if (!(device.getFormatProperties(format).optimalTilingFeatures & blendable))
            return fmt::format("can't blend into {}", vk::to_string(format));
    const auto depthFeatures = vk::FormatFeatureFlagBits::eDepthStencilAttachment | vk::FormatFeatureFlagBits::eSampledImage;
    if ((device.getFormatProperties(vk::Format::eD32SfloatS8Uint).optimalTilingFeatures & depthFeatures) != depthFeatures)
        return "can't render into and sample D32SfloatS8Uint";
    const auto color = vk::FormatFeatureFlagBits::eColorAttachment;
    for (const auto format : {vk::Format::eR16G16B16A16Unorm, vk::Format::eR16Unorm})
        if (!(device.getFormatProperties(format).optimalTilingFeatures & color))
            return fmt::format("can't render into {}", vk::to_string(format));
    return {};
}

DeviceInfo describe(const vk::raii::PhysicalDevice& device) {
    const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    DeviceInfo info;
    info.name = properties.deviceName.data();
    info.driver = fmt::format("{} {}", driver.driverName.data(), driver.driverInfo.data());
    info.apiVersion = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(properties.apiVersion),
                                  VK_API_VERSION_MINOR(properties.apiVersion), VK_API_VERSION_PATCH(properties.apiVersion));
    info.software = properties.deviceType == vk::PhysicalDeviceType::eCpu;
    info.whyUnusable = whyUnusable(device);
    info.usable = info.whyUnusable.empty();
    return info;
}

/// Lower is better: real GPUs before the software driver.
int rank(const vk::raii::PhysicalDevice& device) {
    switch (device.getProperties().deviceType) {
        case vk::PhysicalDeviceType::eDiscreteGpu: return 0;
        case vk::PhysicalDeviceType::eIntegratedGpu: return 1;
        case vk::PhysicalDeviceType::eVirtualGpu: return 2;
        default: return 3;
    }
}

bool matches(const std::string& wanted, size_t index, const DeviceInfo& info) {
    size_t number = 0;
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
    if (error == std::errc() && end == wanted.data() + wanted.size()) return number == index;
    return info.name.find(wanted) != std::string::npos;
}

vk::raii::PhysicalDevice pick(const vk::raii::Instance& instance, const std::string& wanted, DeviceInfo& chosen) {
    const auto devices = instance.enumeratePhysicalDevices();
    std::string found;
    std::optional<size_t> best;
    for (size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo info = describe(devices[i]);
        found += fmt::format("\n  {}: {} ({}){}", i, info.name, info.driver, info.usable ? "" : ": " + info.whyUnusable);
        if (!info.usable || (!wanted.empty() && !matches(wanted, i, info))) continue;
        if (!best || rank(devices[i]) < rank(devices[*best])) best = i, chosen = info;
    }
    if (!best)
        throw Error(ErrorKind::device,
                    fmt::format("device: expected a usable Vulkan 1.3 device{}, found {}",
                                wanted.empty() ? "" : fmt::format(" matching \"{}\"", wanted),
                                found.empty() ? "none (Debian's software driver: mesa-vulkan-drivers)" : found));
    return devices[*best];
}

bool hasFeedbackLoops(const vk::raii::PhysicalDevice& physical) {
    const auto extensions = physical.enumerateDeviceExtensionProperties();
    if (std::ranges::none_of(extensions, [](const auto& extension) { return std::strcmp(extension.extensionName, VK_EXT_ATTACHMENT_FEEDBACK_LOOP_LAYOUT_EXTENSION_NAME) == 0; }))
        return false;
    return physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceAttachmentFeedbackLoopLayoutFeaturesEXT>()
        .get<vk::PhysicalDeviceAttachmentFeedbackLoopLayoutFeaturesEXT>()
        .attachmentFeedbackLoopLayout;
}

/// A loader that finds its functions where the host of a foreign device does.
vk::raii::Context loaderOf(const HostDevice& host) {
    vk::raii::Context loader = makeLoader();
    // vk::raii (1.3.239) looks for a libvulkan of its own and has no other constructor; what it found is not called before this.
    const_cast<vk::raii::ContextDispatcher*>(loader.getDispatcher())->vkGetInstanceProcAddr = host.getInstanceProcAddr;
    return loader;
}

vk::raii::Device makeDevice(const vk::raii::PhysicalDevice& physical, uint32_t queueFamily) {
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue{.queueFamilyIndex = queueFamily, .queueCount = 1, .pQueuePriorities = &priority};
    vk::PhysicalDeviceVulkan13Features v13;
    vk::PhysicalDeviceVulkan12Features v12{.pNext = &v13};
    const vk::PhysicalDeviceFeatures has = physical.getFeatures();
    vk::PhysicalDeviceFeatures features{.fullDrawIndexUint32 = has.fullDrawIndexUint32, .sampleRateShading = has.sampleRateShading, .largePoints = has.largePoints};
    enableFeatures(features, v12, v13);
    vk::PhysicalDeviceAttachmentFeedbackLoopLayoutFeaturesEXT feedback{.pNext = &v12, .attachmentFeedbackLoopLayout = true};
    const bool feeds = hasFeedbackLoops(physical);
    const char* extension = VK_EXT_ATTACHMENT_FEEDBACK_LOOP_LAYOUT_EXTENSION_NAME;
    const vk::DeviceCreateInfo info{.pNext = feeds ? static_cast<const void*>(&feedback) : &v12,
                                    .queueCreateInfoCount = 1,
                                    .pQueueCreateInfos = &queue,
                                    .enabledExtensionCount = feeds ? 1u : 0u,
                                    .ppEnabledExtensionNames = &extension,
                                    .pEnabledFeatures = &features};
    return vk::raii::Device(physical, info);
}

/// Keeps the instance until the next comes, and the last one for good: with its last instance a driver is unloaded, and NVIDIA's (580) can't
/// be loaded more than some 60 times in one process.
void keepDriverLoaded(vk::raii::Context&& loader, vk::raii::Instance&& instance) {
    struct Kept {
        vk::raii::Context loader;
        vk::raii::Instance instance;
    };
    static std::mutex mutex;
    static std::unique_ptr<Kept>& kept = *new std::unique_ptr<Kept>;  // outlives every Context, static ones included
    const std::scoped_lock lock(mutex);
    kept = std::make_unique<Kept>(std::move(loader), std::move(instance));
}

}  // namespace

void enableFeatures(VkPhysicalDeviceFeatures& v10, VkPhysicalDeviceVulkan12Features& v12, VkPhysicalDeviceVulkan13Features& v13) {
    v10.independentBlend = v10.depthClamp = v10.fragmentStoresAndAtomics = true;
    v12.scalarBlockLayout = v12.separateDepthStencilLayouts = true;
    v13.shaderTerminateInvocation = v13.synchronization2 = v13.dynamicRendering = v13.maintenance4 = true;
}

Context::Context(const RendererOptions& options) : loader_(makeLoader()), onMessage_(options.onMessage) {
    try {
        InstanceParts parts = makeInstance(loader_, options.validation);
        instance_ = std::move(parts.instance);
        labels_ = parts.labels;
    } catch (const vk::SystemError& error) {
        throw Error(ErrorKind::device, fmt::format("device: expected a Vulkan driver, found none ({})", error.what()));
    }
    if (options.validation && labels_) {
        using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
        messenger_ = vk::raii::DebugUtilsMessengerEXT(
            instance_, {.messageSeverity = Severity::eWarning | Severity::eError,
                        .messageType = vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation,
                        .pfnUserCallback = forwardMessage,
                        .pUserData = &onMessage_});
    }
    physical_ = pick(instance_, options.device, info_);
    const uint32_t queueFamily = *graphicsQueueFamily(physical_);
    device_ = makeDevice(physical_, queueFamily);
    useQueue(device_.getQueue(queueFamily, 0), queueFamily);
}

Context::Context(const HostDevice& host) : Context(loaderOf(host)) {
    borrowed_ = true;
    instance_ = vk::raii::Instance(loader_, host.instance);
    labels_ = instance_.getDispatcher()->vkCreateDebugUtilsMessengerEXT != nullptr;
    physical_ = vk::raii::PhysicalDevice(instance_, host.physicalDevice);
    info_ = describe(physical_);
    const auto families = physical_.getQueueFamilyProperties();
    const auto wanted = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
    if (info_.usable && (host.queueFamily >= families.size() || (families[host.queueFamily].queueFlags & wanted) != wanted))
        info_.whyUnusable = fmt::format("queue family {}: expected graphics and compute", host.queueFamily);
    if (!info_.whyUnusable.empty())
        throw Error(ErrorKind::device, fmt::format("device: expected a usable Vulkan 1.3 device, found {} ({}): {}", info_.name, info_.driver, info_.whyUnusable));
    device_ = vk::raii::Device(physical_, host.device);
    useQueue(vk::raii::Queue(device_, host.queue), host.queueFamily);
}

Context::~Context() {
    commandPool_ = nullptr;  // while the device is still known
    if (!borrowed_) {
        device_ = nullptr;  // while the instance is
        messenger_ = nullptr;
        keepDriverLoaded(std::move(loader_), std::move(instance_));
        return;
    }
    (void)device_.release();
    (void)instance_.release();
}

void Context::useQueue(vk::raii::Queue queue, uint32_t queueFamily) {
    queue_ = std::move(queue);
    commandPool_ = vk::raii::CommandPool(
        device_, {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = queueFamily});
    memory_ = physical_.getMemoryProperties();
    limits_ = physical_.getProperties().limits;
    const vk::PhysicalDeviceFeatures features = physical_.getFeatures();
    feedbackLoops_ = !borrowed_ && hasFeedbackLoops(physical_);  // no host is asked to enable the extension
    if (!borrowed_ && features.largePoints) largestPoint_ = limits_.pointSizeRange[1];
    sampleCounts_ = vk::SampleCountFlagBits::e1;
    if (features.sampleRateShading && limits_.standardSampleLocations)
        sampleCounts_ |= limits_.framebufferColorSampleCounts & limits_.framebufferDepthSampleCounts &
                         limits_.framebufferStencilSampleCounts & limits_.sampledImageColorSampleCounts &
                         limits_.sampledImageDepthSampleCounts;
    maxBufferBytes_ = physical_.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan13Properties>()
                          .get<vk::PhysicalDeviceVulkan13Properties>()
                          .maxBufferSize;
    const uint32_t timestampBits = physical_.getQueueFamilyProperties()[queueFamily].timestampValidBits;
    timestampMask_ = timestampBits >= 64 ? ~0ull : (1ull << timestampBits) - 1;
}

Context::Allocation& Context::Allocation::operator=(Allocation&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(memory_, other.memory_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

Context::Allocation::~Allocation() {
    if (context_) context_->allocatedBytes_ -= bytes_;
}

bool Context::hasMemory(const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags wanted) const {
    for (uint32_t type = 0; type < memory_.memoryTypeCount; ++type)
        if ((requirements.memoryTypeBits >> type & 1) != 0 && (memory_.memoryTypes[type].propertyFlags & wanted) == wanted) return true;
    return false;
}

Context::Allocation Context::allocate(const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags wanted) const {
    for (uint32_t type = 0; type < memory_.memoryTypeCount; ++type) {
        const bool allowed = requirements.memoryTypeBits & (1u << type);
        if (!allowed || (memory_.memoryTypes[type].propertyFlags & wanted) != wanted) continue;
        try {
            vk::raii::DeviceMemory memory(device_, {.allocationSize = requirements.size, .memoryTypeIndex = type});
            allocatedBytes_ += requirements.size;
            peakBytes_ = std::max(peakBytes_, allocatedBytes_);
            return Allocation(*this, std::move(memory), requirements.size);
        } catch (const vk::OutOfDeviceMemoryError&) {  // another type may have room
        } catch (const vk::OutOfHostMemoryError&) {
        } catch (const vk::TooManyObjectsError&) {
            throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} allocations of device memory", info_.name,
                                                      limits_.maxMemoryAllocationCount));
        }
    }
    throw Error(ErrorKind::deviceLost, fmt::format("{}: out of device memory: {} bytes more wanted, {} in use", info_.name,
                                                   requirements.size, allocatedBytes_));
}

void Context::submitAndWait(const vk::raii::CommandBuffer& commands) const {
    const vk::raii::Fence fence(device_, vk::FenceCreateInfo{});
    const vk::CommandBufferSubmitInfo buffer{.commandBuffer = *commands};
    queue_.submit2(vk::SubmitInfo2{.commandBufferInfoCount = 1, .pCommandBufferInfos = &buffer}, *fence);
    // A frame may take minutes on a software driver; a device that hangs is reported lost by its own driver.
    (void)device_.waitForFences(*fence, true, std::numeric_limits<uint64_t>::max());
}

void Context::runOnce(const std::function<void(const vk::raii::CommandBuffer&)>& record) const {
    const auto buffers =
        vk::raii::CommandBuffers(device_, {.commandPool = *commandPool_, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1});
    const auto& commands = buffers.front();
    commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record(commands);
    commands.end();
    submitAndWait(commands);
}

}  // namespace luciole::gpu

namespace luciole {

std::vector<DeviceInfo> listDevices() {
    std::vector<DeviceInfo> infos;
    try {
        const vk::raii::Context loader;
        const auto parts = gpu::makeInstance(loader, false);
        for (const auto& device : parts.instance.enumeratePhysicalDevices()) infos.push_back(gpu::describe(device));
    } catch (const std::exception&) {
        // no loader or no driver: no devices
    }
    return infos;
}

}  // namespace luciole
