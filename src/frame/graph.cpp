#include "frame/graph.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "frame/hazards.hpp"
#include "gpu/bindings.shared.h"
#include "gpu/resources.hpp"

namespace luciole::frame {
namespace {

[[noreturn]] void misuse(const Pass& pass, const Resource& resource, const std::string& what) {
    throw std::logic_error(fmt::format("frame graph: pass {}: {}: {}", pass.name, resource.name, what));
}

/// Consecutive accesses to one resource that need nothing between them: one write, or any number of reads in one layout.
struct Epoch {
    CombinedUse use;
    uint32_t firstPass;  ///< index into the compiled order
};

std::vector<Epoch> epochsOf(const FrameGraph& graph, const std::vector<CompiledPass>& order, uint32_t resource) {
    std::vector<Epoch> epochs;
    for (uint32_t i = 0; i < order.size(); ++i) {
        const auto use = combinedUse(graph, graph.passes()[order[i].pass], resource);
        if (!use) continue;
        const bool joins = !epochs.empty() && !epochs.back().use.writes && !use->writes && epochs.back().use.layout == use->layout;
        if (joins) {
            epochs.back().use.stages |= use->stages;
            epochs.back().use.access |= use->access;
        } else {
            epochs.push_back({*use, i});
        }
    }
    return epochs;
}

/// Which passes lead to an output, from the last to the first.
std::vector<bool> passesThatMatter(const FrameGraph& graph, std::vector<bool> wanted) {
    const auto& passes = graph.passes();
    std::vector<bool> matters(passes.size());
    for (size_t i = passes.size(); i-- > 0;) {
        for (const Use& use : passes[i].uses)
            if (infoOf(use.access).writes && wanted[use.resource]) matters[i] = true;
        if (!matters[i]) continue;
        for (const Use& use : passes[i].uses) {
            const auto combined = combinedUse(graph, passes[i], use.resource);
            wanted[use.resource] = !combined->overwrites;
        }
    }
    return matters;
}

void checkAttachments(const FrameGraph& graph, const Pass& pass) {
    const Resource* first = nullptr;
    for (const Use& use : pass.uses) {
        if (!isAttachment(use.access)) continue;
        const Resource& target = graph.resources()[use.resource];
        if (!first) first = &target;
        if (first->image.extent != target.image.extent)
            misuse(pass, target, fmt::format("expected the size of {}, {}x{}, found {}x{}", first->name, first->image.extent.width,
                                             first->image.extent.height, target.image.extent.width, target.image.extent.height));
        if (first->image.samples != target.image.samples)
            misuse(pass, target, fmt::format("expected the samples of {}, {}, found {}", first->name, uint32_t(first->image.samples),
                                             uint32_t(target.image.samples)));
    }
}

}  // namespace

uint64_t Resource::bytes() const {
    return isImage() ? uint64_t(image.extent.width) * image.extent.height * gpu::bytesPerTexel(image.format) * uint32_t(image.samples) : bufferBytes;
}

std::optional<CombinedUse> Resource::useAfter() const {
    if (!output) return outside;
    const AccessInfo& info = infoOf(*output);
    return CombinedUse{.stages = info.stages, .access = info.access, .layout = isImage() ? layoutOf(*output, image.format) : vk::ImageLayout::eUndefined};
}

std::optional<CombinedUse> combinedUse(const FrameGraph& graph, const Pass& pass, uint32_t resource) {
    std::optional<CombinedUse> combined;
    const Resource& target = graph.resources()[resource];
    for (const Use& use : pass.uses) {
        if (use.resource != resource) continue;
        const AccessInfo& info = infoOf(use.access);
        const auto layout = target.isImage() ? layoutOf(use.access, target.image.format) : vk::ImageLayout::eUndefined;
        if (!combined) combined = CombinedUse{.layout = layout};
        if (combined->layout != layout)
            misuse(pass, target, fmt::format("expected one layout in a pass, found {} and {}", vk::to_string(combined->layout),
                                             vk::to_string(layout)));
        combined->stages |= info.stages;
        combined->access |= info.access;
        combined->writes |= info.writes;
        combined->overwrites |= use.overwrites;
    }
    return combined;
}

PassBuilder& PassBuilder::use(const Use& use, bool isImage, bool writes) {
    Pass& pass = graph_.passes_[pass_];
    const AccessInfo& info = infoOf(use.access);
    if (use.resource >= graph_.resources_.size())
        throw std::logic_error(fmt::format("frame graph: pass {}: {} of a handle that nothing made", pass.name, info.name));
    const Resource& target = graph_.resources_[use.resource];
    if (info.writes != writes)
        misuse(pass, target, fmt::format("{} declared as a {}", info.name, writes ? "write" : "read"));
    if (target.isImage() != isImage || (isImage ? !info.imageUsage : !info.bufferUsage))
        misuse(pass, target, fmt::format("{} is not for {}", info.name, isImage ? "images" : "buffers"));
    if (writes && !target.content.empty()) misuse(pass, target, fmt::format("{} of a constant", info.name));
    const bool needsContent = use.access == Access::colorBlend || use.access == Access::colorFeedback || use.access == Access::depthWrite || use.access == Access::stencilWrite;
    if (needsContent && use.overwrites && !use.clear)
        misuse(pass, target, fmt::format("{} needs what is there: update or clear it", info.name));
    const bool sampled = use.access == Access::fragmentSampled || use.access == Access::computeSampled || use.access == Access::colorFeedback;
    const bool stored = !isImage && (use.access == Access::fragmentStorageRead || use.access == Access::fragmentStorageWrite ||
                                     use.access == Access::computeStorageRead ||
                                     use.access == Access::computeStorageWrite);
    const uint32_t slots = sampled ? shared::kPassSampledCount : stored ? shared::kPassStorageCount : 0;
    if (slots ? use.binding >= slots : use.binding != kNoBinding)
        misuse(pass, target, fmt::format("{}: expected {}", info.name, slots ? fmt::format("a slot below {}", slots) : "no slot"));
    pass.uses.push_back(use);
    return *this;
}

PassBuilder& PassBuilder::read(ImageId image, Access access, uint32_t binding) {
    return use({.resource = image.index, .access = access, .binding = binding}, true, false);
}
PassBuilder& PassBuilder::read(BufferId buffer, Access access, uint32_t binding) {
    return use({.resource = buffer.index, .access = access, .binding = binding}, false, false);
}
PassBuilder& PassBuilder::write(ImageId image, Access access) {
    return use({.resource = image.index, .access = access, .overwrites = true}, true, true);
}
PassBuilder& PassBuilder::write(BufferId buffer, Access access, uint32_t binding) {
    return use({.resource = buffer.index, .access = access, .binding = binding, .overwrites = true}, false, true);
}
PassBuilder& PassBuilder::update(ImageId image, Access access, uint32_t binding) {
    return use({.resource = image.index, .access = access, .binding = binding}, true, true);
}
PassBuilder& PassBuilder::update(BufferId buffer, Access access, uint32_t binding) {
    return use({.resource = buffer.index, .access = access, .binding = binding}, false, true);
}
PassBuilder& PassBuilder::clear(ImageId image, Access access, vk::ClearValue value) {
    return use({.resource = image.index, .access = access, .overwrites = true, .clear = value}, true, true);
}
void PassBuilder::record(std::function<void(PassContext&)> record) { graph_.passes_[pass_].record = std::move(record); }

ImageId FrameGraph::createImage(std::string name, ImageDesc desc) {
    resources_.push_back({.name = std::move(name), .image = desc});
    return {uint32_t(resources_.size() - 1)};
}

BufferId FrameGraph::createBuffer(std::string name, uint64_t bytes) {
    resources_.push_back({.name = std::move(name), .bufferBytes = std::max<uint64_t>(bytes, 1)});
    return {uint32_t(resources_.size() - 1)};
}

BufferId FrameGraph::importBuffer(std::string name, uint64_t bytes, vk::Buffer handle) {
    const BufferId buffer = createBuffer(std::move(name), bytes);
    resources_[buffer.index].imported = handle;
    return buffer;
}

ImageId FrameGraph::importImage(std::string name, ImageDesc desc, vk::Image handle, vk::ImageLayout layout) {
    const ImageId image = createImage(std::move(name), desc);
    resources_[image.index].importedImage = handle;
    resources_[image.index].outside = CombinedUse{.stages = vk::PipelineStageFlagBits2::eAllCommands,
                                                  .access = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite,
                                                  .layout = layout,
                                                  .writes = true};
    return image;
}

BufferId FrameGraph::createConstantBuffer(std::string name, std::span<const uint32_t> values) {
    const BufferId buffer = createBuffer(std::move(name), values.size_bytes());
    const auto bytes = std::as_bytes(values);
    resources_[buffer.index].content.assign(bytes.begin(), bytes.end());
    resources_[buffer.index].content.resize(resources_[buffer.index].bufferBytes);
    return buffer;
}

PassBuilder FrameGraph::addPass(std::string name) {
    passes_.push_back({.name = std::move(name)});
    return PassBuilder(*this, uint32_t(passes_.size() - 1));
}

void FrameGraph::output(BufferId buffer, Access access) { markOutput(buffer.index, access); }
void FrameGraph::output(ImageId image, Access access) { markOutput(image.index, access); }

void FrameGraph::markOutput(uint32_t resource, Access access) {
    Resource& target = resources_.at(resource);
    const AccessInfo& info = infoOf(access);
    const bool fits = access == Access::hostRead ? !target.isImage() : target.isImage() ? bool(info.imageUsage) : bool(info.bufferUsage);
    if (info.writes || !fits) throw std::logic_error(fmt::format("frame graph: {}: {} of an output", target.name, info.name));
    target.output = access;
}

CompiledGraph FrameGraph::compile() const {
    CompiledGraph compiled{.used = std::vector<bool>(resources_.size())};
    std::vector<bool> wanted;
    for (const Resource& resource : resources_) wanted.push_back(resource.useAfter().has_value());
    const std::vector<bool> matters = passesThatMatter(*this, wanted);
    for (uint32_t i = 0; i < passes_.size(); ++i)
        if (matters[i]) compiled.passes.push_back({i, {}});
    for (const Pass& pass : passes_) checkAttachments(*this, pass);

    for (uint32_t resource = 0; resource < resources_.size(); ++resource) {
        const auto epochs = epochsOf(*this, compiled.passes, resource);
        // What the last frame did is over: frames wait for their fence. So the first access waits for nothing.
        CombinedUse previous = resources_[resource].outside.value_or(CombinedUse{.stages = vk::PipelineStageFlagBits2::eNone});
        for (const Epoch& epoch : epochs) {
            compiled.used[resource] = true;
            CompiledPass& pass = compiled.passes[epoch.firstPass];
            const bool first = &epoch == &epochs.front();
            const Resource& target = resources_[resource];
            const bool filled = !target.content.empty() || target.imported || target.outside;
            if (first && !epoch.use.overwrites && !filled)
                misuse(passes_[pass.pass], target, "used before anything was written to it");
            if (!first || resources_[resource].isImage())
                pass.barriers.push_back({resource, previous.stages, epoch.use.stages, writesOf(previous.access), epoch.use.access,
                                         epoch.use.overwrites ? vk::ImageLayout::eUndefined : previous.layout, epoch.use.layout});
            previous = epoch.use;
        }
        if (const auto after = resources_[resource].useAfter(); after && compiled.used[resource])
            compiled.finalBarriers.push_back({resource, previous.stages, after->stages, writesOf(previous.access), after->access, previous.layout, after->layout});
        else if (resources_[resource].output)
            throw std::logic_error(fmt::format("frame graph: {}: an output that no pass writes", resources_[resource].name));
    }
    if (const auto hazards = findHazards(*this, compiled); !hazards.empty())
        throw std::logic_error("frame graph: " + hazards.front());
    return compiled;
}

std::string toDot(const FrameGraph& graph, const CompiledGraph& compiled, const std::vector<std::string>& passNotes) {
    std::string dot =
        "digraph frame {\n  rankdir=LR; node [fontname=\"sans-serif\", fontsize=10]; edge [fontname=\"sans-serif\", fontsize=8];\n";
    for (uint32_t i = 0; i < compiled.passes.size(); ++i) {
        const std::string note = i < passNotes.size() && !passNotes[i].empty() ? "\\n" + passNotes[i] : "";
        dot += fmt::format("  p{} [shape=box, style=\"rounded,filled\", fillcolor=\"#ffe9a8\", label=\"{}{}\"];\n", i,
                           graph.passes()[compiled.passes[i].pass].name, note);
    }
    for (uint32_t r = 0; r < graph.resources().size(); ++r) {
        if (!compiled.used[r]) continue;
        const Resource& resource = graph.resources()[r];
        const std::string what =
            resource.isImage() ? fmt::format("{} {}x{}", vk::to_string(resource.image.format), resource.image.extent.width,
                                             resource.image.extent.height)
                               : std::string("buffer");
        dot += fmt::format("  r{} [shape=box, label=\"{}\\n{}\\n{:.2f} MiB\"];\n", r, resource.name, what,
                           double(resource.bytes()) / (1 << 20));
    }
    for (uint32_t i = 0; i < compiled.passes.size(); ++i)
        for (const Use& use : graph.passes()[compiled.passes[i].pass].uses) {
            const AccessInfo& info = infoOf(use.access);
            dot += info.writes ? fmt::format("  p{} -> r{} [label=\"{}\"];\n", i, use.resource, info.name)
                               : fmt::format("  r{} -> p{} [label=\"{}\"];\n", use.resource, i, info.name);
        }
    return dot + "}\n";
}

}  // namespace luciole::frame
