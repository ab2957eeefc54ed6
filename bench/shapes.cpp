#include <luciole/scene_io.hpp>

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include <map>

#include "suites.hpp"

namespace luciole::bench {
namespace {

const std::vector<std::string> kShapes{"quad", "volume", "volume-stencil", "volume-stencil-reference", "volume-instanced"};

struct Result {
    std::vector<double> lightingMs, recordMs;
    double evaluations = 0, useful = 0;  ///< per pixel
    uint32_t draws = 0, stencilDraws = 0;
};

double meanOf(const Image& image) {
    double sum = 0;
    for (const float value : image.data) sum += value;
    return sum / double(image.data.size());
}

/// Its passes; those that all techniques have are left out.
void addLighting(Result& result, const Frame& frame, const std::string& technique) {
    double ms = 0;
    result.draws = result.stencilDraws = 0;
    for (const PassStats& pass : frame.stats.passes)
        if (pass.name.starts_with("lighting." + technique)) {
            ms += pass.ms.value();
            result.draws += pass.draws;
            result.stencilDraws += pass.stencilDraws;
        }
    result.lightingMs.push_back(ms);
    result.recordMs.push_back(frame.stats.recordMs);
}

std::map<std::string, Result> measureShapes(Renderer& renderer, const View& view, const std::vector<std::string>& techniques, int frames,
                                      bool cull = true) {
    std::map<std::string, Result> results;
    for (const std::string& technique : techniques) {
        const Frame counted = renderer.render(view, {.lighting = technique, .cullLights = cull}, {"evaluations", "useful-evaluations"});
        results[technique].evaluations = meanOf(counted.aovs.at("evaluations"));
        results[technique].useful = meanOf(counted.aovs.at("useful-evaluations"));
    }
    for (int frame = 0; frame < frames; ++frame)
        for (const std::string& technique : techniques)
            addLighting(results[technique], renderer.render(view, {.lighting = technique, .cullLights = cull, .measure = true}), technique);
    return results;
}

void printRow(const std::string& scene, const std::string& technique, const Result& result, double bruteMs) {
    fmt::print("| {} | {} | {} | {:.1f} | {:.2f} | {:.2f} | {} | {} | {:.2f} |\n", scene, technique, milliseconds(result.lightingMs),
               bruteMs / least(result.lightingMs), result.evaluations, result.useful, result.draws, result.stencilDraws,
               least(result.recordMs));
}

void printHeader() {
    fmt::print("\n| scene | technique | lighting, ms: median (minimum) | times faster than brute force | evaluations a pixel | useful | "
               "draws | stencil draws | record, ms |\n| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
}

void benchGrid(Renderer& renderer, int frames, uvec2 extent) {
    printHeader();
    for (const int lights : {255, 1024, 4096})
        for (const int overlap : {2, 4, 16}) {
            const Scene scene = loadScene(fmt::format("builtin:hall?lights={}&overlap={}&triangles=40000&seed=1", lights, overlap));
            renderer.setScene(scene);
            const View view{scene.cameras.at(0), extent};
            const std::string name = fmt::format("{} lights, overlap {}", lights, overlap);
            // One frame each of what takes seconds; the next such line is far off, so one is enough to see the ratio.
            auto slow = measureShapes(renderer, view, lights == 255 ? std::vector<std::string>{"brute-force", "fullscreen"} : std::vector<std::string>{"brute-force"}, 1);
            const double brute = least(slow.at("brute-force").lightingMs);
            for (const auto& [technique, result] : slow) printRow(name, technique, result, brute);
            const auto results = measureShapes(renderer, view, kShapes, frames);
            for (const std::string& technique : kShapes) printRow(name, technique, results.at(technique), brute);
            std::fflush(stdout);
        }
}

void benchCulling(Renderer& renderer, int frames, uvec2 extent) {
    fmt::print("\n| 4,096 lights, overlap 4 | culled: ms, median (minimum) | not culled |\n| --- | ---: | ---: |\n");
    const Scene scene = loadScene("builtin:hall?lights=4096&overlap=4&triangles=40000&seed=1");
    renderer.setScene(scene);
    View view{scene.cameras.at(0), extent};
    // Turned round in the middle of the nave: half of the lights are behind.
    view.camera.worldFromView = lookAt(vec3(0, 1.7f, -24), vec3(3, 3, -48));
    const auto culled = measureShapes(renderer, view, kShapes, frames), all = measureShapes(renderer, view, kShapes, frames, false);
    for (const std::string& technique : kShapes)
        fmt::print("| {} | {} | {} |\n", technique, milliseconds(culled.at(technique).lightingMs), milliseconds(all.at(technique).lightingMs));
}

Mesh box(vec3 low, vec3 high) {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            const auto first = uint32_t(mesh.vertices.size());
            for (const vec2 corner : {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 1)}) {
                vec3 t(0), normal(0);
                t[axis] = side > 0 ? 1.0f : 0.0f;
                t[(axis + 1) % 3] = side > 0 ? corner.x : corner.y;
                t[(axis + 2) % 3] = side > 0 ? corner.y : corner.x;
                normal[axis] = side;
                mesh.vertices.push_back({.position = low + t * (high - low), .normal = normal});
            }
            mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
        }
    return mesh;
}

/// A floor of 40 x 40 m, seen from its edge at eye height. \param walls in the way of the view, rows of them with gaps
Scene floorScene(bool walls) {
    Scene scene;
    scene.materials = {{.name = "grey", .baseColor = vec4(0.5f, 0.5f, 0.5f, 1), .metallic = 0, .roughness = 0.7f}};
    scene.meshes = {box(vec3(-20, -1, -40), vec3(20, 0, 0))};
    if (walls)
        for (int row = 0; row < 6; ++row)
            for (int column = 0; column < 8; ++column) {
                const vec3 low(-20 + 5 * column + (row % 2) * 2, 0, -6 * row - 5);
                scene.meshes.push_back(box(low, low + vec3(4.2f, 3, 0.3f)));
            }
    for (uint32_t i = 0; i < scene.meshes.size(); ++i) scene.objects.push_back({.name = "box", .mesh = i, .objectId = i});
    return scene;
}

View floorView(uvec2 extent) { return {{.worldFromView = lookAt(vec3(0, 1.7f, 1), vec3(0, 1, -20))}, extent}; }

/// 255 lights at the height of a lamp over the floor, none touching another's neighbour's neighbour.
void addLamps(Scene& scene) {
    for (int i = 0; i < 255; ++i)
        scene.lights.push_back({.positionWorld = vec3(-19 + 2.5f * float(i % 16), 1, -1.5f - 2.4f * float(i / 16)), .color = vec3(3), .range = 2});
}

void benchOcclusion(Renderer& renderer, int frames, uvec2 extent) {
    printHeader();
    for (const bool walls : {false, true}) {
        Scene scene = floorScene(walls);
        addLamps(scene);
        renderer.setScene(scene);
        const auto results = measureShapes(renderer, floorView(extent), {"brute-force", "quad", "volume", "volume-stencil", "volume-instanced"}, frames);
        const double brute = least(results.at("brute-force").lightingMs);
        for (const auto& [technique, result] : results)
            printRow(walls ? "255 lights, walls between" : "255 lights, open floor", technique, result, brute);
    }
}

/// One light, or n x n lights that cover as much of the floor, seen from above.
void benchOneOrMany(Renderer& renderer, int frames, uvec2 extent) {
    printHeader();
    for (const int n : {1, 16}) {
        Scene scene = floorScene(false);
        const float range = 10.0f / float(n);
        for (int i = 0; i < n * n; ++i)
            scene.lights.push_back({.positionWorld = vec3(range * (2 * float(i % n) + 1) - 10, 0.05f, range * (2 * float(i / n) + 1) - 30),
                                    .color = vec3(3),
                                    .range = range});
        renderer.setScene(scene);
        View view{{.worldFromView = lookAt(vec3(0, 30, -19.9f), vec3(0, 0, -20))}, extent};
        const auto results = measureShapes(renderer, view, {"brute-force", "quad", "volume", "volume-stencil", "volume-instanced"}, frames);
        const double brute = least(results.at("brute-force").lightingMs);
        for (const auto& [technique, result] : results)
            printRow(n == 1 ? "1 light of 10 m" : "256 lights of 0.625 m", technique, result, brute);
    }
}

}  // namespace

void benchShapes(Renderer& renderer, const Options& options) {
    benchOneOrMany(renderer, options.frames, options.extent);
    benchOcclusion(renderer, options.frames, options.extent);
    benchCulling(renderer, options.frames, options.extent);
    benchGrid(renderer, options.frames, options.extent);
}

}  // namespace luciole::bench
