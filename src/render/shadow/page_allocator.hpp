#pragma once
#include <array>
#include <optional>
#include <set>
#include <utility>

#include <luciole/math.hpp>

namespace luciole::render {

/// A square part of an atlas, texels. Sides are powers of two, and pages lie at multiples of their side.
struct Page {
    uvec2 first{0};
    uint32_t side = 0;
    bool operator==(const Page&) const = default;
};

/// Hands out pages of an atlas: each free square is halved until it is as small as asked for, and four free quarters are one free square
/// again (Knowlton 1965, the buddy system, in two dimensions). Pages asked for by falling side are packed without a gap.
class PageAllocator {
public:
    PageAllocator() = default;
    /// \param extent of the atlas: powers of two, of which one is the other or half of it
    explicit PageAllocator(uvec2 extent);

    uvec2 extent() const { return extent_; }
    /// \param side a power of two \return nothing if there is no free square as large
    std::optional<Page> allocate(uint32_t side);
    void free(Page page);

private:
    /// Places of free squares, row by row.
    using Free = std::set<std::pair<uint32_t, uint32_t>>;
    Free& freeOf(uint32_t side);

    uvec2 extent_{0};
    std::array<Free, 32> free_;  ///< by the logarithm of the side
};

}  // namespace luciole::render
