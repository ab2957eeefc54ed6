#include "render/shadow/page_allocator.hpp"

#include <algorithm>
#include <bit>

namespace luciole::render {

PageAllocator::PageAllocator(uvec2 extent) : extent_(extent) {
    const uint32_t side = std::min(extent.x, extent.y);
    for (uint32_t y = 0; y < extent.y; y += side)
        for (uint32_t x = 0; x < extent.x; x += side) freeOf(side).push_back({x, y});
}

std::vector<uvec2>& PageAllocator::freeOf(uint32_t side) { return free_[std::countr_zero(side)]; }

std::optional<Page> PageAllocator::allocate(uint32_t side) {
    uint32_t found = side;
    const uint32_t largest = std::min(extent_.x, extent_.y);
    while (found <= largest && freeOf(found).empty()) found *= 2;
    if (found > largest) return std::nullopt;
    const uvec2 first = freeOf(found).back();
    freeOf(found).pop_back();
    for (; found > side; found /= 2) {
        const uint32_t half = found / 2;
        for (const uvec2 quarter : {uvec2(half, half), uvec2(0, half), uvec2(half, 0)}) freeOf(half).push_back(first + quarter);
    }
    return Page{first, side};
}

void PageAllocator::free(Page page) {
    const uint32_t largest = std::min(extent_.x, extent_.y);
    for (; page.side < largest; page.side *= 2) {
        std::vector<uvec2>& peers = freeOf(page.side);
        const uvec2 square = page.first / (2 * page.side) * (2 * page.side);
        const auto buddy = [&](uvec2 first) { return first / (2 * page.side) * (2 * page.side) == square; };
        if (std::ranges::count_if(peers, buddy) < 3) break;
        std::erase_if(peers, buddy);
        page.first = square;
    }
    freeOf(page.side).push_back(page.first);
}

}  // namespace luciole::render
