#pragma once
// The one way in to Vulkan: vk::raii for what is owned, vk:: for what is passed. Precompiled for every target of ours
// that uses it (cmake/options.cmake).
#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS  // so that designated initialisers work
#include <vulkan/vulkan_raii.hpp>
