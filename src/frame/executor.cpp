#include "frame/executor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "frame/pass_context.hpp"
#include "gpu/bindings.shared.h"

namespace luciole::frame {
Executor::Executor(const gpu::Context& context, gpu::Pipelines& pipelines, FrameGraph graph)
    : context_(context), pipelines_(pipelines), graph_(std::move(graph)), compiled_(graph_.compile()) {
    createResources();
    createPassSets();
    const auto passes = uint32_t(compiled_.passes.size());
    queries_ = vk::raii::QueryPool(context_.device(),
                                   {.queryType = vk::QueryType::eTimestamp, .queryCount = std::max(1u, passes + 1)});
    commandBuffers_ = vk::raii::CommandBuffers(context_.device(), {.commandPool = *context_.commandPool(),
                                                                   .level = vk::CommandBufferLevel::ePrimary,
                                                                   .commandBufferCount = 1});
}

void Executor::createResources() {
    for (uint32_t r = 0; r < graph_.resources().size(); ++r) {
        if (!compiled_.used[r]) continue;
        const Resource& resource = graph_.resources()[r];
        vk::ImageUsageFlags imageUsage;
        vk::BufferUsageFlags bufferUsage;
        for (const CompiledPass& compiled : compiled_.passes)
            for (const Use& use : graph_.passes()[compiled.pass].uses) {
                if (use.resource != r) continue;
                imageUsage |= infoOf(use.access).imageUsage;
                bufferUsage |= infoOf(use.access).bufferUsage;
            }
        if (resource.output) {
            imageUsage |= infoOf(*resource.output).imageUsage;
            bufferUsage |= infoOf(*resource.output).bufferUsage;
        }
        if (resource.importedImage)
            images_.emplace(r, gpu::viewImage(context_, resource.name, resource.importedImage, resource.image.format));
        else if (resource.isImage())
            images_.emplace(r, gpu::makeImage(context_, resource.name,
                                              {.format = resource.image.format, .extent = resource.image.extent, .usage = imageUsage, .samples = resource.image.samples}));
        else if (resource.imported)
            continue;
        else if (resource.output == Access::hostRead)
            hostBuffers_.emplace(r, gpu::MappedBuffer(context_, resource.name, resource.bufferBytes, bufferUsage, gpu::Residence::hostCached));
        else if (!resource.content.empty())
            buffers_.emplace(r, gpu::uploadBuffer(context_, resource.name, resource.content, bufferUsage));
        else
            buffers_.emplace(r, gpu::makeBuffer(context_, resource.name, resource.bufferBytes, bufferUsage));
    }
}

vk::Buffer Executor::bufferHandle(uint32_t resource) const {
    if (const vk::Buffer imported = graph_.resources()[resource].imported) return imported;
    const auto host = hostBuffers_.find(resource);
    return host != hostBuffers_.end() ? host->second.handle() : *buffers_.at(resource).handle;
}

vk::Image Executor::imageHandle(uint32_t resource) const {
    if (const vk::Image imported = graph_.resources()[resource].importedImage) return imported;
    return *images_.at(resource).handle;
}

void Executor::createPassSets() {
    const auto passes = uint32_t(compiled_.passes.size());
    if (passes == 0) return;
    const vk::DescriptorPoolSize sizes[] = {{vk::DescriptorType::eCombinedImageSampler, passes * shared::kPassSampledCount},
                                            {vk::DescriptorType::eStorageBuffer, passes * shared::kPassStorageCount}};
    pool_ = vk::raii::DescriptorPool(
        context_.device(), {.maxSets = passes, .poolSizeCount = uint32_t(std::size(sizes)), .pPoolSizes = sizes});
    passSets_ = gpu::allocateSets(context_, pool_, pipelines_.passSetLayout(), passes);
    for (uint32_t i = 0; i < passes; ++i)
        for (const Use& use : graph_.passes()[compiled_.passes[i].pass].uses) {
            if (use.binding == kNoBinding) continue;
            const Resource& resource = graph_.resources()[use.resource];
            vk::WriteDescriptorSet write{.dstSet = passSets_[i], .descriptorCount = 1};
            vk::DescriptorImageInfo image;
            vk::DescriptorBufferInfo buffer;
            if (resource.isImage()) {
                const gpu::Image& source = images_.at(use.resource);
                image = {.imageView = gpu::hasStencil(source.format) ? *source.depthView : *source.view,
                         .imageLayout = layoutOf(use.access, source.format)};
                write.setDstBinding(shared::kPassSampled + use.binding)
                    .setDescriptorType(vk::DescriptorType::eCombinedImageSampler)
                    .setPImageInfo(&image);
            } else {
                buffer.setBuffer(bufferHandle(use.resource)).setRange(VK_WHOLE_SIZE);
                write.setDstBinding(shared::kPassStorage + use.binding)
                    .setDescriptorType(vk::DescriptorType::eStorageBuffer)
                    .setPBufferInfo(&buffer);
            }
            context_.device().updateDescriptorSets(write, nullptr);
        }
}

void Executor::recordBarriers(const vk::raii::CommandBuffer& commands, const std::vector<Barrier>& barriers) const {
    std::vector<vk::ImageMemoryBarrier2> images;
    std::vector<vk::BufferMemoryBarrier2> buffers;
    for (const Barrier& barrier : barriers) {
        const Resource& resource = graph_.resources()[barrier.resource];
        if (resource.isImage())
            images.push_back({.srcStageMask = barrier.srcStages,
                              .srcAccessMask = barrier.srcAccess,
                              .dstStageMask = barrier.dstStages,
                              .dstAccessMask = barrier.dstAccess,
                              .oldLayout = barrier.oldLayout,
                              .newLayout = barrier.newLayout,
                              .image = imageHandle(barrier.resource),
                              .subresourceRange = {gpu::aspectOf(resource.image.format), 0, 1, 0, 1}});
        else
            buffers.push_back({.srcStageMask = barrier.srcStages,
                               .srcAccessMask = barrier.srcAccess,
                               .dstStageMask = barrier.dstStages,
                               .dstAccessMask = barrier.dstAccess,
                               .buffer = bufferHandle(barrier.resource),
                               .size = VK_WHOLE_SIZE});
    }
    if (images.empty() && buffers.empty()) return;
    commands.pipelineBarrier2({.bufferMemoryBarrierCount = uint32_t(buffers.size()),
                           .pBufferMemoryBarriers = buffers.data(),
                           .imageMemoryBarrierCount = uint32_t(images.size()),
                           .pImageMemoryBarriers = images.data()});
}

void Executor::timestamp(const vk::raii::CommandBuffer& commands, uint32_t query) const {
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *queries_, query);
    const vk::MemoryBarrier2 everything{
        .srcStageMask = vk::PipelineStageFlagBits2::eAllCommands,
        .srcAccessMask = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite,
        .dstStageMask = vk::PipelineStageFlagBits2::eAllCommands,
        .dstAccessMask = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite};
    commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &everything});
}

void Executor::recordPass(const vk::raii::CommandBuffer& commands, uint32_t index, vk::DescriptorSet frameSet) {
    const Pass& pass = graph_.passes()[compiled_.passes[index].pass];
    std::vector<vk::RenderingAttachmentInfo> colors;
    std::vector<vk::Format> colorFormats;
    vk::RenderingAttachmentInfo depth, stencil;
    vk::Format depthFormat = vk::Format::eUndefined;
    bool feedback = false;
    ImageDesc target;  // what all attachments have in common
    for (const Use& use : pass.uses) {
        if (!isAttachment(use.access)) continue;
        const Resource& resource = graph_.resources()[use.resource];
        target = resource.image;
        const vk::RenderingAttachmentInfo attachment{
            .imageView = *images_.at(use.resource).view,
            .imageLayout = layoutOf(use.access, resource.image.format),
            .loadOp = use.clear ? vk::AttachmentLoadOp::eClear : use.overwrites ? vk::AttachmentLoadOp::eDontCare : vk::AttachmentLoadOp::eLoad,
            .storeOp = infoOf(use.access).writes ? vk::AttachmentStoreOp::eStore : vk::AttachmentStoreOp::eNone,
            .clearValue = use.clear.value_or(vk::ClearValue{})};
        if (isDepthAttachment(use.access)) {
            depth = attachment;
            depthFormat = resource.image.format;
            if (gpu::hasStencil(depthFormat)) stencil = attachment;
            if (use.access == Access::stencilWrite) depth.storeOp = vk::AttachmentStoreOp::eNone;
        } else {
            feedback |= use.access == Access::colorFeedback;
            colors.push_back(attachment);
            colorFormats.push_back(resource.image.format);
        }
    }
    const vk::Extent2D extent = target.extent;
    const bool renders = extent.width != 0;
    const bool computes = std::ranges::any_of(
        pass.uses, [](const Use& use) { return bool(infoOf(use.access).stages & vk::PipelineStageFlagBits2::eComputeShader); });
    PassContext context(commands, pipelines_, *this, pass, colorFormats, depthFormat, target, feedback);
    if (renders || computes) {
        const auto point = renders ? vk::PipelineBindPoint::eGraphics : vk::PipelineBindPoint::eCompute;
        if (frameSet) commands.bindDescriptorSets(point, pipelines_.layout(), shared::kFrameSet, frameSet, nullptr);
        commands.bindDescriptorSets(point, pipelines_.layout(), shared::kPassSet, passSets_[index], nullptr);
    }
    if (renders) {
        commands.beginRendering({.renderArea = {{0, 0}, extent},
                                 .layerCount = 1,
                                 .colorAttachmentCount = uint32_t(colors.size()),
                                 .pColorAttachments = colors.data(),
                                 .pDepthAttachment = depth.imageView ? &depth : nullptr,
                                 .pStencilAttachment = stencil.imageView ? &stencil : nullptr});
        commands.setViewport(0, vk::Viewport{0, 0, float(extent.width), float(extent.height), 0, 1});
        commands.setScissor(0, vk::Rect2D{{0, 0}, extent});
        commands.setCullMode(vk::CullModeFlagBits::eNone);
        commands.setFrontFace(vk::FrontFace::eCounterClockwise);
        commands.setDepthTestEnable(false);
        commands.setDepthWriteEnable(false);
        commands.setDepthCompareOp(vk::CompareOp::eAlways);
        commands.setDepthBiasEnable(false);
        commands.setStencilTestEnable(false);
        context.stencil(vk::StencilFaceFlagBits::eFrontAndBack, {});
        commands.setStencilCompareMask(vk::StencilFaceFlagBits::eFrontAndBack, 0xff);
        commands.setStencilWriteMask(vk::StencilFaceFlagBits::eFrontAndBack, 0xff);
        commands.setStencilReference(vk::StencilFaceFlagBits::eFrontAndBack, 0);
    }
    if (pass.record) pass.record(context);
    if (renders) commands.endRendering();
    drawCounts_.push_back(context.counts());
}

void Executor::recordFirst(const vk::raii::CommandBuffer& commands, vk::DescriptorSet frameSet, uint32_t passes, bool measure) {
    drawCounts_.clear();
    if (measure) {
        commands.resetQueryPool(*queries_, 0, passes + 1);
        timestamp(commands, 0);
    }
    for (uint32_t i = 0; i < passes; ++i) {
        const std::string& name = graph_.passes()[compiled_.passes[i].pass].name;
        if (context_.labels()) commands.beginDebugUtilsLabelEXT({.pLabelName = name.c_str()});
        recordBarriers(commands, compiled_.passes[i].barriers);
        recordPass(commands, i, frameSet);
        if (context_.labels()) commands.endDebugUtilsLabelEXT();
        if (measure) timestamp(commands, i + 1);
    }
    if (passes == passCount()) recordBarriers(commands, compiled_.finalBarriers);
}

void Executor::submit(vk::DescriptorSet frameSet, uint32_t passes, bool measure) {
    const auto start = std::chrono::steady_clock::now();
    const auto& commands = commandBuffers_.front();
    commands.reset();  // an exception in the last frame may have left it half recorded
    commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    recordFirst(commands, frameSet, passes, measure);
    commands.end();
    recordMs_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    context_.submitAndWait(commands);
    passMs_.clear();
}

void Executor::runFirst(vk::DescriptorSet frameSet, uint32_t passes) { submit(frameSet, passes, false); }

void Executor::run(vk::DescriptorSet frameSet, bool measure) {
    const bool timed = measure && context_.timestampMask() != 0;
    submit(frameSet, passCount(), timed);
    if (!timed) return;
    const uint32_t count = passCount() + 1;
    const auto [result, ticks] = queries_.getResults<uint64_t>(0, count, count * sizeof(uint64_t), sizeof(uint64_t),
                                                               vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    for (uint32_t i = 0; i + 1 < count; ++i)
        passMs_.push_back(double((ticks[i + 1] - ticks[i]) & context_.timestampMask()) * double(context_.limits().timestampPeriod) * 1e-6);
}

std::vector<PassStats> Executor::stats() const {
    std::vector<PassStats> stats;
    for (uint32_t i = 0; i < compiled_.passes.size(); ++i) {
        const Pass& pass = graph_.passes()[compiled_.passes[i].pass];
        PassStats row{.name = pass.name};
        if (i < drawCounts_.size()) {
            row.draws = drawCounts_[i].draws;
            row.stencilDraws = drawCounts_[i].stencilDraws;
        }
        if (!passMs_.empty()) row.ms = passMs_[i];
        std::set<uint32_t> touched;
        for (const Use& use : pass.uses)
            if (touched.insert(use.resource).second) row.bytes += graph_.resources()[use.resource].bytes();
        stats.push_back(std::move(row));
    }
    return stats;
}

std::string Executor::dot() const {
    std::vector<std::string> notes;
    for (const double ms : passMs_) notes.push_back(fmt::format("{:.2f} ms", ms));
    return toDot(graph_, compiled_, notes);
}

}  // namespace luciole::frame
