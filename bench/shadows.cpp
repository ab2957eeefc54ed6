#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include <luciole/scene_io.hpp>

#include "halls.hpp"
#include "suites.hpp"

namespace luciole::bench {
namespace {

RenderSettings shadowed(Shadows shadows, ShadowFilter filter = ShadowFilter::jittered) {
    RenderSettings settings{.lighting = "clustered", .shadows = shadows, .shadowFilter = filter};
    settings.shadowMemory = 1024;  // volumes' masks of 256 lights
    return settings;
}

/// With all the materials that it has, unlike builtinHall.
Scene hall(uint32_t lights) { return loadScene(fmt::format("builtin:hall?lights={}", lights)); }

std::vector<Light> moved(std::vector<Light> lights, int frame) {
    for (size_t i = 0; i < lights.size(); ++i) lights[i].positionWorld += 0.02f * vec3(std::cos(float(i) + float(frame)), 0, std::sin(float(i) + float(frame)));
    return lights;
}

/// One frame that does not count, for its resources are made anew, then what comes between, then one that does.
Frame secondFrame(Renderer& renderer, const View& view, const RenderSettings& settings, const std::function<void()>& between = {}) {
    renderer.render(view, settings);
    if (between) between();
    return renderer.render(view, settings);
}

/// What keeping maps is worth: frames without shadows, with all maps kept, with one object and with all lights moved.
void printKept(Renderer& renderer, const Options& options) {
    fmt::print("\n| shadowed lights | maps | MiB | no shadows, ms: median (least) | all kept, ms | times | one column moved, ms | maps drawn, draws | all lights moved, ms | draws |\n"
               "| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (const uint32_t lights : {16u, 64u, 256u}) {
        const Scene scene = hall(lights);
        renderer.setScene(scene);
        const View view{scene.cameras.at(0), options.extent};
        const auto column = uint32_t(std::ranges::find_if(scene.objects, [](const Object& object) { return object.name.starts_with("column left 1"); }) - scene.objects.begin());
        std::vector<double> without, kept, one, all;
        ShadowStats ofKept, ofOne, ofAll;
        for (int frame = 0; frame < options.frames; ++frame) {
            without.push_back(secondFrame(renderer, view, shadowed(Shadows::off)).stats.wallMs);
            const Frame still = secondFrame(renderer, view, shadowed(Shadows::maps));
            kept.push_back(still.stats.wallMs), ofKept = *still.stats.shadows;
            const Frame turned = secondFrame(renderer, view, shadowed(Shadows::maps), [&] { renderer.setLights(moved(scene.lights, frame)); });
            all.push_back(turned.stats.wallMs), ofAll = *turned.stats.shadows;
        }
        for (int frame = 0; frame < options.frames; ++frame) {
            const MovedObject there{column, glm::translate(mat4(1), vec3(0.01f * float(frame % 2 + 1), 0, 0)) * scene.objects[column].worldFromObject};
            const Frame step = secondFrame(renderer, view, shadowed(Shadows::maps), [&] { renderer.moveObjects(std::span(&there, 1)); });
            one.push_back(step.stats.wallMs), ofOne = *step.stats.shadows;
        }
        fmt::print("| {} | {} | {:.0f} | {} | {} | {:.2f} | {} | {}, {} | {} | {} |\n", lights, ofKept.maps, double(ofKept.texels) / (1 << 18), milliseconds(without),
                   milliseconds(kept), median(kept) / median(without), milliseconds(one), ofOne.drawn, ofOne.casterDraws, milliseconds(all), ofAll.casterDraws);
        std::fflush(stdout);
    }
}

/// What a shadow costs that is there: frames of a hall with 255 lights, maps kept.
void printUsing(Renderer& renderer, const Options& options, const Scene& scene, const char* name) {
    renderer.setScene(scene);
    const View view{scene.cameras.at(0), options.extent};
    const std::vector<Contender> kinds{{"none", shadowed(Shadows::off)},
                                       {"maps, point", shadowed(Shadows::maps, ShadowFilter::point)},
                                       {"maps, jittered", shadowed(Shadows::maps)},
                                       {"maps, smooth", shadowed(Shadows::maps, ShadowFilter::smooth)}};
    std::map<std::string, std::vector<double>> ms;
    for (int frame = 0; frame < options.frames; ++frame)
        for (const Contender& kind : kinds) ms[kind.name].push_back(secondFrame(renderer, view, kind.settings).stats.wallMs);
    const Frame counted = renderer.render(view, shadowed(Shadows::off), {"useful-evaluations"});
    double useful = 0;
    for (const float value : counted.aovs.at("useful-evaluations").data) useful += double(value);
    fmt::print("\n| shadows of 255 lights, kept; {} | frame, ms: median (least) | times | ns for each light at a pixel that it reaches |\n| --- | ---: | ---: | ---: |\n", name);
    for (const Contender& kind : kinds)
        fmt::print("| {} | {} | {:.2f} | {:.1f} |\n", kind.name, milliseconds(ms[kind.name]), median(ms[kind.name]) / median(ms["none"]),
                   1e6 * (median(ms[kind.name]) - median(ms["none"])) / useful);
    std::fflush(stdout);
}

/// Volumes beside maps that are all drawn.
void printVolumes(Renderer& renderer, const Options& options) {
    fmt::print("\n| shadowed lights | maps all drawn: pass, ms | draws | volumes: pass, ms | draws | MiB of masks |\n| ---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (const uint32_t lights : {1u, 16u, 64u}) {
        const Scene scene = builtinHall(lights, lights < 4 ? 0.5 : 4);
        renderer.setScene(scene);
        const View view{scene.cameras.at(0), options.extent};
        std::vector<double> maps, volumes;
        ShadowStats ofMaps, ofVolumes;
        const auto passMs = [](const Frame& frame, std::string_view name) {
            return *std::ranges::find(frame.stats.passes, name, &PassStats::name)->ms;
        };
        for (int frame = 0; frame < options.frames; ++frame) {
            RenderSettings settings = shadowed(Shadows::maps);
            settings.measure = true;
            const Frame drawn = secondFrame(renderer, view, settings, [&] { renderer.setLights(moved(scene.lights, frame)); });
            maps.push_back(passMs(drawn, "shadow.maps")), ofMaps = *drawn.stats.shadows;
            settings.shadows = Shadows::volumes;
            const Frame marked = secondFrame(renderer, view, settings);
            volumes.push_back(passMs(marked, "shadow.volumes")), ofVolumes = *marked.stats.shadows;
        }
        fmt::print("| {} | {} | {} | {} | {} | {:.1f} |\n", lights, milliseconds(maps), ofMaps.casterDraws, milliseconds(volumes), ofVolumes.casterDraws,
                   double(ofVolumes.bytes) / (1 << 20));
        std::fflush(stdout);
    }
}

/// Light-indexed rendering's ways with shadows.
void printIndexed(Renderer& renderer, const Options& options) {
    const Scene scene = builtinHall(255, 1);
    renderer.setScene(scene);
    const View view{scene.cameras.at(0), options.extent};
    RenderSettings settings = shadowed(Shadows::maps);
    settings.lighting = "light-indexed";
    settings.overlap = 16;
    settings.indices = LidrIndices::n255;
    settings.measure = true;
    constexpr std::pair<LidrShadows, const char*> kWays[] = {{LidrShadows::none, "none"}, {LidrShadows::finalPass, "final"}, {LidrShadows::index, "index"}, {LidrShadows::indexSoft, "index-soft"}};
    fmt::print("\n| lidr-shadows | index passes, ms: median (least) | surfaces, ms | bytes of images a pixel |\n| --- | ---: | ---: | ---: |\n");
    std::map<std::string, std::vector<double>> index, surfaces;
    std::map<std::string, double> bytes;
    for (int frame = 0; frame < options.frames; ++frame)
        for (const auto& [way, name] : kWays) {
            settings.lidrShadows = way;
            const Frame drawn = secondFrame(renderer, view, settings);
            double indexMs = 0;
            for (const PassStats& pass : drawn.stats.passes) {
                if (pass.name == "lighting.light-indexed.index" || pass.name == "lighting.light-indexed.shadows") indexMs += *pass.ms;
                if (pass.name == "lighting.light-indexed.surfaces") surfaces[name].push_back(*pass.ms);
            }
            index[name].push_back(indexMs);
            bytes[name] = double(drawn.stats.lightIndex->imageBytes) / (double(options.extent.x) * options.extent.y);
        }
    for (const auto& [way, name] : kWays) fmt::print("| {} | {} | {} | {:.0f} |\n", name, milliseconds(index[name]), milliseconds(surfaces[name]), bytes[name]);
}

}  // namespace

void benchShadows(Renderer& renderer, const Options& options) {
    printKept(renderer, options);
    printUsing(renderer, options, hall(255), "`builtin:hall`");
    printUsing(renderer, options, builtinHall(255, 4), "`builtin:hall?gltf=1`");
    printVolumes(renderer, options);
    printIndexed(renderer, options);
}

}  // namespace luciole::bench
