#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <luciole/renderer.hpp>

#include "gpu/vulkan.hpp"

namespace luciole {
struct HostDevice;
}

namespace luciole::gpu {

/// Sets the features without which no pass runs, in what a device is made from.
void enableFeatures(VkPhysicalDeviceFeatures& v10, VkPhysicalDeviceVulkan12Features& v12, VkPhysicalDeviceVulkan13Features& v13);

/// Instance, device and its one queue, plus an account of the device memory in use. Comes up without a window.
class Context {
public:
    /// \throws Error(device) naming each device and why it can't be used
    explicit Context(const RendererOptions& options);
    /// Works on somebody else's device, which lives on. \throws Error(device) naming what it lacks
    explicit Context(const HostDevice& host);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const DeviceInfo& info() const { return info_; }
    const vk::PhysicalDeviceLimits& limits() const { return limits_; }
    const vk::raii::Device& device() const { return device_; }
    const vk::raii::Queue& queue() const { return queue_; }
    const vk::raii::CommandPool& commandPool() const { return commandPool_; }
    bool labels() const { return labels_; }
    bool feedbackLoops() const { return feedbackLoops_; }  ///< a pass may sample the colour attachment that it writes
    float largestPoint() const { return largestPoint_; }  ///< pixels; 1 where points have no size
    /// Values that a vertex shader can pass on to a fragment shader, the position included.
    uint32_t passedOn() const { return std::min(limits_.maxVertexOutputComponents, limits_.maxFragmentInputComponents + 4); }
    vk::SampleCountFlags sampleCounts() const { return sampleCounts_; }  ///< of colour and depth, with shading by sample
    vk::FormatProperties formatProperties(vk::Format format) const { return physical_.getFormatProperties(format); }
    uint64_t maxBufferBytes() const { return maxBufferBytes_; }
    uint64_t timestampMask() const { return timestampMask_; }  ///< valid bits of a timestamp; 0: the queue has none

    /// Allocates memory for `requirements` with at least `wanted`; counts it until the Allocation dies.
    /// \throws Error(deviceLost) if the device has no such memory left
    class Allocation {
    public:
        Allocation() = default;
        Allocation(const Context& context, vk::raii::DeviceMemory memory, uint64_t bytes)
            : context_(&context), memory_(std::move(memory)), bytes_(bytes) {}
        Allocation(Allocation&& other) noexcept { *this = std::move(other); }
        Allocation& operator=(Allocation&& other) noexcept;
        ~Allocation();
        vk::DeviceMemory operator*() const { return *memory_; }
        void* map() const { return memory_.mapMemory(0, VK_WHOLE_SIZE); }

    private:
        const Context* context_ = nullptr;
        vk::raii::DeviceMemory memory_ = nullptr;
        uint64_t bytes_ = 0;
    };
    Allocation allocate(const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags wanted) const;
    /// Whether the device has such memory at all.
    bool hasMemory(const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags wanted) const;

    uint64_t allocatedBytes() const { return allocatedBytes_; }
    uint64_t peakBytes() const { return peakBytes_; }
    void resetPeak() const { peakBytes_ = allocatedBytes_; }

    /// Gives a Vulkan object the name that validation messages and debuggers show.
    template <typename Handle>
    void name(Handle handle, const std::string& name) const {
        if (!labels_) return;
        device_.setDebugUtilsObjectNameEXT({.objectType = Handle::objectType,
                                            .objectHandle = reinterpret_cast<uint64_t>(static_cast<typename Handle::CType>(handle)),
                                            .pObjectName = name.c_str()});
    }

    /// Records with `record`, submits, and waits.
    void runOnce(const std::function<void(const vk::raii::CommandBuffer&)>& record) const;

    /// Submits `commands` and waits as long as it takes.
    void submitAndWait(const vk::raii::CommandBuffer& commands) const;

private:
    explicit Context(vk::raii::Context loader) : loader_(std::move(loader)) {}
    void useQueue(vk::raii::Queue queue, uint32_t family);

    vk::raii::Context loader_;
    bool borrowed_ = false;  // instance and device are somebody else's
    vk::raii::Instance instance_ = nullptr;
    std::function<void(std::string_view)> onMessage_;  // outlives the messenger that calls it
    vk::raii::DebugUtilsMessengerEXT messenger_ = nullptr;
    vk::raii::PhysicalDevice physical_ = nullptr;
    vk::raii::Device device_ = nullptr;
    vk::raii::Queue queue_ = nullptr;
    vk::raii::CommandPool commandPool_ = nullptr;
    vk::PhysicalDeviceMemoryProperties memory_;
    vk::PhysicalDeviceLimits limits_;
    DeviceInfo info_;
    bool labels_ = false;
    bool feedbackLoops_ = false;
    float largestPoint_ = 1;
    vk::SampleCountFlags sampleCounts_;
    uint64_t maxBufferBytes_ = 0;
    uint64_t timestampMask_ = 0;
    mutable uint64_t allocatedBytes_ = 0;
    mutable uint64_t peakBytes_ = 0;
};

}  // namespace luciole::gpu
