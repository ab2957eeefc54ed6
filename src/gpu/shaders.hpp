#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace luciole::gpu {

/// SPIR-V of a shader that was compiled into the program, by its path below src/ ("render/lighting/brute_force.frag").
/// \throws std::logic_error for an unknown name
std::span<const uint32_t> shaderCode(std::string_view name);

}  // namespace luciole::gpu
