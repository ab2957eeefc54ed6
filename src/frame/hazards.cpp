#include "frame/hazards.hpp"

#include <fmt/format.h>

namespace luciole::frame {
namespace {

/// An access that has happened, and what is known to come after it.
struct Past {
    const Pass* pass;
    CombinedUse use;
    vk::PipelineStageFlags2 orderedBefore;  ///< stages of later commands that wait for it
    bool available = false;                 ///< its writes were flushed
    vk::PipelineStageFlags2 visibleStages;  ///< where, and to which accesses, its writes can be seen
    vk::AccessFlags2 visibleAccess;
};

template <typename Flags>
bool contains(Flags whole, Flags part) {
    return (whole & part) == part;
}

void apply(const Barrier& barrier, std::vector<Past>& past) {
    for (Past& earlier : past) {
        const bool direct = contains(barrier.srcStages, earlier.use.stages);
        const bool chained = bool(earlier.orderedBefore & barrier.srcStages);
        if (!direct && !chained) continue;
        earlier.orderedBefore |= barrier.dstStages;
        if (!earlier.use.writes) continue;
        earlier.available |= direct && contains(barrier.srcAccess, writesOf(earlier.use.access));
        if (!earlier.available) continue;
        earlier.visibleStages |= barrier.dstStages;
        earlier.visibleAccess |= barrier.dstAccess;
    }
}

std::string describe(const char* kind, const Past& earlier, const Pass& later, const Resource& resource) {
    return fmt::format("{} hazard on {} between passes {} and {}", kind, resource.name, earlier.pass->name, later.name);
}

}  // namespace

std::vector<std::string> findHazards(const FrameGraph& graph, const CompiledGraph& compiled) {
    std::vector<std::string> hazards;
    for (uint32_t r = 0; r < graph.resources().size(); ++r) {
        const Resource& resource = graph.resources()[r];
        std::vector<Past> past;
        auto layout = vk::ImageLayout::eUndefined;
        for (const CompiledPass& compiledPass : compiled.passes) {
            const Pass& pass = graph.passes()[compiledPass.pass];
            for (const Barrier& barrier : compiledPass.barriers) {
                if (barrier.resource != r) continue;
                apply(barrier, past);
                if (!resource.isImage()) continue;
                if (barrier.oldLayout != vk::ImageLayout::eUndefined && barrier.oldLayout != layout)
                    hazards.push_back(fmt::format("layout of {} before pass {}: the barrier expects {}, the image is in {}",
                                                  resource.name, pass.name, vk::to_string(barrier.oldLayout), vk::to_string(layout)));
                layout = barrier.newLayout;
            }
            const auto use = combinedUse(graph, pass, r);
            if (!use) continue;
            if (resource.isImage() && layout != use->layout)
                hazards.push_back(fmt::format("layout of {} in pass {}: needs {}, is in {}", resource.name, pass.name,
                                              vk::to_string(use->layout), vk::to_string(layout)));
            for (const Past& earlier : past) {
                if (!earlier.use.writes && !use->writes) continue;
                const char* kind = !earlier.use.writes ? "write-after-read" : use->writes ? "write-after-write" : "read-after-write";
                const bool ordered = contains(earlier.orderedBefore, use->stages);
                const bool visible = !earlier.use.writes || (contains(earlier.visibleStages, use->stages) &&
                                                             contains(earlier.visibleAccess, use->access));
                if (!ordered || !visible) hazards.push_back(describe(kind, earlier, pass, resource));
            }
            // Whoever is ordered after a write is ordered after what that write was ordered after.
            if (use->writes) past.clear();
            past.push_back({.pass = &pass, .use = *use});
        }
    }
    return hazards;
}

}  // namespace luciole::frame
