#include "frame/hazards.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace luciole::frame;

namespace {

constexpr ImageDesc kColor{vk::Format::eR32G32B32A32Sfloat, {64, 32}};
const auto kClear = vk::ClearColorValue(0.0f, 0.0f, 0.0f, 0.0f);

/// write a; blend a (write-after-write); sample a (read-after-write); overwrite a (write-after-read); copy a.
struct Fixture {
    FrameGraph graph;
    ImageId a = graph.createImage("a", kColor), b = graph.createImage("b", kColor);
    CompiledGraph compiled;
    Fixture() {
        graph.addPass("first").clear(a, Access::colorWrite, kClear);
        graph.addPass("blend").update(a, Access::colorBlend);
        graph.addPass("sample").read(a, Access::fragmentSampled, 0).clear(b, Access::colorWrite, kClear);
        graph.addPass("again").read(b, Access::fragmentSampled, 0).clear(a, Access::colorWrite, kClear);
        const BufferId result = graph.createBuffer("result", 64);
        graph.addPass("copy").read(a, Access::transferRead).write(result, Access::transferWrite);
        graph.output(result);
        compiled = graph.compile();
        REQUIRE(compiled.passes.size() == 5);
    }
    Barrier& barrier(size_t pass) {
        for (Barrier& candidate : compiled.passes[pass].barriers)
            if (candidate.resource == a.index) return candidate;
        throw std::logic_error("no barrier");
    }
    bool finds(const std::string& text) {
        for (const std::string& hazard : findHazards(graph, compiled))
            if (hazard.find(text) != std::string::npos) return true;
        return false;
    }
};

}  // namespace

TEST_CASE("hazards: what the graph compiles has none") {
    Fixture fixture;
    CHECK(findHazards(fixture.graph, fixture.compiled).empty());
}

TEST_CASE("hazards: without its barrier each kind is found, with both passes and the resource") {
    Fixture fixture;
    const auto weaken = [&](size_t pass) { fixture.barrier(pass).srcStages = vk::PipelineStageFlagBits2::eNone; };
    SUBCASE("write after write") {
        weaken(1);
        CHECK(fixture.finds("write-after-write hazard on a between passes first and blend"));
    }
    SUBCASE("read after write") {
        weaken(2);
        CHECK(fixture.finds("read-after-write hazard on a between passes blend and sample"));
    }
    SUBCASE("write after read") {
        weaken(3);
        CHECK(fixture.finds("write-after-read hazard on a between passes sample and again"));
    }
}

TEST_CASE("hazards: an execution barrier alone does not make a write visible") {
    Fixture fixture;
    SUBCASE("not flushed") { fixture.barrier(2).srcAccess = {}; }
    SUBCASE("not invalidated") { fixture.barrier(2).dstAccess = {}; }
    SUBCASE("visible to another kind of access only") { fixture.barrier(2).dstAccess = vk::AccessFlagBits2::eUniformRead; }
    CHECK(fixture.finds("read-after-write hazard on a between passes blend and sample"));
}

TEST_CASE("hazards: the wrong stage does not wait") {
    Fixture fixture;
    fixture.barrier(2).dstStages = vk::PipelineStageFlagBits2::eComputeShader;
    CHECK(fixture.finds("read-after-write hazard on a between passes blend and sample"));
}

TEST_CASE("hazards: an image in the wrong layout is found") {
    Fixture fixture;
    fixture.barrier(2).newLayout = vk::ImageLayout::eGeneral;
    CHECK(fixture.finds("layout of a in pass sample"));
}

TEST_CASE("hazards: a layout transition that does not wait for an earlier reader is found") {
    FrameGraph graph;
    const ImageId a = graph.createImage("a", kColor), b = graph.createImage("b", kColor);
    graph.addPass("write").clear(a, Access::colorWrite, kClear);
    graph.addPass("sample").read(a, Access::fragmentSampled, 0).clear(b, Access::colorWrite, kClear);
    for (const ImageId image : {a, b}) {
        const BufferId result = graph.createBuffer("result", 64);
        graph.addPass("copy").read(image, Access::transferRead).write(result, Access::transferWrite);
        graph.output(result);
    }
    CompiledGraph compiled = graph.compile();
    compiled.passes[2].barriers.at(0).srcStages = vk::PipelineStageFlagBits2::eColorAttachmentOutput;  // the writer only
    const auto hazards = findHazards(graph, compiled);
    REQUIRE(!hazards.empty());
    CHECK(hazards.front() == "the layout transition of a before pass copy does not wait for pass sample");
}

TEST_CASE("hazards: a barrier that discards what is needed is found") {
    Fixture fixture;
    fixture.barrier(2).oldLayout = vk::ImageLayout::eUndefined;
    CHECK(fixture.finds("content of a is needed by pass sample and was discarded"));
}

TEST_CASE("hazards: an output that the host could read too early is found") {
    Fixture fixture;
    fixture.compiled.finalBarriers.clear();
    CHECK(fixture.finds("read-after-write hazard on result between passes copy and host"));
}

TEST_CASE("hazards: visibility to one stage and to another access do not add up") {
    Fixture fixture;
    const Barrier whole = fixture.barrier(2);
    Barrier wrongAccess = whole, wrongStage = whole;
    wrongAccess.dstAccess = vk::AccessFlagBits2::eUniformRead;
    wrongStage.dstStages = vk::PipelineStageFlagBits2::eComputeShader;
    wrongStage.oldLayout = wrongStage.newLayout;
    fixture.barrier(2) = wrongAccess;
    fixture.compiled.passes[2].barriers.push_back(wrongStage);
    CHECK(fixture.finds("read-after-write hazard on a between passes blend and sample"));
}

TEST_CASE("hazards: somebody else's image, read before he is done or left to him too early, is found") {
    FrameGraph graph;
    const ImageId his = graph.importImage("his", kColor, vk::Image(VkImage(1)), vk::ImageLayout::eGeneral), b = graph.createImage("b", kColor);
    graph.addPass("sample").read(his, Access::fragmentSampled, 0).clear(b, Access::colorWrite, kClear);
    graph.output(b, Access::fragmentSampled);
    CompiledGraph compiled = graph.compile();
    const auto finds = [&](const std::string& text) {
        for (const std::string& hazard : findHazards(graph, compiled))
            if (hazard.find(text) != std::string::npos) return true;
        return false;
    };
    const auto onHis = [&](std::vector<Barrier>& barriers) { return std::ranges::find(barriers, his.index, &Barrier::resource); };
    CHECK_FALSE(finds("his"));
    SUBCASE("too early") {
        onHis(compiled.passes[0].barriers)->srcStages = vk::PipelineStageFlagBits2::eNone;
        CHECK(finds("read-after-write hazard on his between passes outside and sample"));
    }
    SUBCASE("left too early") {
        onHis(compiled.finalBarriers)->srcStages = vk::PipelineStageFlagBits2::eNone;
        CHECK(finds("write-after-read hazard on his between passes sample and outside"));
    }
    SUBCASE("left in another layout") {
        onHis(compiled.finalBarriers)->newLayout = vk::ImageLayout::eShaderReadOnlyOptimal;
        CHECK(finds("layout of his in pass outside"));
    }
    SUBCASE("an output left without its barrier") {
        compiled.finalBarriers.clear();
        CHECK(finds("read-after-write hazard on b between passes sample and outside"));
    }
}
