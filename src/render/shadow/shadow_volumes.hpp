#pragma once
#include "frame/graph.hpp"
#include "gpu/resources.hpp"
#include "render/shadow/shadow_plan.hpp"

namespace luciole::render {

/// Stencil shadow volumes: z-fail with caps at infinity (Everitt and Kilgard 2002; Calver 2003, "Shadows": "the same as a conventional
/// renderer"). One light after the other marks the stencil, which becomes a bit of each pixel's mask; lighting asks the mask.
class ShadowVolumes {
public:
    /// What the volumes of the meshes are made of, as GpuScene has it.
    struct Meshes {
        struct Range {
            uint32_t firstIndex, indexCount, firstVertex;
        };
        std::vector<Range> ranges;
        const gpu::Buffer &vertices, &indices, &objects;
        std::vector<uint32_t> meshOfObject;  ///< by place in the table of objects
    };

    explicit ShadowVolumes(const gpu::Context& context) : context_(context) {}

    /// Finds out which lights hide behind which objects. \param shadowedLights for each light zero, or what shaders know of its bit
    /// (shadow.shared.h): written
    /// \return whether the mask is another buffer than before
    /// \throws Error(limit) with on-overflow fail, for lights that go without a shadow
    bool update(const ShadowPlan::Inputs& in, const Meshes& meshes, std::span<uint32_t> shadowedLights);

    vk::Buffer mask() const { return *mask_.handle; }
    frame::BufferId import(frame::FrameGraph& graph) const;
    /// The passes "shadow.mask", which clears it, and "shadow.volumes". \param depth of the surfaces, with a stencil
    void addPasses(frame::FrameGraph& graph, frame::BufferId mask, frame::ImageId depth, const Meshes& meshes) const;

    uint32_t maskWords() const { return words_; }  ///< of each pixel's mask
    const ShadowStats& stats() const { return stats_; }

private:
    struct Hidden {
        uint32_t light;                 ///< index in Scene::lights
        vec4 lightWorld;
        std::vector<uint32_t> casters;  ///< places in the table of objects
    };
    struct EdgeRange {
        uint32_t first, count;
    };
    void makeEdges(const Meshes& meshes);

    const gpu::Context& context_;
    gpu::Buffer mask_, edges_;
    std::vector<EdgeRange> edgeRanges_;  ///< by mesh; empty until they are needed
    std::vector<Hidden> hidden_;         ///< the bits of the mask, in order
    float reach_ = 0;                   ///< of volumes, metres; 0: infinite
    uint32_t words_ = 1;                 ///< of a pixel's mask
    ShadowStats stats_;
};

}  // namespace luciole::render
