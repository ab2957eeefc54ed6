#include <cstddef>
#include <cstdint>
#include <span>

#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>

namespace {

/// Small enough that no input is slow; every check is as in the library's defaults.
luciole::LoadOptions tightOptions() {
    luciole::LoadOptions options;
    options.limits = {.maxFileBytes = 1 << 20,
                      .maxJsonDepth = 32,
                      .maxElements = 10'000,
                      .maxVertices = 100'000,
                      .maxImageSide = 512,
                      .maxImageBytes = 4 << 20};
    return options;
}

luciole::Scene sceneToLight() {
    luciole::Scene scene;
    scene.materials.push_back({.name = "wall"});
    scene.meshes.push_back(
        {"triangle", {{.position = {0, 0, 0}}, {.position = {1, 0, 0}}, {.position = {0, 1, 0}}}, {0, 1, 2}});
    scene.objects.push_back({.name = "wall"});
    // A closed one, for light volumes.
    scene.meshes.push_back({"tetrahedron",
                            {{.position = {0, 0, 0}}, {.position = {1, 0, 0}}, {.position = {0, 1, 0}}, {.position = {0, 0, 1}}},
                            {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}});
    scene.objects.push_back({.name = "helper", .mesh = 1});
    scene.lights.push_back({.name = "lamp"});
    scene.cameras.push_back({.name = "camera"});
    return scene;
}

}  // namespace

/// Bytes to Scene, all the way. The first byte chooses the reader: 'R' a rig file laid over a small scene, else glTF.
/// Whatever comes must be a valid scene or an Error.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const luciole::LoadOptions options = tightOptions();
    if (size == 0) return 0;
    const std::span input(reinterpret_cast<const std::byte*>(data + 1), size - 1);
    luciole::Scene scene;
    try {
        if (data[0] == 'R') {
            scene = sceneToLight();
            luciole::applyRigText(scene, {reinterpret_cast<const char*>(data + 1), size - 1}, "fuzz", options.limits);
        } else {
            scene = luciole::loadGltf(input, "fuzz", {}, options);
        }
    } catch (const luciole::Error&) {
        return 0;
    }
    luciole::validate(scene);
    return 0;
}
