#include "frame/access.hpp"

namespace luciole::frame {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Mask = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;
using ImageUse = vk::ImageUsageFlagBits;
using BufferUse = vk::BufferUsageFlagBits;

const vk::PipelineStageFlags2 kDepthStages = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
const vk::PipelineStageFlags2 kDrawStages = Stage::eVertexShader | Stage::eFragmentShader;

// In the order of enum Access.
const AccessInfo kTable[] = {
    {"color write", Stage::eColorAttachmentOutput, Mask::eColorAttachmentWrite, Layout::eColorAttachmentOptimal,
     ImageUse::eColorAttachment, {}, true},
    {"color blend", Stage::eColorAttachmentOutput, Mask::eColorAttachmentRead | Mask::eColorAttachmentWrite,
     Layout::eColorAttachmentOptimal, ImageUse::eColorAttachment, {}, true},
    {"color feedback", Stage::eColorAttachmentOutput | Stage::eFragmentShader, Mask::eColorAttachmentWrite | Mask::eShaderSampledRead,
     Layout::eAttachmentFeedbackLoopOptimalEXT, ImageUse::eColorAttachment | ImageUse::eSampled | ImageUse::eAttachmentFeedbackLoopEXT, {}, true},
    {"depth write", kDepthStages, Mask::eDepthStencilAttachmentRead | Mask::eDepthStencilAttachmentWrite,
     Layout::eDepthAttachmentOptimal, ImageUse::eDepthStencilAttachment, {}, true},
    {"depth test", kDepthStages, Mask::eDepthStencilAttachmentRead, Layout::eDepthReadOnlyOptimal,
     ImageUse::eDepthStencilAttachment, {}, false},
    {"stencil write", kDepthStages, Mask::eDepthStencilAttachmentRead | Mask::eDepthStencilAttachmentWrite,
     Layout::eDepthReadOnlyStencilAttachmentOptimal, ImageUse::eDepthStencilAttachment, {}, true},
    {"fragment sampled", Stage::eFragmentShader, Mask::eShaderSampledRead, Layout::eShaderReadOnlyOptimal, ImageUse::eSampled,
     {}, false},
    {"fragment storage read", kDrawStages, Mask::eShaderStorageRead, Layout::eGeneral, ImageUse::eStorage,
     BufferUse::eStorageBuffer, false},
    {"fragment storage write", Stage::eFragmentShader, Mask::eShaderStorageRead | Mask::eShaderStorageWrite, Layout::eGeneral, {},
     BufferUse::eStorageBuffer, true},
    {"table read", kDrawStages, Mask::eShaderStorageRead | Mask::eUniformRead, Layout::eUndefined, {},
     BufferUse::eStorageBuffer | BufferUse::eUniformBuffer, false},
    {"compute table read", Stage::eComputeShader, Mask::eShaderStorageRead | Mask::eUniformRead, Layout::eUndefined, {},
     BufferUse::eStorageBuffer | BufferUse::eUniformBuffer, false},
    {"table sampled", Stage::eFragmentShader, Mask::eShaderSampledRead, Layout::eShaderReadOnlyOptimal, ImageUse::eSampled, {}, false},
    {"indirect read", Stage::eDrawIndirect, Mask::eIndirectCommandRead, Layout::eUndefined, {}, BufferUse::eIndirectBuffer, false},
    {"compute sampled", Stage::eComputeShader, Mask::eShaderSampledRead, Layout::eShaderReadOnlyOptimal, ImageUse::eSampled,
     {}, false},
    {"compute storage read", Stage::eComputeShader, Mask::eShaderStorageRead, Layout::eGeneral, ImageUse::eStorage,
     BufferUse::eStorageBuffer, false},
    {"compute storage write", Stage::eComputeShader, Mask::eShaderStorageRead | Mask::eShaderStorageWrite, Layout::eGeneral,
     ImageUse::eStorage, BufferUse::eStorageBuffer, true},
    {"transfer read", Stage::eTransfer, Mask::eTransferRead, Layout::eTransferSrcOptimal, ImageUse::eTransferSrc,
     BufferUse::eTransferSrc, false},
    {"transfer write", Stage::eTransfer, Mask::eTransferWrite, Layout::eTransferDstOptimal, ImageUse::eTransferDst,
     BufferUse::eTransferDst, true},
    {"host read", Stage::eHost, Mask::eHostRead, Layout::eGeneral, {}, {}, false},
};
static_assert(std::size(kTable) == size_t(Access::hostRead) + 1);

}  // namespace

const AccessInfo& infoOf(Access access) { return kTable[size_t(access)]; }

bool isDepthAttachment(Access access) {
    return access == Access::depthWrite || access == Access::depthTest || access == Access::stencilWrite;
}

bool isAttachment(Access access) {
    return access == Access::colorWrite || access == Access::colorBlend || access == Access::colorFeedback || isDepthAttachment(access);
}

vk::ImageLayout layoutOf(Access access, vk::Format format) {
    const bool sampled = access == Access::fragmentSampled || access == Access::computeSampled || access == Access::tableSampled;
    if (format == vk::Format::eD32SfloatS8Uint) {
        if (access == Access::depthWrite) return Layout::eDepthStencilAttachmentOptimal;
        if (sampled || isDepthAttachment(access)) return Layout::eDepthReadOnlyStencilAttachmentOptimal;
    }
    return sampled && format == vk::Format::eD32Sfloat ? Layout::eDepthReadOnlyOptimal : infoOf(access).layout;
}

vk::AccessFlags2 writesOf(vk::AccessFlags2 access) {
    return access & (Mask::eColorAttachmentWrite | Mask::eDepthStencilAttachmentWrite | Mask::eShaderStorageWrite |
                     Mask::eTransferWrite | Mask::eHostWrite | Mask::eMemoryWrite);
}

}  // namespace luciole::frame
