#include <fstream>
#include <map>
#include <sstream>

#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>

#include "support.hpp"

using namespace luciole;

namespace {

bool isScene(const std::filesystem::path& file) { return file.extension() == ".gltf" || file.extension() == ".glb"; }

}  // namespace

TEST_CASE("glTF assets: every file loads, or is refused for a compression that is not supported") {
    LUCIOLE_ASSETS_OR_SKIP(folder);
    const std::map<std::string, std::string> refused{
        {"BoxDraco", "KHR_draco_mesh_compression"}, {"DuckDraco", "KHR_draco_mesh_compression"},
        {"SponzaDracoWebP", "EXT_texture_webp"},    {"BoxMeshopt", "EXT_meshopt_compression"},
        {"FoxMeshopt", "EXT_meshopt_compression"},  {"AnisotropyBarnLampKTX2", "KHR_texture_basisu"}};
    size_t loaded = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string asset = std::filesystem::relative(entry.path(), folder).begin()->string();
        if (!isScene(entry.path()) || asset == "bad") continue;
        CAPTURE(entry.path().string());
        const auto expected = refused.find(asset);
        try {
            const Scene scene = loadScene(entry.path().string());
            CHECK(expected == refused.end());
            CHECK(triangleCount(scene) > 0);
            ++loaded;
        } catch (const Error& e) {
            const std::string message = e.what();
            INFO(message);
            REQUIRE(expected != refused.end());
            CHECK(e.kind() == ErrorKind::scene);
            CHECK(message.find(expected->second) != std::string::npos);
        }
    }
    CHECK(loaded >= 30);
}

TEST_CASE("glTF assets: spheres of the same accessors and many materials share their meshes") {
    LUCIOLE_ASSETS_OR_SKIP(folder);
    const Scene scene = loadScene((folder / "MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb").string());
    CHECK(triangleCount(scene) == 1'040'409);
    CHECK(scene.objects.size() == 123);
    CHECK(scene.meshes.size() == 26);
}

TEST_CASE("glTF assets: each broken file is refused or loaded as its table says") {
    LUCIOLE_ASSETS_OR_SKIP(folder);
    std::ifstream table(folder / "bad" / "EXPECT.tsv");
    std::string line;
    std::getline(table, line);
    size_t rows = 0;
    while (std::getline(table, line)) {
        std::istringstream fields(line);
        std::string file, fault, expected;
        std::getline(fields, file, '\t');
        std::getline(fields, fault, '\t');
        std::getline(fields, expected, '\t');
        CAPTURE(file);
        CAPTURE(fault);
        std::string outcome = "ok";
        try {
            loadScene((folder / "bad" / file).string());
        } catch (const Error& e) {
            outcome = "error";
            CHECK(std::string(e.what()).find(file) != std::string::npos);
        }
        if (expected != "either") CHECK(outcome == expected);
        ++rows;
    }
    CHECK(rows == 18);
}
