#include "render/shadow/shadow_volumes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <luciole/error.hpp>
#include <ranges>

#include "frame/pass_context.hpp"
#include "render/lighting/light_volume.shared.h"
#include "render/shadow/mesh_edges.hpp"
#include "render/shadow/seen_space.hpp"
#include "render/shadow/shadow_volume.shared.h"

namespace luciole::render {

using frame::Access;

namespace {

static_assert(sizeof(Vertex) == 4 * shared::kVertexFloats);
// Near caps lie where the surfaces are that cast; pushed behind them by some rounding they hide none of these.
constexpr float kCapBias = 4;  // least steps of depth

/// What a buffer on the device holds.
std::vector<std::byte> readBack(const gpu::Context& context, const gpu::Buffer& buffer) {
    gpu::MappedBuffer staging(context, "staging", buffer.bytes, vk::BufferUsageFlagBits::eTransferDst, gpu::Residence::hostCached);
    context.runOnce([&](const vk::raii::CommandBuffer& commands) {
        commands.copyBuffer(*buffer.handle, staging.handle(), vk::BufferCopy{.size = buffer.bytes});
        const vk::MemoryBarrier2 visible{.srcStageMask = vk::PipelineStageFlagBits2::eTransfer,
                                         .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                         .dstStageMask = vk::PipelineStageFlagBits2::eHost,
                                         .dstAccessMask = vk::AccessFlagBits2::eHostRead};
        commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &visible});
    });
    const auto bytes = staging.read<std::byte>();
    return {bytes.begin(), bytes.end()};
}

}  // namespace

void ShadowVolumes::makeEdges(const Meshes& meshes) {
    const std::vector<std::byte> vertexBytes = readBack(context_, meshes.vertices), indexBytes = readBack(context_, meshes.indices);
    const auto* vertices = reinterpret_cast<const Vertex*>(vertexBytes.data());
    const auto* indices = reinterpret_cast<const uint32_t*>(indexBytes.data());
    std::vector<uvec2> edges;
    edgeRanges_.clear();
    for (const Meshes::Range& range : meshes.ranges) {
        const std::span<const uint32_t> own(indices + range.firstIndex, range.indexCount);
        std::vector<vec3> positions(own.empty() ? 0 : std::ranges::max(own) + 1);
        for (size_t i = 0; i < positions.size(); ++i) positions[i] = vertices[range.firstVertex + i].position;
        const std::vector<uvec2> found = edgesOf(positions, own);
        edgeRanges_.push_back({uint32_t(edges.size()), uint32_t(found.size())});
        edges.insert(edges.end(), found.begin(), found.end());
    }
    edges_ = gpu::uploadBuffer(context_, "edges", edges, vk::BufferUsageFlagBits::eStorageBuffer);
}

bool ShadowVolumes::update(const ShadowPlan::Inputs& in, const Meshes& meshes, std::span<uint32_t> shadowedLights) {
    if (edgeRanges_.empty()) makeEdges(meshes);
    stats_ = {};
    hidden_.clear();
    const SeenSpace seen(in.view);
    const uint64_t maskBytes = 4 * uint64_t(in.view.extent.x) * in.view.extent.y;  // for 32 lights
    const uint64_t memory = uint64_t(in.settings.shadowMemory) << 20, largest = context_.limits().maxStorageBufferRange;
    const uint64_t most = std::min(memory, largest) / maskBytes * 32;
    const double across = distance(dvec3(in.boundsWorld.low), dvec3(in.boundsWorld.high));
    double farthest = across;
    const auto hides = [&](const Light& light, const ShadowCaster& object) {
        if (!object.casts || !in.castsFor(light.linkGroup, object.objectId)) return false;
        const vec3 nearest = clamp(light.positionWorld, object.boundsWorld.low, object.boundsWorld.high);
        return light.type == LightType::directional || distance(nearest, light.positionWorld) < light.range;
    };
    struct Candidate {
        uint32_t light;
        double pixels;  // how large it is in the picture
    };
    std::vector<Candidate> candidates;
    for (uint32_t i = 0; i < in.lights.size(); ++i) {
        const Light& light = in.lights[i];
        if (!light.castsShadows || light.color == vec3(0)) continue;
        double pixels = HUGE_VAL;
        if (light.type != LightType::directional) {
            const bool spot = light.type == LightType::spot;
            const shared::LightShape shape{light.positionWorld, spot ? vec3(normalize(dvec3(light.directionWorld))) : vec3(0, 0, 1), light.range,
                                           spot ? light.outerConeAngle : shared::kHalfTurn};
            if (std::isfinite(light.range) && !seen.meets(dvec4(shared::boundingBall(shape)) * dvec4(1, 1, 1, 1.001))) continue;
            const double away = distance(light.positionWorld, 0.5f * (in.boundsWorld.low + in.boundsWorld.high));
            const double range = std::min<double>(light.range, away + 0.5 * across);
            farthest = std::max(farthest, away);
            pixels = range * seen.pixelsPerMetre(light.positionWorld, range);
        }
        if (std::ranges::any_of(in.casters, [&](const ShadowCaster& object) { return hides(light, object); })) candidates.push_back({i, pixels});
    }
    if (candidates.size() > most) {
        std::ranges::stable_sort(candidates, std::greater{}, &Candidate::pixels);
        const std::string where = memory <= largest ? fmt::format("{} MiB (shadow-memory)", in.settings.shadowMemory)
                                                    : fmt::format("{} bytes, the device's largest buffer", largest);
        for (const Candidate& without : candidates | std::views::drop(most) | std::views::reverse)
            stats_.lost.push_back({without.light, fmt::format("the masks of more than {} lights do not fit into {}", most, where)});
        candidates.resize(most);
        std::ranges::sort(candidates, {}, &Candidate::light);
    }
    for (const Candidate& candidate : candidates) {
        const Light& light = in.lights[candidate.light];
        Hidden hidden{.light = candidate.light,
                      .lightWorld = light.type == LightType::directional ? vec4(normalize(light.directionWorld), 0) : vec4(light.positionWorld, 1)};
        for (uint32_t caster = 0; caster < in.casters.size(); ++caster)
            if (hides(light, in.casters[caster])) hidden.casters.push_back(caster);
        hidden_.push_back(std::move(hidden));
    }
    if (in.settings.onOverflow == OnOverflow::fail && !stats_.lost.empty())
        throw Error(ErrorKind::limit, fmt::format("shadows: {} lights go without theirs, the first of them light {} \"{}\": {}", stats_.lost.size(), stats_.lost[0].light,
                                                  in.lights[stats_.lost[0].light].name, stats_.lost[0].reason));
    stats_.lights = stats_.drawn = uint32_t(hidden_.size());
    reach_ = in.view.camera.orthographic ? float(4 * farthest + 1) : 0;  // of directions at infinity it would see none
    words_ = std::max<uint32_t>(1, (uint32_t(hidden_.size()) + 31) / 32);
    stats_.bytes = maskBytes * words_;
    for (uint32_t bit = 0; bit < hidden_.size(); ++bit) shadowedLights[hidden_[bit].light] = bit << shared::kShadowCountBits | shared::kShadowVolumes;
    if (stats_.bytes == mask_.bytes) return false;
    mask_ = gpu::makeBuffer(context_, "shadow mask", stats_.bytes, vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferDst);
    return true;
}

frame::BufferId ShadowVolumes::import(frame::FrameGraph& graph) const { return graph.importBuffer("shadow-mask", mask_.bytes, *mask_.handle); }

void ShadowVolumes::addPasses(frame::FrameGraph& graph, frame::BufferId mask, frame::ImageId depth, const Meshes& meshes) const {
    graph.addPass("shadow.mask").write(mask, Access::transferWrite).record([mask](frame::PassContext& pass) {
        pass.commands.fillBuffer(pass.buffer(mask), 0, VK_WHOLE_SIZE, 0);
    });
    auto pass = graph.addPass("shadow.volumes");
    pass.update(depth, Access::stencilWrite).update(mask, Access::fragmentStorageWrite, shared::kVolumeMask);
    const auto read = [&](const char* name, const gpu::Buffer& buffer, uint32_t slot) {
        pass.read(graph.importBuffer(name, buffer.bytes, *buffer.handle), Access::fragmentStorageRead, slot);
    };
    read("vertices", meshes.vertices, shared::kVolumeVertices);
    read("indices", meshes.indices, shared::kVolumeIndices);
    read("edges", edges_, shared::kVolumeEdges);
    read("objects", meshes.objects, shared::kVolumeObjects);
    pass.record([this, meshes](frame::PassContext& context) {
        const auto both = vk::StencilFaceFlagBits::eFrontAndBack;
        const auto volume = context.prepare({.vertex = "render/shadow/shadow_volume.vert", .depthClamp = reach_ > 0});
        const auto mark = context.prepare({.vertex = "render/shaders/full_screen.vert", .fragment = "render/shadow/shadow_volume_mark.frag"});
        context.commands.setCullMode(vk::CullModeFlagBits::eNone);
        context.commands.setStencilTestEnable(true);
        context.commands.setStencilReference(both, 0);
        context.commands.clearAttachments(vk::ClearAttachment{.aspectMask = vk::ImageAspectFlagBits::eStencil},
                                          vk::ClearRect{.rect = {{}, context.extent()}, .layerCount = 1});
        for (uint32_t bit = 0; bit < hidden_.size(); ++bit) {
            // What lies behind the surface is entered and left: the difference is how many volumes the surface is in.
            context.bind(volume);
            context.depth(vk::CompareOp::eGreater, false);
            context.commands.setDepthBiasEnable(true);
            context.commands.setDepthBias(-kCapBias, 0, 0);
            context.stencil(vk::StencilFaceFlagBits::eFront, {.depthFail = vk::StencilOp::eDecrementAndWrap});
            context.stencil(vk::StencilFaceFlagBits::eBack, {.depthFail = vk::StencilOp::eIncrementAndWrap});
            shared::ShadowVolumePush push{.lightWorld = hidden_[bit].lightWorld, .reach = reach_, .maskWords = words_, .light = bit};
            for (const uint32_t caster : hidden_[bit].casters) {
                const uint32_t mesh = meshes.meshOfObject[caster];
                push.object = caster;
                push.firstIndex = meshes.ranges[mesh].firstIndex;
                push.firstVertex = meshes.ranges[mesh].firstVertex;
                push.triangles = meshes.ranges[mesh].indexCount / 3;
                push.firstEdge = edgeRanges_[mesh].first;
                context.push(push);
                context.draw(shared::shadowVolumeVertices(push.triangles, edgeRanges_[mesh].count));
            }
            context.bind(mark);
            context.push(push);
            context.commands.setDepthBiasEnable(false);
            context.commands.setDepthTestEnable(false);
            context.stencil(both, {.compare = vk::CompareOp::eNotEqual, .pass = vk::StencilOp::eZero});
            context.drawFullScreen();
        }
    });
}

}  // namespace luciole::render
