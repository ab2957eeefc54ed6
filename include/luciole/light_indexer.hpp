#pragma once
#include <array>
#include <cstdint>
#include <memory>

#include <vulkan/vulkan_core.h>

#include <luciole/scene.hpp>
#include <luciole/settings.hpp>

/// Light indices for a renderer that has a Vulkan device, surfaces and shaders of its own (Trebilco 2009, "Light-Indexed Deferred
/// Rendering"): it draws depth, LightIndexer finds out which lights reach each pixel, and its shaders include
/// <luciole/light_index.glsl> to look them up. docs/embedding.md tells the whole of it.
namespace luciole {

/// The host's own Vulkan 1.3, which has to outlive the LightIndexer. The device has the features of LightIndexer::enableFeatures
/// enabled and no extension. The constructor of a LightIndexer, setLights and setDepth submit to the queue and wait; nobody else may
/// use it meanwhile.
struct HostDevice {
    VkInstance instance;
    VkPhysicalDevice physicalDevice;
    VkDevice device;
    uint32_t queueFamily;  ///< does graphics and compute
    VkQueue queue;         ///< of that family; the one that recorded commands are submitted to
    PFN_vkGetInstanceProcAddr getInstanceProcAddr;
};

/// The depth of the host's surfaces, reversed: 1 at the near plane, drawn with `clipFromView`. One layer, one level, one sample; usage
/// has VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT and VK_IMAGE_USAGE_SAMPLED_BIT.
struct HostDepth {
    VkImage image;
    VkFormat format;       ///< VK_FORMAT_D32_SFLOAT or VK_FORMAT_D32_SFLOAT_S8_UINT
    VkImageLayout layout;  ///< of all its aspects, before the recorded commands and after them
    uvec2 extent;          ///< pixels
};

/// Bit shifting, one pass; the rows with up to 8 indices of the table in docs/techniques/light-indexed.md.
struct LightIndexSettings {
    uint32_t overlap = 8;                             ///< lights a pixel has room for: 1, 2, 4 or 8
    LidrIndices indices = LidrIndices::automatic;     ///< lights that are told apart; automatic: the least that will do
};

/// What a descriptor set of the host's has to hold for light_index.glsl, ready to be written, from binding LUCIOLE_BINDING on.
struct LightIndexDescriptors {
    std::array<VkDescriptorImageInfo, 5> images;  ///< combined image samplers: four index images, then the table of functions
    VkDescriptorBufferInfo lights;                ///< storage buffer: the lights in view space
};

/// clipFromView of docs/conventions.md, "Spaces".
mat4 clipFromView(const Camera& camera, uvec2 extent);

/// Not thread-safe. Its commands may be recorded again when those recorded last have finished: frames in flight take one each.
class LightIndexer {
public:
    /// Sets, in what the host makes its device from, the features that have to be enabled.
    static void enableFeatures(VkPhysicalDeviceFeatures& v10, VkPhysicalDeviceVulkan12Features& v12, VkPhysicalDeviceVulkan13Features& v13);

    /// \param scene its lights, functions, light volumes and link groups; nothing else of it is looked at
    /// \throws Error(device) for a device that lacks something, naming it, or blends indices inexactly; Error(usage) for settings that are no row of the table and
    ///         a depth that is none of the two formats; Error(limit) for more lights than the settings tell apart, with both numbers;
    ///         Error(scene) for lights that break a rule of scene.hpp; Error(deviceLost)
    LightIndexer(const HostDevice& host, const Scene& scene, const HostDepth& depth, const LightIndexSettings& settings = {});
    ~LightIndexer();
    LightIndexer(LightIndexer&&) noexcept;
    LightIndexer& operator=(LightIndexer&&) noexcept;

    /// Other lights, or a depth image in place of one that is gone. Nothing recorded may be on its way; `descriptors` and `packing`
    /// change. \throws as the constructor
    void setLights(const Scene& scene);
    void setDepth(const HostDepth& depth);

    LightIndexDescriptors descriptors() const;
    /// LUCIOLE_PACKING of light_index.glsl: bits of an index, bits of it in a channel, indices a pixel, images.
    std::array<uint32_t, 4> packing() const;
    uint32_t lightCount() const;  ///< indices run from 1 to it

    /// Records what fills the index images and the table of lights, outside of any render pass, into a primary command buffer in the
    /// recording state. Commands before it may have written the depth, and fragment and vertex shaders after it may read the
    /// results: barriers for both are recorded, too. What was bound and set before is not any more.
    void record(VkCommandBuffer commands, const Camera& camera);

    /// Pixels that more lights reach than there is room for, when what was recorded last has finished. There the last lights of the
    /// table are kept.
    uint32_t pixelsOver() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace luciole
