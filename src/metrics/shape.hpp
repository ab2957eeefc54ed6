#pragma once
#include <string_view>

#include <luciole/image.hpp>

namespace luciole::metrics {

/// \param channels that both have to have; 0: any number, the same
/// \throws Error(usage) that names `metric` and both shapes
void requireSameShape(std::string_view metric, const Image& reference, const Image& test, uint32_t channels = 0);

}  // namespace luciole::metrics
