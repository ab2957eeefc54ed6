#include "metrics/shape.hpp"

#include <fmt/format.h>

#include <luciole/error.hpp>

namespace luciole::metrics {

void requireSameShape(std::string_view metric, const Image& reference, const Image& test, uint32_t channels) {
    const bool same = reference.width == test.width && reference.height == test.height && reference.channels == test.channels;
    if (same && !reference.data.empty() && (channels == 0 || reference.channels == channels)) return;
    const auto shape = [](const Image& image) { return fmt::format("{} x {} x {}", image.width, image.height, image.channels); };
    throw Error(ErrorKind::usage, fmt::format("{}: expected two images of one shape{}, got {} and {}", metric,
                                              channels == 0 ? "" : fmt::format(" with {} channels", channels), shape(reference), shape(test)));
}

}  // namespace luciole::metrics
