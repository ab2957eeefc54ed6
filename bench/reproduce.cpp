#include "reproduce.hpp"

#include <fmt/format.h>

#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>

#include "sample.hpp"

namespace luciole::bench {
namespace {

using Progress = std::function<void(double)>;

std::vector<Measured> measureHall(Renderer& renderer, uint32_t lights, double overlap, uvec2 extent, const std::vector<Contender>& contenders,
                                  const Effort& effort, const Progress& progress) {
    const Scene scene = loadScene(fmt::format("builtin:hall?lights={}&overlap={}&triangles=40000&seed=1", lights, overlap));
    renderer.setScene(scene);
    return measure(renderer, {scene.cameras.at(0), extent}, contenders, effort, progress);
}

/// Sums of a frame's passes, but for those that only find out what a packing lost, which nobody else does.
Sample frameOf(const Measured& measured) {
    std::vector<double> sums(measured.passesMs.size(), 0);
    for (const MeasuredPass& pass : measured.passes)
        if (!pass.name.ends_with(".lost"))
            for (size_t i = 0; i < pass.ms.size(); ++i) sums[i] += pass.ms[i];
    return sampleOf(sums);
}

Ratio ratio(std::string what, std::string published, const Sample& a, const Sample& b) {
    return {std::move(what), std::move(published), a.median / b.median, a.low / b.high, a.high / b.low, ""};
}

/// \return progress of part `i` of `count`
Progress part(const Progress& progress, size_t i, size_t count) {
    return [&progress, i, count](double share) {
        if (progress) progress((double(i) + share) / double(count));
    };
}

std::vector<Ratio> trebilco(Renderer& renderer, uvec2 extent, const Effort& effort, const Progress& progress) {
    constexpr double kMultipassFps = 12;
    const std::vector<std::pair<uint32_t, double>> published{{1, 82}, {2, 62}, {4, 37}};  // overlap, frames a second
    std::vector<Ratio> ratios;
    for (size_t i = 0; i < published.size(); ++i) {
        const auto [overlap, fps] = published[i];
        const std::vector<Contender> contenders{{"forward-multipass", {.lighting = "forward-multipass"}},
                                                {"light-indexed", {.lighting = "light-indexed", .overlap = overlap, .indices = LidrIndices::n255, .onOverflow = OnOverflow::priority}}};
        const auto results = measureHall(renderer, 255, overlap, extent, contenders, effort, part(progress, i, published.size()));
        ratios.push_back(ratio(fmt::format("forward-multipass / light-indexed {0}x255, 255 lights, overlap {0}", overlap), fmt::format("{:.1f}", fps / kMultipassFps),
                               frameOf(results[0]), frameOf(results[1])));
    }
    return ratios;
}

std::vector<Ratio> olsson(Renderer& renderer, uvec2 extent, const Effort& effort, const Progress& progress) {
    const auto results = measureHall(renderer, 2400, 16, extent, {contender("tiled"), contender("clustered")}, effort, progress);
    return {ratio("tiled / clustered, frame, 2,400 lights", "1.53", frameOf(results[0]), frameOf(results[1])),
            ratio("tiled / clustered, shading, 2,400 lights", "3.2", sampleOf(results[0].shadingMs), sampleOf(results[1].shadingMs))};
}

std::vector<Ratio> mjp(Renderer& renderer, uvec2 extent, const Effort& effort, const Progress& progress) {
    std::vector<Ratio> ratios;
    const std::vector<uint32_t> lights{128, 256, 512, 1024};
    for (size_t i = 0; i < lights.size(); ++i) {
        std::vector<Contender> contenders{contender("tiled"), contender("clustered-forward"), contender("clustered-forward"), contender("light-indexed"), contender("light-indexed")};
        for (const size_t samples : {2, 4}) {
            contenders[samples].settings.msaa = Msaa::x4;
            contenders[samples].name += ", 4 samples";
        }
        std::vector<Contender> possible;
        for (const Contender& one : contenders) {
            try {
                renderer.render({.extent = uvec2(1)}, one.settings);
                possible.push_back(one);
            } catch (const Error& error) {
                if (error.kind() != ErrorKind::usage) throw;  // a device without samples
            }
        }
        const auto results = measureHall(renderer, lights[i], 8, extent, possible, effort, part(progress, i, lights.size()));
        const auto add = [&](const std::string& a, const std::string& b, const std::string& published) {
            const auto first = std::ranges::find(results, a, &Measured::name), second = std::ranges::find(results, b, &Measured::name);
            const std::string what = fmt::format("{} / {}, {} lights", a, b, lights[i]);
            if (first == results.end() || second == results.end())
                ratios.push_back({.what = what, .published = published, .whyNot = "the device shades no samples"});
            else
                ratios.push_back(ratio(what, published, frameOf(*first), frameOf(*second)));
        };
        for (const std::string name : {"clustered-forward", "light-indexed, list"}) {
            add(name, "tiled", "0.91 to 1.37");
            add(name + ", 4 samples", name, "1.15 to 1.31");
        }
        ratios.push_back({.what = fmt::format("tiled, 4 samples / tiled, {} lights", lights[i]), .published = "1.12 to 2.05", .whyNot = "tiled stores one surface a pixel"});
    }
    return ratios;
}

}  // namespace

const std::vector<Reproduction>& reproductions() {
    static const std::vector<Reproduction> all{
        {"trebilco", "Trebilco 2009, Light-Indexed Deferred Rendering, figure 2.9.1: GeForce 6800 GT, 1024 x 768, some 40,000 triangles, 255 lights",
         "our forward-multipass draws a light only on the objects that it can touch, inside a rectangle", trebilco},
        {"olsson", "Olsson, Billeter and Assarsson 2012, Clustered Deferred and Forward Shading: GeForce GTX 480, 1920 x 1080, about 2,400 lights",
         "their scene was another, and deeper than the hall; ours is at overlap 16; our tiles go by the hierarchy over the lights, too", olsson},
        {"mjp", "Pettineo 2012, Light Indexed Deferred Rendering: tiles of light indices for forward shading against tiled deferred shading",
         "his scene was another; ours is at overlap 8. What he calls light-indexed keeps lists by tile, as clustered-forward does by cluster; ours keeps them by pixel", mjp},
    };
    return all;
}

}  // namespace luciole::bench
