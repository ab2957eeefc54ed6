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
                const Pass& pass, std::vector<vk::Format> colors, vk::Format depth, vk::Extent2D extent)
        : commands(commandBuffer), pipelines_(pipelines), executor_(executor), pass_(pass), colors_(std::move(colors)), depth_(depth),
          extent_(extent) {}

    const vk::raii::CommandBuffer& commands;  ///< for whatever is not wrapped here
    vk::Extent2D extent() const { return extent_; }  ///< of the attachments; zero without any

    /// Handles of what the pass declared. \throws std::logic_error for anything else
    vk::Image image(ImageId id) const { return requireDeclared(id.index), executor_.image(id); }
    vk::Buffer buffer(BufferId id) const { return requireDeclared(id.index), executor_.buffer(id); }

    struct Draw {
        const char* vertex;
        const char* fragment = "";
        bool meshVertices = false;
        bool additive = false;
        std::vector<uint32_t> constants = {};
    };
    void bind(const Draw& draw) {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics,
                              pipelines_.get({.vertex = draw.vertex, .fragment = draw.fragment, .meshVertices = draw.meshVertices,
                                              .additive = draw.additive, .constants = draw.constants, .colors = colors_, .depth = depth_}));
    }
    void bindSet(uint32_t set, vk::DescriptorSet handle) {
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, pipelines_.layout(), set, handle, nullptr);
    }
    /// Depth state; the default of a pass is no test and no write.
    void depth(vk::CompareOp compare, bool write) {
        commands.setDepthTestEnable(true);
        commands.setDepthWriteEnable(write);
        commands.setDepthCompareOp(compare);
    }
    template <typename T>
    void push(const T& constants) {
        static_assert(sizeof(T) <= 128 && std::is_trivially_copyable_v<T>);
        commands.pushConstants<T>(pipelines_.layout(),
                                  gpu::kStages,
                                  0, constants);
    }
    /// One triangle that covers the target, for full_screen.vert.
    void drawFullScreen() { commands.draw(3, 1, 0, 0); }

private:
    void requireDeclared(uint32_t resource) const {
        if (std::ranges::find(pass_.uses, resource, &Use::resource) == pass_.uses.end())
            throw std::logic_error("frame graph: pass " + pass_.name + " uses a resource that it did not declare");
    }

    gpu::Pipelines& pipelines_;
    const Executor& executor_;
    const Pass& pass_;
    std::vector<vk::Format> colors_;
    vk::Format depth_;
    vk::Extent2D extent_;
};

}  // namespace luciole::frame
