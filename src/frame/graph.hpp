#pragma once
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frame/access.hpp"

/// The frame graph. Passes declare what they read and write; which passes run, their barriers, layouts, descriptors,
/// attachments, debug labels and timers follow from that. Declaring and compiling need no device.
namespace luciole::frame {

class PassContext;

struct ImageId {
    uint32_t index = ~0u;
};
struct BufferId {
    uint32_t index = ~0u;
};

struct ImageDesc {
    vk::Format format = vk::Format::eUndefined;
    vk::Extent2D extent;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
};

/// The uses of one resource in one pass, or by whoever is outside of the frame, as one.
struct CombinedUse {
    vk::PipelineStageFlags2 stages;
    vk::AccessFlags2 access;
    vk::ImageLayout layout = vk::ImageLayout::eUndefined;
    bool writes = false;
    bool overwrites = false;  ///< what was there before does not matter
};

/// An image or a buffer of the frame; `bufferBytes` != 0 tells a buffer. `imported`, `importedImage`: somebody else's. `content`: what
/// a buffer holds from the start.
struct Resource {
    std::string name;
    ImageDesc image;
    uint64_t bufferBytes = 0;
    vk::Buffer imported = {};
    vk::Image importedImage = {};
    std::vector<std::byte> content = {};
    std::optional<CombinedUse> outside = {};  ///< of an imported image: what its owner does with it before the frame and after it
    std::optional<Access> output = {};        ///< what becomes of it after the frame
    bool isImage() const { return bufferBytes == 0; }
    uint64_t bytes() const;
    std::optional<CombinedUse> useAfter() const;  ///< after the frame, if there is any
};

inline constexpr uint32_t kNoBinding = ~0u;

/// One access of one pass. `binding`: the slot in the pass's descriptor set (bindings.shared.h), among the sampled images or
/// among the storage buffers.
struct Use {
    uint32_t resource;
    Access access;
    uint32_t binding = kNoBinding;
    bool overwrites = false;  ///< what was there before does not matter
    std::optional<vk::ClearValue> clear;
};

struct Pass {
    std::string name;
    std::vector<Use> uses;
    std::function<void(PassContext&)> record;
};

class FrameGraph;

/// Fluent declaration of one pass. Attachments get their locations in the order of the calls.
class PassBuilder {
public:
    PassBuilder& read(ImageId image, Access access, uint32_t binding = kNoBinding);
    PassBuilder& read(BufferId buffer, Access access, uint32_t binding = kNoBinding);
    /// The pass makes all of the content; nothing before it survives.
    PassBuilder& write(ImageId image, Access access);
    PassBuilder& write(BufferId buffer, Access access, uint32_t binding = kNoBinding);
    /// The pass adds to, or changes parts of, what is there.
    PassBuilder& update(ImageId image, Access access, uint32_t binding = kNoBinding);
    PassBuilder& update(BufferId buffer, Access access, uint32_t binding = kNoBinding);
    /// An attachment that starts at `value`.
    PassBuilder& clear(ImageId image, Access access, vk::ClearValue value);
    void record(std::function<void(PassContext&)> record);

private:
    friend class FrameGraph;
    PassBuilder(FrameGraph& graph, uint32_t pass) : graph_(graph), pass_(pass) {}
    PassBuilder& use(const Use& use, bool isImage, bool writes);
    FrameGraph& graph_;
    uint32_t pass_;
};

/// A dependency between two accesses to one resource, recorded before pass `beforePass` of the compiled order.
struct Barrier {
    uint32_t resource;
    vk::PipelineStageFlags2 srcStages, dstStages;
    vk::AccessFlags2 srcAccess, dstAccess;
    vk::ImageLayout oldLayout, newLayout;  ///< images only
};

struct CompiledPass {
    uint32_t pass;                  ///< index into FrameGraph::passes()
    std::vector<Barrier> barriers;  ///< before it
};

struct CompiledGraph {
    std::vector<CompiledPass> passes;  ///< in declaration order, those that matter
    std::vector<Barrier> finalBarriers;  ///< after the last pass: outputs to the host
    std::vector<bool> used;              ///< per resource
};

class FrameGraph {
public:
    ImageId createImage(std::string name, ImageDesc desc);
    const ImageDesc& descOf(ImageId image) const { return resources_.at(image.index).image; }
    BufferId createBuffer(std::string name, uint64_t bytes);
    /// A buffer that outlives the frame, such as one that the frame's set names. Until a pass writes it, it holds what the host made
    /// visible to all commands, or what the frame before left.
    BufferId importBuffer(std::string name, uint64_t bytes, vk::Buffer handle);
    /// An image that somebody else owns and has filled, with one level and one layer. Its owner may do with it whatever he likes in
    /// the same queue, before the frame and after it: the frame waits for him and he for the frame.
    /// \param layout in which the frame finds it and leaves it
    ImageId importImage(std::string name, ImageDesc desc, vk::Image handle, vk::ImageLayout layout);
    /// A buffer that holds `values` when the first frame begins, and that no pass may change.
    BufferId createConstantBuffer(std::string name, std::span<const uint32_t> values);
    PassBuilder addPass(std::string name);

    /// Marks a result that is read after the frame, by the host or by commands that follow in the same queue; passes that lead to no
    /// result are dropped.
    void output(BufferId buffer, Access access = Access::hostRead);
    void output(ImageId image, Access access);

    /// Drops, orders and synchronises.
    /// \throws std::logic_error naming the pass and the resource: read before anything wrote it, one pass using a
    ///         resource in two layouts, attachments of two sizes, a hazard left (see hazards.hpp). Declarations throw
    ///         likewise: an access with the wrong verb or resource, a sampled image without its slot, an empty handle
    CompiledGraph compile() const;

    const std::vector<Pass>& passes() const { return passes_; }
    const std::vector<Resource>& resources() const { return resources_; }

private:
    friend class PassBuilder;
    void markOutput(uint32_t resource, Access access);
    std::vector<Resource> resources_;
    std::vector<Pass> passes_;
};

std::optional<CombinedUse> combinedUse(const FrameGraph& graph, const Pass& pass, uint32_t resource);

/// The compiled frame in Graphviz's language. \param passNotes per compiled pass, may be empty: text under its name
std::string toDot(const FrameGraph& graph, const CompiledGraph& compiled, const std::vector<std::string>& passNotes = {});

}  // namespace luciole::frame
