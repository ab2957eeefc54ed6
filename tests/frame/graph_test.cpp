#include "frame/graph.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace luciole::frame;

namespace {

constexpr ImageDesc kColor{vk::Format::eR32G32B32A32Sfloat, {64, 32}};
constexpr ImageDesc kDepth{vk::Format::eD32Sfloat, {64, 32}};
const auto kClear = vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f);
const auto kFar = vk::ClearDepthStencilValue{0.0f, 0};

/// Adds a pass that copies `image` to an output buffer, so that what leads to it matters.
BufferId addOutput(FrameGraph& graph, ImageId image) {
    const BufferId buffer = graph.createBuffer("result", 64);
    graph.addPass("copy").read(image, Access::transferRead).write(buffer, Access::transferWrite);
    graph.output(buffer);
    return buffer;
}

std::vector<std::string> namesOf(const FrameGraph& graph, const CompiledGraph& compiled) {
    std::vector<std::string> names;
    for (const auto& pass : compiled.passes) names.push_back(graph.passes()[pass.pass].name);
    return names;
}

const Barrier& barrierOn(const CompiledPass& pass, uint32_t resource) {
    const auto found = std::ranges::find(pass.barriers, resource, &Barrier::resource);
    REQUIRE(found != pass.barriers.end());
    return *found;
}

}  // namespace

TEST_CASE("frame graph: a pass whose result nobody reads is dropped, and so is what only it needed") {
    FrameGraph graph;
    const ImageId wanted = graph.createImage("wanted", kColor), unwanted = graph.createImage("unwanted", kColor);
    const ImageId source = graph.createImage("source", kColor);
    graph.addPass("source").clear(source, Access::colorWrite, kClear);
    graph.addPass("unwanted").read(source, Access::fragmentSampled, 0).clear(unwanted, Access::colorWrite, kClear);
    graph.addPass("wanted").clear(wanted, Access::colorWrite, kClear);
    addOutput(graph, wanted);
    const CompiledGraph compiled = graph.compile();
    CHECK(namesOf(graph, compiled) == std::vector<std::string>{"wanted", "copy"});
    CHECK_FALSE(compiled.used[source.index]);
    CHECK_FALSE(compiled.used[unwanted.index]);
}

TEST_CASE("frame graph: a pass whose result is overwritten before anyone reads it is dropped") {
    FrameGraph graph;
    const ImageId image = graph.createImage("image", kColor);
    graph.addPass("lost").clear(image, Access::colorWrite, kClear);
    graph.addPass("kept").clear(image, Access::colorWrite, kClear);
    graph.addPass("blended").update(image, Access::colorBlend);
    addOutput(graph, image);
    CHECK(namesOf(graph, graph.compile()) == std::vector<std::string>{"kept", "blended", "copy"});
}

TEST_CASE("frame graph: attachment write to texture read gets one barrier with both stages, masks and layouts") {
    FrameGraph graph;
    const ImageId a = graph.createImage("a", kColor), b = graph.createImage("b", kColor);
    graph.addPass("write").clear(a, Access::colorWrite, kClear);
    graph.addPass("read").read(a, Access::fragmentSampled, 0).clear(b, Access::colorWrite, kClear);
    addOutput(graph, b);
    const CompiledGraph compiled = graph.compile();
    const Barrier& barrier = barrierOn(compiled.passes[1], a.index);
    CHECK(barrier.srcStages == vk::PipelineStageFlagBits2::eColorAttachmentOutput);
    CHECK(barrier.srcAccess == vk::AccessFlagBits2::eColorAttachmentWrite);
    CHECK(barrier.dstStages == vk::PipelineStageFlagBits2::eFragmentShader);
    CHECK(barrier.dstAccess == vk::AccessFlagBits2::eShaderSampledRead);
    CHECK(barrier.oldLayout == vk::ImageLayout::eColorAttachmentOptimal);
    CHECK(barrier.newLayout == vk::ImageLayout::eShaderReadOnlyOptimal);
}

TEST_CASE("frame graph: readers of one layout share one barrier, whatever their stages") {
    FrameGraph graph;
    const ImageId image = graph.createImage("image", kColor);
    const BufferId a = graph.createBuffer("a", 4), b = graph.createBuffer("b", 4);
    const ImageId target = graph.createImage("target", kColor);
    graph.addPass("write").clear(image, Access::colorWrite, kClear);
    graph.addPass("fragment").read(image, Access::fragmentSampled, 0).clear(target, Access::colorWrite, kClear);
    graph.addPass("compute").read(image, Access::computeSampled, 0).write(a, Access::transferWrite);
    graph.output(a);
    graph.addPass("copy").read(target, Access::transferRead).write(b, Access::transferWrite);
    graph.output(b);
    const CompiledGraph compiled = graph.compile();
    CHECK(barrierOn(compiled.passes[1], image.index).dstStages ==
          (vk::PipelineStageFlagBits2::eFragmentShader | vk::PipelineStageFlagBits2::eComputeShader));
    CHECK(std::ranges::count(compiled.passes[2].barriers, image.index, &Barrier::resource) == 0);
}

TEST_CASE("frame graph: depth that is tested and sampled in one pass stays in the read-only depth layout") {
    FrameGraph graph;
    const ImageId depth = graph.createImage("depth", kDepth), color = graph.createImage("color", kColor);
    graph.addPass("geometry").clear(depth, Access::depthWrite, kFar);
    graph.addPass("light").read(depth, Access::depthTest).read(depth, Access::fragmentSampled, 0).clear(color, Access::colorWrite, kClear);
    addOutput(graph, color);
    const CompiledGraph compiled = graph.compile();
    const Barrier& barrier = barrierOn(compiled.passes[1], depth.index);
    CHECK(barrier.newLayout == vk::ImageLayout::eDepthReadOnlyOptimal);
    CHECK(bool(barrier.dstStages & vk::PipelineStageFlagBits2::eFragmentShader));
    CHECK(bool(barrier.dstStages & vk::PipelineStageFlagBits2::eEarlyFragmentTests));
}

TEST_CASE("frame graph: an output is made visible to the host after the last pass") {
    FrameGraph graph;
    const ImageId image = graph.createImage("image", kColor);
    graph.addPass("write").clear(image, Access::colorWrite, kClear);
    const BufferId result = addOutput(graph, image);
    const CompiledGraph compiled = graph.compile();
    REQUIRE(compiled.finalBarriers.size() == 1);
    CHECK(compiled.finalBarriers[0].resource == result.index);
    CHECK(compiled.finalBarriers[0].dstStages == vk::PipelineStageFlagBits2::eHost);
    CHECK(compiled.finalBarriers[0].srcAccess == vk::AccessFlagBits2::eTransferWrite);
}

TEST_CASE("frame graph: somebody else's image is found in his layout, and left in it when all passes have read it") {
    FrameGraph graph;
    const auto his = vk::ImageLayout::eDepthAttachmentOptimal;
    const ImageId depth = graph.importImage("depth", kDepth, vk::Image(VkImage(1)), his), color = graph.createImage("color", kColor);
    graph.addPass("light").read(depth, Access::depthTest).read(depth, Access::fragmentSampled, 0).clear(color, Access::colorWrite, kClear);
    addOutput(graph, color);
    const CompiledGraph compiled = graph.compile();
    const Barrier& before = barrierOn(compiled.passes[0], depth.index);
    CHECK(before.srcStages == vk::PipelineStageFlagBits2::eAllCommands);
    CHECK(before.srcAccess == vk::AccessFlagBits2::eMemoryWrite);
    CHECK(before.oldLayout == his);
    CHECK(before.newLayout == vk::ImageLayout::eDepthReadOnlyOptimal);
    const auto after = std::ranges::find(compiled.finalBarriers, depth.index, &Barrier::resource);
    REQUIRE(after != compiled.finalBarriers.end());
    CHECK(bool(after->srcStages & vk::PipelineStageFlagBits2::eFragmentShader));
    CHECK(after->dstStages == vk::PipelineStageFlagBits2::eAllCommands);
    CHECK(after->oldLayout == vk::ImageLayout::eDepthReadOnlyOptimal);
    CHECK(after->newLayout == his);
}

TEST_CASE("frame graph: a pass that changes somebody else's image is not dropped, one that only reads it is") {
    FrameGraph graph;
    const ImageId image = graph.importImage("image", kColor, vk::Image(VkImage(1)), vk::ImageLayout::eGeneral), color = graph.createImage("color", kColor);
    graph.addPass("changes").update(image, Access::colorBlend);
    graph.addPass("reads").read(image, Access::fragmentSampled, 0).clear(color, Access::colorWrite, kClear);
    CHECK(namesOf(graph, graph.compile()) == std::vector<std::string>{"changes"});
}

TEST_CASE("frame graph: an image that is an output is left as the commands that follow read it") {
    FrameGraph graph;
    const ImageId image = graph.createImage("image", kColor);
    graph.addPass("write").clear(image, Access::colorWrite, kClear);
    graph.output(image, Access::fragmentSampled);
    const CompiledGraph compiled = graph.compile();
    REQUIRE(compiled.finalBarriers.size() == 1);
    CHECK(compiled.finalBarriers[0].dstStages == vk::PipelineStageFlagBits2::eFragmentShader);
    CHECK(compiled.finalBarriers[0].newLayout == vk::ImageLayout::eShaderReadOnlyOptimal);
    CHECK_THROWS_WITH(graph.output(image, Access::hostRead), doctest::Contains("image: host read of an output"));
    CHECK_THROWS_WITH(graph.output(image, Access::colorWrite), doctest::Contains("image: color write of an output"));
}

TEST_CASE("frame graph: misuse throws and names the pass and the resource") {
    FrameGraph graph;
    const ImageId image = graph.createImage("image", kColor), target = graph.createImage("target", kColor);
    SUBCASE("a read before anything wrote it") {
        graph.addPass("early").read(image, Access::fragmentSampled, 0).clear(target, Access::colorWrite, kClear);
        addOutput(graph, target);
        CHECK_THROWS_WITH(graph.compile(), doctest::Contains("pass early: image: used before anything was written to it"));
    }
    SUBCASE("two layouts in one pass") {
        graph.addPass("write").clear(image, Access::colorWrite, kClear);
        graph.addPass("both").read(image, Access::fragmentSampled, 0).update(image, Access::colorBlend);
        addOutput(graph, image);
        CHECK_THROWS_WITH(graph.compile(), doctest::Contains("pass both: image: expected one layout"));
    }
    SUBCASE("a write declared as a read") {
        CHECK_THROWS_WITH(graph.addPass("wrong").read(image, Access::colorWrite), doctest::Contains("pass wrong: image: color write declared as a read"));
    }
    SUBCASE("an attachment access to a buffer") {
        const BufferId buffer = graph.createBuffer("buffer", 4);
        CHECK_THROWS_WITH(graph.addPass("wrong").update(buffer, Access::colorBlend), doctest::Contains("not for buffers"));
    }
    SUBCASE("blending over nothing") {
        CHECK_THROWS_WITH(graph.addPass("wrong").write(image, Access::colorBlend), doctest::Contains("color blend needs what is there"));
    }
    SUBCASE("a texture without its slot, or in a slot that is none") {
        CHECK_THROWS_WITH(graph.addPass("wrong").read(image, Access::fragmentSampled), doctest::Contains("expected a slot"));
        CHECK_THROWS_WITH(graph.addPass("wrong").read(image, Access::fragmentSampled, 16), doctest::Contains("expected a slot"));
        const BufferId list = graph.createBuffer("list", 64);
        CHECK_THROWS_WITH(graph.addPass("wrong").write(list, Access::computeStorageWrite), doctest::Contains("expected a slot"));
    }
    SUBCASE("attachments of two sizes") {
        const ImageId small = graph.createImage("small", {kColor.format, {8, 8}});
        graph.addPass("two").clear(image, Access::colorWrite, kClear).clear(small, Access::colorWrite, kClear);
        addOutput(graph, image);
        CHECK_THROWS_WITH(graph.compile(), doctest::Contains("pass two: small: expected the size of image, 64x32, found 8x8"));
    }
    SUBCASE("a handle that nothing made") {
        CHECK_THROWS_WITH(graph.addPass("wrong").read(ImageId{}, Access::transferRead), doctest::Contains("pass wrong"));
    }
    SUBCASE("an output that nobody writes") {
        graph.output(graph.createBuffer("nothing", 4));
        CHECK_THROWS_WITH(graph.compile(), doctest::Contains("nothing: an output that no pass writes"));
    }
}

TEST_CASE("frame graph: a pass that updates keeps what was written before it, one that writes does not") {
    for (const bool updates : {true, false}) {
        FrameGraph graph;
        const BufferId list = graph.createBuffer("list", 64);
        graph.addPass("first").write(list, Access::transferWrite);
        auto second = graph.addPass("second");
        updates ? second.update(list, Access::transferWrite) : second.write(list, Access::transferWrite);
        graph.output(list);
        CHECK(graph.compile().passes.size() == (updates ? 2 : 1));
    }
}

TEST_CASE("frame graph: compute may be the first to write") {
    FrameGraph graph;
    const BufferId list = graph.createBuffer("list", 64);
    graph.addPass("build").write(list, Access::computeStorageWrite, 0);
    graph.output(list);
    CHECK(graph.compile().passes.size() == 1);
}

TEST_CASE("frame graph: a depth buffer with a stencil is sampled, tested and marked in one layout") {
    FrameGraph graph;
    const ImageId depth = graph.createImage("depth", {vk::Format::eD32SfloatS8Uint, kColor.extent});
    const ImageId color = graph.createImage("color", kColor);
    graph.addPass("geometry").clear(depth, Access::depthWrite, vk::ClearDepthStencilValue{0, 0});
    graph.addPass("marks").read(depth, Access::fragmentSampled, 0).update(depth, Access::stencilWrite).clear(color, Access::colorWrite, kClear);
    graph.addPass("tests").read(depth, Access::fragmentSampled, 0).read(depth, Access::depthTest).update(color, Access::colorBlend);
    addOutput(graph, color);
    const CompiledGraph compiled = graph.compile();
    const auto layout = vk::ImageLayout::eDepthReadOnlyStencilAttachmentOptimal;
    for (const size_t pass : {1, 2}) {
        const auto barrier = std::ranges::find(compiled.passes[pass].barriers, depth.index, &Barrier::resource);
        REQUIRE(barrier != compiled.passes[pass].barriers.end());
        CHECK(barrier->newLayout == layout);
        CHECK(barrier->oldLayout == (pass == 1 ? vk::ImageLayout::eDepthStencilAttachmentOptimal : layout));
        CHECK(bool(barrier->srcAccess & vk::AccessFlagBits2::eDepthStencilAttachmentWrite));
    }
}

TEST_CASE("frame graph: what compute writes reaches tables and the arguments of draws") {
    FrameGraph graph;
    const BufferId table = graph.importBuffer("table", 64, {}), arguments = graph.createBuffer("arguments", 64);
    const ImageId color = graph.createImage("color", kColor);
    graph.addPass("build").write(table, Access::computeStorageWrite, 0).write(arguments, Access::computeStorageWrite, 1);
    graph.addPass("draw").read(table, Access::tableRead).read(arguments, Access::indirectRead).clear(color, Access::colorWrite, kClear);
    addOutput(graph, color);
    const CompiledGraph compiled = graph.compile();
    const auto& barriers = compiled.passes[1].barriers;
    const auto to = [&](BufferId buffer) { return std::ranges::find(barriers, buffer.index, &Barrier::resource)->dstStages; };
    CHECK(bool(to(table) & vk::PipelineStageFlagBits2::eVertexShader));
    CHECK(bool(to(table) & vk::PipelineStageFlagBits2::eFragmentShader));
    CHECK(to(arguments) == vk::PipelineStageFlagBits2::eDrawIndirect);
}

TEST_CASE("frame graph: what an imported buffer holds is read without a pass that wrote it, and without a barrier") {
    FrameGraph graph;
    const BufferId table = graph.importBuffer("table", 64, vk::Buffer(VkBuffer(uintptr_t(1))));
    const ImageId color = graph.createImage("color", kColor);
    graph.addPass("draw").read(table, Access::tableRead).clear(color, Access::colorWrite, kClear);
    graph.addPass("change").update(table, Access::computeStorageWrite, 0);
    graph.addPass("draw more").read(table, Access::tableRead).update(color, Access::colorBlend);
    addOutput(graph, color);
    const CompiledGraph compiled = graph.compile();
    const auto barriers = [&](size_t pass) { return std::ranges::count(compiled.passes[pass].barriers, table.index, &Barrier::resource); };
    CHECK(barriers(0) == 0);
    CHECK(barriers(1) == 1);
    CHECK(barriers(2) == 1);
}

TEST_CASE("frame graph: the drawing names passes, resources with sizes, and notes") {
    FrameGraph graph;
    const ImageId image = graph.createImage("radiance", kColor);
    graph.addPass("lighting").clear(image, Access::colorWrite, kClear);
    addOutput(graph, image);
    const std::string dot = toDot(graph, graph.compile(), {"1.50 ms"});
    CHECK(dot.find("lighting\\n1.50 ms") != std::string::npos);
    CHECK(dot.find("radiance\\nR32G32B32A32Sfloat 64x32\\n0.03 MiB") != std::string::npos);
    CHECK(dot.find("p0 -> r0 [label=\"color write\"]") != std::string::npos);
}
