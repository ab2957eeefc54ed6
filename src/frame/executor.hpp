#pragma once
#include <map>

#include "frame/graph.hpp"
#include "gpu/pipelines.hpp"
#include "gpu/resources.hpp"

namespace luciole::frame {

/// What a pass recorded.
struct DrawCounts {
    uint32_t draws = 0;
    uint32_t stencilDraws = 0;  ///< those that leave colour as it is, in a pass that has colour
};

/// A compiled graph with its device resources: made once, run as often as wanted.
class Executor {
public:
    Executor(const gpu::Context& context, gpu::Pipelines& pipelines, FrameGraph graph);

    /// Runs one frame and waits for it. \param frameSet bound as set 0 of every pass that draws or computes; may be null if none reads it
    /// \param measure timestamps each pass, with a full barrier after each timestamp: without it the times of passes
    ///        that the driver overlaps or merges are wrong. Without effect on a queue that has no timestamps
    void run(vk::DescriptorSet frameSet, bool measure);

    /// Runs the first passes of the frame and waits. What the others would have written is undefined then, outputs included.
    /// \param passes at most passCount()
    void runFirst(vk::DescriptorSet frameSet, uint32_t passes);
    uint32_t passCount() const { return uint32_t(compiled_.passes.size()); }

    /// Records one frame for somebody else to submit, outside of any render pass. What was recorded last must have finished.
    void record(const vk::raii::CommandBuffer& commands, vk::DescriptorSet frameSet) { recordFirst(commands, frameSet, passCount(), false); }

    /// What the frame left in a buffer declared as an output. Host-visible.
    template <typename T>
    std::span<const T> read(BufferId buffer) const { return hostBuffers_.at(buffer.index).template read<T>(); }

    std::vector<PassStats> stats() const;  ///< of the last run, in order
    double recordMs() const { return recordMs_; }  ///< what the host took to record it
    std::string dot() const;               ///< with the times of the last run, if measured

    vk::Image image(ImageId id) const { return imageHandle(id.index); }
    vk::ImageView view(ImageId id) const { return *images_.at(id.index).view; }
    vk::Buffer buffer(BufferId id) const { return bufferHandle(id.index); }

private:
    void createResources();
    void createPassSets();
    void submit(vk::DescriptorSet frameSet, uint32_t passes, bool measure);
    void recordFirst(const vk::raii::CommandBuffer& commands, vk::DescriptorSet frameSet, uint32_t passes, bool measure);
    void recordPass(const vk::raii::CommandBuffer& commands, uint32_t index, vk::DescriptorSet frameSet);
    void recordBarriers(const vk::raii::CommandBuffer& commands, const std::vector<Barrier>& barriers) const;
    void timestamp(const vk::raii::CommandBuffer& commands, uint32_t query) const;
    vk::Image imageHandle(uint32_t resource) const;
    vk::Buffer bufferHandle(uint32_t resource) const;

    const gpu::Context& context_;
    gpu::Pipelines& pipelines_;
    FrameGraph graph_;
    CompiledGraph compiled_;
    std::map<uint32_t, gpu::Image> images_;
    std::map<uint32_t, gpu::Buffer> buffers_;
    std::map<uint32_t, gpu::MappedBuffer> hostBuffers_;
    vk::raii::DescriptorPool pool_ = nullptr;
    std::vector<vk::DescriptorSet> passSets_;  // freed with their pool
    vk::raii::QueryPool queries_ = nullptr;
    vk::raii::CommandBuffers commandBuffers_ = nullptr;
    std::vector<DrawCounts> drawCounts_;  // per compiled pass
    std::vector<double> passMs_;          // empty until measured
    double recordMs_ = 0;
};

}  // namespace luciole::frame
