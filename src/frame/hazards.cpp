#include "frame/hazards.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace luciole::frame {
namespace {

/// Where, and to which kinds of access, a write can be seen.
struct Visible {
    vk::PipelineStageFlags2 stages;
    vk::AccessFlags2 access;
};

/// An access that has happened, and what is known to come after it.
struct Past {
    std::string pass;
    CombinedUse use;
    vk::PipelineStageFlags2 orderedBefore;  ///< stages of later commands that wait for it
    bool available = false;                 ///< its writes were flushed
    std::vector<Visible> visible;
};

template <typename Flags>
bool contains(Flags whole, Flags part) {
    return (whole & part) == part;
}

bool waitsFor(const Barrier& barrier, const Past& earlier) {
    return contains(barrier.srcStages, earlier.use.stages) || (earlier.orderedBefore & barrier.srcStages);
}

/// Follows one resource through the frame.
class Tracker {
public:
    Tracker(const Resource& resource, std::vector<std::string>& hazards) : resource_(resource), hazards_(hazards) {
        if (!resource.outside) return;
        layout_ = resource.outside->layout;
        use(*resource.outside, "outside");
    }

    void barrier(const Barrier& barrier, const std::string& before) {
        if (resource_.isImage()) transition(barrier, before);
        for (Past& earlier : past_) {
            if (!waitsFor(barrier, earlier)) continue;
            earlier.orderedBefore |= barrier.dstStages;
            if (!earlier.use.writes) continue;
            const bool direct = contains(barrier.srcStages, earlier.use.stages);
            earlier.available |= direct && contains(barrier.srcAccess, writesOf(earlier.use.access));
            if (earlier.available) earlier.visible.push_back({barrier.dstStages, barrier.dstAccess});
        }
    }

    void use(const CombinedUse& use, const std::string& pass) {
        if (resource_.isImage() && layout_ != use.layout)
            report("layout of {} in pass {}: needs {}, is in {}", resource_.name, pass, vk::to_string(use.layout), vk::to_string(layout_));
        if (!use.overwrites && discarded_)
            report("content of {} is needed by pass {} and was discarded by a barrier", resource_.name, pass);
        for (const Past& earlier : past_) {
            if (!earlier.use.writes && !use.writes) continue;
            const char* kind = !earlier.use.writes ? "write-after-read" : use.writes ? "write-after-write" : "read-after-write";
            const bool ordered = contains(earlier.orderedBefore, use.stages);
            const bool seen = std::ranges::any_of(earlier.visible, [&](const Visible& scope) {
                return contains(scope.stages, use.stages) && contains(scope.access, use.access);
            });
            if (!ordered || (earlier.use.writes && !seen))
                report("{} hazard on {} between passes {} and {}", kind, resource_.name, earlier.pass, pass);
        }
        // What comes after a write comes after all that the write came after.
        if (use.writes) past_.clear();
        past_.push_back({.pass = pass, .use = use});
        discarded_ = false;
    }

private:
    /// A layout transition writes the image: it must come after every access so far.
    void transition(const Barrier& barrier, const std::string& before) {
        if (barrier.oldLayout != vk::ImageLayout::eUndefined && barrier.oldLayout != layout_)
            report("layout of {} before pass {}: the barrier expects {}, the image is in {}", resource_.name, before,
                   vk::to_string(barrier.oldLayout), vk::to_string(layout_));
        if (barrier.oldLayout != barrier.newLayout)
            for (const Past& earlier : past_)
                if (!waitsFor(barrier, earlier))
                    report("the layout transition of {} before pass {} does not wait for pass {}", resource_.name, before, earlier.pass);
        discarded_ |= barrier.oldLayout == vk::ImageLayout::eUndefined;
        layout_ = barrier.newLayout;
    }

    template <typename... Arguments>
    void report(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        hazards_.push_back(fmt::format(format, std::forward<Arguments>(arguments)...));
    }

    const Resource& resource_;
    std::vector<std::string>& hazards_;
    std::vector<Past> past_;
    vk::ImageLayout layout_ = vk::ImageLayout::eUndefined;
    bool discarded_ = false;
};

}  // namespace

std::vector<std::string> findHazards(const FrameGraph& graph, const CompiledGraph& compiled) {
    std::vector<std::string> hazards;
    for (uint32_t r = 0; r < graph.resources().size(); ++r) {
        Tracker tracker(graph.resources()[r], hazards);
        for (const CompiledPass& compiledPass : compiled.passes) {
            const Pass& pass = graph.passes()[compiledPass.pass];
            for (const Barrier& barrier : compiledPass.barriers)
                if (barrier.resource == r) tracker.barrier(barrier, pass.name);
            if (const auto use = combinedUse(graph, pass, r)) tracker.use(*use, pass.name);
        }
        for (const Barrier& barrier : compiled.finalBarriers)
            if (barrier.resource == r) tracker.barrier(barrier, "outside");
        const Resource& resource = graph.resources()[r];
        if (const auto after = resource.useAfter(); after && compiled.used[r])
            tracker.use(*after, resource.output == Access::hostRead ? "host" : "outside");
    }
    return hazards;
}

}  // namespace luciole::frame
