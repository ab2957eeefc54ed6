#include "render/shadow/shadow_maps.hpp"

#include <algorithm>

#include "frame/pass_context.hpp"
#include "render/gpu_scene.hpp"

namespace luciole::render {

using frame::Access;

namespace {

constexpr vk::Format kFormat = vk::Format::eD32Sfloat;
constexpr vk::ImageLayout kLayout = vk::ImageLayout::eDepthReadOnlyOptimal;
static_assert(sizeof(shared::ShadowMap) == 60 && sizeof(shared::ShadowPush) == 76);

}  // namespace

ShadowMaps::ShadowMaps(const gpu::Context& context) : context_(context) {
    atlas_ = makeAtlas("shadow atlas", {1, 1});
    maps_.update(context, "shadow maps", {}, sizeof(shared::ShadowMap));
}

gpu::Image ShadowMaps::makeAtlas(const char* name, vk::Extent2D extent) const {
    using Usage = vk::ImageUsageFlagBits;
    gpu::Image atlas = gpu::makeImage(context_, name,
                                      {.format = kFormat, .extent = extent, .usage = Usage::eDepthStencilAttachment | Usage::eSampled | Usage::eTransferSrc | Usage::eTransferDst});
    context_.runOnce([&](const vk::raii::CommandBuffer& commands) {
        const vk::ImageSubresourceRange all{vk::ImageAspectFlagBits::eDepth, 0, 1, 0, 1};
        gpu::transitionImage(commands, atlas, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
        commands.clearDepthStencilImage(*atlas.handle, vk::ImageLayout::eTransferDstOptimal, vk::ClearDepthStencilValue{0.0f, 0}, all);
        gpu::transitionImage(commands, atlas, vk::ImageLayout::eTransferDstOptimal, kLayout);
    });
    return atlas;
}

bool ShadowMaps::update(const ShadowPlan::Inputs& in, std::span<uint32_t> shadowedLights) {
    const auto wanted = [&] { return vk::Extent2D{plan_.extent().x, plan_.extent().y}; };
    if (wanted() != atlas_.extent || plan_.needsStill() != bool(*still_.handle)) plan_.forget();  // for the last frame there was no room for it
    plan_.update(in);
    bool changed = false;
    if (wanted().width > 0 && wanted() != atlas_.extent) {
        still_ = {};
        atlas_ = makeAtlas("shadow atlas", wanted());
        changed = true;
    }
    if (plan_.needsStill() != bool(*still_.handle)) {
        still_ = plan_.needsStill() ? makeAtlas("shadow atlas, still", atlas_.extent) : gpu::Image{};
        changed = true;
    }
    std::vector<shared::ShadowMap> maps;
    const dvec3 eye(in.view.camera.worldFromView[3]);
    for (const PlannedMap& map : plan_.maps()) {
        uint32_t& light = shadowedLights[map.light];
        if (light == 0) {
            light = uint32_t(maps.size()) << shared::kShadowCountBits | ShadowPlan::mapsOf(in.lights[map.light]);
            maps.resize(maps.size() + ShadowPlan::mapsOf(in.lights[map.light]));
        }
        maps[(light >> shared::kShadowCountBits) + map.face] = ShadowPlan::constants(map, in.lights[map.light].shadowSoftness, eye);
    }
    changed |= maps_.update(context_, "shadow maps", std::as_bytes(std::span(maps)), sizeof(shared::ShadowMap));
    return changed;
}

frame::ImageId ShadowMaps::import(frame::FrameGraph& graph) const {
    return graph.importImage("shadow-atlas", {kFormat, atlas_.extent}, *atlas_.handle, kLayout);
}

namespace {

/// Draws casters into a page.
void drawPage(frame::PassContext& pass, const GpuScene& scene, const PlannedMap& map, std::span<const uint32_t> casters, ShadowCasters faces, bool clear) {
    const auto side = map.page.side;
    const vk::Rect2D page{{int32_t(map.page.first.x), int32_t(map.page.first.y)}, {side, side}};
    pass.commands.setViewport(0, vk::Viewport{float(page.offset.x), float(page.offset.y), float(side), float(side), 0, 1});
    pass.commands.setScissor(0, page);
    if (clear) pass.commands.clearAttachments(vk::ClearAttachment{vk::ImageAspectFlagBits::eDepth, 0, vk::ClearDepthStencilValue{0.0f, 0}}, vk::ClearRect{page, 0, 1});
    scene.drawCasters(pass, ShadowPlan::push(map), casters, faces);
}

void setDepth(frame::PassContext& pass) {
    pass.depth(vk::CompareOp::eGreaterOrEqual, true);
    pass.commands.setDepthBiasEnable(true);
    pass.commands.setDepthBias(0, 0, -shared::kShadowSlopeBias);  // depth is reversed: away from the light is less
}

}  // namespace

void ShadowMaps::addPasses(frame::FrameGraph& graph, const GpuScene& scene, frame::ImageId atlas, ShadowCasters faces) const {
    if (*still_.handle) {
        const frame::ImageId still = graph.importImage("shadow-still", {kFormat, still_.extent}, *still_.handle, kLayout);
        graph.addPass("shadow.still").update(still, Access::depthWrite).record([this, &scene, faces](frame::PassContext& pass) {
            setDepth(pass);
            for (const uint32_t i : plan_.dirty())
                if (const PlannedMap& map = plan_.maps()[i]; map.stillDirty) drawPage(pass, scene, map, map.stillCasters, faces, true);
        });
        graph.addPass("shadow.copy").read(still, Access::transferRead).update(atlas, Access::transferWrite).record([this, still, atlas](frame::PassContext& pass) {
            std::vector<vk::ImageCopy> pages;
            for (const uint32_t i : plan_.dirty()) {
                const PlannedMap& map = plan_.maps()[i];
                if (!map.overStill) continue;
                const vk::ImageSubresourceLayers layer{vk::ImageAspectFlagBits::eDepth, 0, 0, 1};
                const vk::Offset3D at{int32_t(map.page.first.x), int32_t(map.page.first.y), 0};
                pages.push_back({layer, at, layer, at, {map.page.side, map.page.side, 1}});
            }
            if (!pages.empty())
                pass.commands.copyImage(pass.image(still), vk::ImageLayout::eTransferSrcOptimal, pass.image(atlas), vk::ImageLayout::eTransferDstOptimal, pages);
        });
    }
    graph.addPass("shadow.maps").update(atlas, Access::depthWrite).record([this, &scene, faces](frame::PassContext& pass) {
        setDepth(pass);
        for (const uint32_t i : plan_.dirty()) {
            const PlannedMap& map = plan_.maps()[i];
            drawPage(pass, scene, map, map.casters, faces, !map.overStill);
        }
    });
}

ShadowStats ShadowMaps::stats() const {
    ShadowStats stats = plan_.stats();
    stats.bytes = atlas_.bytes + still_.bytes;
    return stats;
}

}  // namespace luciole::render
