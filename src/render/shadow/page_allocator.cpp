#include "render/shadow/page_allocator.hpp"

#include <algorithm>
#include <bit>

namespace luciole::render {

PageAllocator::PageAllocator(uvec2 extent) : extent_(extent) {
    const uint32_t side = std::min(extent.x, extent.y);
    for (uint32_t y = 0; y < extent.y; y += side)
        for (uint32_t x = 0; x < extent.x; x += side) freeOf(side).insert({y, x});
}

PageAllocator::Free& PageAllocator::freeOf(uint32_t side) { return free_[std::countr_zero(side)]; }

std::optional<Page> PageAllocator::allocate(uint32_t side) {
    uint32_t found = side;
    const uint32_t largest = std::min(extent_.x, extent_.y);
    while (found <= largest && freeOf(found).empty()) found *= 2;
    if (found > largest) return std::nullopt;
    const auto [y, x] = freeOf(found).extract(freeOf(found).begin()).value();
    for (; found > side; found /= 2) {
        const uint32_t half = found / 2;
        freeOf(half).insert({{y, x + half}, {y + half, x}, {y + half, x + half}});
    }
    return Page{{x, y}, side};
}

void PageAllocator::free(Page page) {
    const uint32_t largest = std::min(extent_.x, extent_.y);
    for (; page.side < largest; page.side *= 2) {
        Free& peers = freeOf(page.side);
        const uvec2 square = page.first / (2 * page.side) * (2 * page.side);
        Free buddies{{square.y, square.x}, {square.y, square.x + page.side}, {square.y + page.side, square.x}, {square.y + page.side, square.x + page.side}};
        buddies.erase({page.first.y, page.first.x});
        if (!std::ranges::all_of(buddies, [&](const auto& buddy) { return peers.contains(buddy); })) break;
        for (const auto& buddy : buddies) peers.erase(buddy);
        page.first = square;
    }
    freeOf(page.side).insert({page.first.y, page.first.x});
}

}  // namespace luciole::render
