#pragma once
#include "gpu/vulkan.hpp"

namespace luciole::frame {

/// How a pass touches a resource. One table (access.cpp) maps each to stages, access mask, layout and usage.
enum class Access : uint8_t {
    colorWrite,           ///< colour attachment, not blended
    colorBlend,           ///< colour attachment, blended over what is there
    colorFeedback,        ///< colour attachment, not blended, that fragment shaders sample: each pixel what it was before they write it
    depthWrite,           ///< depth attachment, tested and written
    depthTest,            ///< depth attachment, tested only
    stencilWrite,         ///< depth attachment, tested only, whose stencil is tested and written
    fragmentSampled,      ///< texture in fragment shaders; also of a depth image that is tested in the same pass
    fragmentStorageRead,  ///< storage buffer in vertex and fragment shaders
    fragmentStorageWrite, ///< storage buffer that fragment shaders write (and perhaps read)
    tableRead,            ///< table of the frame's set, uniform or storage buffer, in vertex and fragment shaders
    computeTableRead,     ///< the same in compute shaders
    tableSampled,         ///< texture of the frame's set, in fragment shaders
    indirectRead,         ///< arguments of a draw
    computeSampled,
    computeStorageRead,
    computeStorageWrite,  ///< written (and perhaps read) by compute
    transferRead,
    transferWrite,
    hostRead,             ///< by the host after the frame
};

struct AccessInfo {
    const char* name;
    vk::PipelineStageFlags2 stages;
    vk::AccessFlags2 access;
    vk::ImageLayout layout;
    vk::ImageUsageFlags imageUsage;
    vk::BufferUsageFlags bufferUsage;
    bool writes;
};
const AccessInfo& infoOf(Access access);

bool isAttachment(Access access);

/// Attaches an image's depth, and its stencil if it has one.
bool isDepthAttachment(Access access);

/// The layout of an image of `format` under `access`: sampled depth stays in the layout that allows testing, too, and a
/// depth image with a stencil has one layout for all that leaves its depth as it is.
vk::ImageLayout layoutOf(Access access, vk::Format format);

/// The part of an access mask that writes.
vk::AccessFlags2 writesOf(vk::AccessFlags2 access);

}  // namespace luciole::frame
