#pragma once
#include <algorithm>
#include <stdexcept>
#include <type_traits>

#include "frame/executor.hpp"
#include "gpu/pipelines.hpp"

namespace luciole::frame {

/// What a pass records with. If it has attachments, rendering on them has begun, and its sets 0 and 1 are bound.
class PassContext {
public:
    PassContext(const vk::raii::CommandBuffer& commandBuffer, gpu::Pipelines& pipelines, const Executor& executor,
                const Pass& pass, std::vector<vk::Format> colors, vk::Format depth, const ImageDesc& target, bool feedback)
        : commands(commandBuffer), pipelines_(pipelines), executor_(executor), pass_(pass), colors_(std::move(colors)), depth_(depth),
          target_(target), feedback_(feedback) {}

    const vk::raii::CommandBuffer& commands;  ///< for whatever is not wrapped here; draws are, so that they are counted
    vk::Extent2D extent() const { return target_.extent; }  ///< of the attachments; zero without any

    /// Handles of what the pass declared. \throws std::logic_error for anything else
    vk::Image image(ImageId id) const { return requireDeclared(id.index), executor_.image(id); }
    vk::Buffer buffer(BufferId id) const { return requireDeclared(id.index), executor_.buffer(id); }

    struct Draw {
        std::string vertex;
        std::string fragment = {};
        bool meshVertices = false;
        bool points = false;     ///< instead of triangles
        gpu::Blend blend = gpu::Blend::replace;
        bool lastAdds = false;   ///< the last colour attachment adds, whatever the others do
        uint8_t channels = 0xf;  ///< of the attachments, those that are written
        bool depthClamp = false;
        std::vector<uint32_t> constants = {};
    };
    /// A pipeline of this pass, to bind more than once.
    struct Prepared {
        vk::Pipeline pipeline;
        bool marksStencil;
    };
    Prepared prepare(const Draw& draw) {
        return {pipelines_.get({.vertex = draw.vertex, .fragment = draw.fragment, .meshVertices = draw.meshVertices, .points = draw.points, .blend = draw.blend, .feedback = feedback_, .lastAdds = draw.lastAdds,
                                .channels = draw.channels, .depthClamp = draw.depthClamp, .constants = draw.constants,
                                .colors = colors_, .depth = depth_, .samples = target_.samples}),
                !colors_.empty() && draw.fragment.empty()};
    }
    void bind(const Prepared& prepared) {
        marksStencil_ = prepared.marksStencil;
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, prepared.pipeline);
    }
    void bind(const Draw& draw) { bind(prepare(draw)); }
    void bindSet(uint32_t set, vk::DescriptorSet handle) {
        const auto point = target_.extent.width != 0 ? vk::PipelineBindPoint::eGraphics : vk::PipelineBindPoint::eCompute;
        commands.bindDescriptorSets(point, pipelines_.layout(), set, handle, nullptr);
    }
    /// Depth state; the default of a pass is no test and no write.
    void depth(vk::CompareOp compare, bool write) {
        commands.setDepthTestEnable(true);
        commands.setDepthWriteEnable(write);
        commands.setDepthCompareOp(compare);
    }
    struct Stencil {
        vk::CompareOp compare = vk::CompareOp::eAlways;
        vk::StencilOp fail = vk::StencilOp::eKeep, depthFail = vk::StencilOp::eKeep, pass = vk::StencilOp::eKeep;
    };
    /// Stencil state; the default of a pass is no test and no change.
    void stencil(vk::StencilFaceFlags faces, const Stencil& state) {
        commands.setStencilOp(faces, state.fail, state.pass, state.depthFail, state.compare);
    }
    template <typename T>
    void push(const T& constants) {
        static_assert(sizeof(T) <= 128 && std::is_trivially_copyable_v<T>);
        commands.pushConstants<T>(pipelines_.layout(),
                                  gpu::kStages,
                                  0, constants);
    }
    void draw(uint32_t vertices, uint32_t instances = 1, uint32_t firstVertex = 0, uint32_t firstInstance = 0) {
        count();
        commands.draw(vertices, instances, firstVertex, firstInstance);
    }
    void drawIndexed(uint32_t indices, uint32_t instances, uint32_t firstIndex, int32_t firstVertex, uint32_t firstInstance) {
        count();
        commands.drawIndexed(indices, instances, firstIndex, firstVertex, firstInstance);
    }
    /// One VkDrawIndexedIndirectCommand at `offset` bytes.
    void drawIndexedIndirect(BufferId arguments, vk::DeviceSize offset) {
        count();
        commands.drawIndexedIndirect(buffer(arguments), offset, 1, 0);
    }
    /// One VkDrawIndirectCommand at `offset` bytes.
    void drawIndirect(BufferId arguments, vk::DeviceSize offset) {
        count();
        commands.drawIndirect(buffer(arguments), offset, 1, 0);
    }
    /// One triangle that covers the target, for full_screen.vert.
    void drawFullScreen() { draw(3); }

    /// One dispatch of at least `groups` workgroups, in rows along x. Only in a pass without attachments.
    void dispatch(const char* shader, const std::vector<uint32_t>& constants, uint32_t groups) {
        constexpr uint32_t kRow = 65535;  // the most along x that every device takes
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipelines_.compute(shader, constants));
        commands.dispatch(std::min(groups, kRow), (groups + kRow - 1) / kRow, 1);
    }

    const DrawCounts& counts() const { return counts_; }

private:
    void requireDeclared(uint32_t resource) const {
        if (std::ranges::find(pass_.uses, resource, &Use::resource) == pass_.uses.end())
            throw std::logic_error("frame graph: pass " + pass_.name + " uses a resource that it did not declare");
    }

    void count() {
        ++counts_.draws;
        counts_.stencilDraws += marksStencil_;
    }

    gpu::Pipelines& pipelines_;
    const Executor& executor_;
    const Pass& pass_;
    std::vector<vk::Format> colors_;
    vk::Format depth_;
    ImageDesc target_;
    bool feedback_;
    DrawCounts counts_;
    bool marksStencil_ = false;
};

}  // namespace luciole::frame
