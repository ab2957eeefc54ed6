#pragma once
#include "frame/graph.hpp"
#include "gpu/resources.hpp"
#include "render/shadow/shadow_plan.hpp"

namespace luciole::render {

class GpuScene;

/// Shadow maps on the device: the atlas, and what shaders know of it. Kept from frame to frame.
class ShadowMaps {
public:
    explicit ShadowMaps(const gpu::Context& context);

    /// Plans the maps of a frame and tells shaders about them. \param shadowedLights for each light zero, or what shaders know of its maps
    /// (shadow.shared.h): written
    /// \return whether buffers or an atlas are others than before
    /// \throws as ShadowPlan::update
    bool update(const ShadowPlan::Inputs& in, std::span<uint32_t> shadowedLights);

    /// The atlas, which the frame's set names, for passes that light surfaces.
    frame::ImageId import(frame::FrameGraph& graph) const;
    /// The passes that draw what the plan says: "shadow.maps", and if some casters move, before it "shadow.still" and "shadow.copy".
    void addPasses(frame::FrameGraph& graph, const GpuScene& scene, frame::ImageId atlas, ShadowCasters faces) const;

    vk::Buffer maps() const { return maps_.handle(); }
    vk::ImageView atlas() const { return *atlas_.view; }
    /// What a frame graph knows of them.
    std::pair<vk::Image, vk::Image> images() const { return {*atlas_.handle, *still_.handle}; }
    /// What the plan wanted drawn was not.
    void forget() { plan_.forget(); }
    const ShadowPlan& plan() const { return plan_; }
    ShadowStats stats() const;

private:
    gpu::Image makeAtlas(const char* name, vk::Extent2D extent) const;

    const gpu::Context& context_;
    ShadowPlan plan_;
    gpu::Image atlas_;
    gpu::Image still_;  ///< what stands still, as far as it is drawn apart; null: nothing is
    gpu::Table maps_;
};

}  // namespace luciole::render
