#pragma once
#include <fmt/format.h>

#include <luciole/error.hpp>

#include "gpu/vulkan.hpp"

namespace luciole::gpu {

/// Runs `work`; what Vulkan throws becomes an Error.
template <typename Work>
auto translatingVulkanErrors(const Work& work) {
    try {
        return work();
    } catch (const vk::InitializationFailedError& error) {
        throw Error(ErrorKind::device, fmt::format("Vulkan: {}", error.what()));
    } catch (const vk::SystemError& error) {
        throw Error(ErrorKind::deviceLost, fmt::format("Vulkan: {}", error.what()));
    }
}

}  // namespace luciole::gpu
