#include <filesystem>
#include <fstream>

#include <doctest/doctest.h>

#include "gltf_document.hpp"
#include "io/temporary_folder.hpp"

using namespace luciole;
using namespace luciole::test;

namespace fs = std::filesystem;

namespace {

/// A folder with the scene's own folder in it: `outside.bin` lies beside that, `inside.bin` within.
class SceneFolder {
public:
    SceneFolder() {
        fs::create_directories(scene() / "sub");
        for (const fs::path& file : {root_ / "outside.bin", scene() / "inside.bin", scene() / "sub" / "Grün ❤ 1.bin"}) {
            std::ofstream(file, std::ios::binary) << std::string(72, '\0');
        }
    }

    fs::path scene() const { return root_ / "scene"; }

    /// Loads a triangle of zeros whose buffer is at `uri`.
    Refusal load(const std::string& uri, bool allowExternal = false) const {
        Document document;
        document.triangle();
        document.json["buffers"] = {{{"byteLength", 72}, {"uri", uri}}};
        const std::string text = document.text();
        const LoadOptions options{.allowExternal = allowExternal};
        return refusalOf([&] { loadGltf(std::as_bytes(std::span(text)), "test.gltf", scene(), options); });
    }

private:
    TemporaryFolder root_;
};

const std::string kUri = "test.gltf: /buffers/0/uri: ";

std::string glb(const std::string& json, const std::string& binary, uint32_t version = 2, int extraLength = 0) {
    std::string file = "glTF";
    const auto put = [&](uint32_t value) { file.append(reinterpret_cast<const char*>(&value), 4); };
    put(version);
    put(uint32_t(12 + 8 + json.size() + 8 + binary.size()) + uint32_t(extraLength));
    put(uint32_t(json.size()));
    file += "JSON" + json;
    put(uint32_t(binary.size()));
    file += std::string("BIN\0", 4) + binary;
    return file;
}

}  // namespace

TEST_CASE("glTF files: names with spaces, other scripts and percent escapes are found inside the scene's folder") {
    const SceneFolder folder;
    for (const char* uri : {"inside.bin", "./inside.bin", "sub/../inside.bin", "%69nside.bin", "sub/Grün ❤ 1.bin",
                            "sub/Gr%C3%BCn%20%e2%9d%a4%201.bin"}) {
        CAPTURE(uri);
        CHECK(folder.load(uri).message == "loaded");
    }
}

TEST_CASE("glTF files: what lies outside of the scene's folder is refused, however it is written") {
    const SceneFolder folder;
    for (const char* uri : {"../outside.bin", "%2e%2e/outside.bin", "..%2Foutside.bin", "sub/../../outside.bin",
                            "../scene-no/x.bin", "sub/../../../../../../../../etc/hosts"}) {
        CAPTURE(uri);
        const Refusal refusal = folder.load(uri);
        CHECK(refusal.kind == ErrorKind::scene);
        CHECK(refusal.message == kUri + "expected a file in the scene's folder, got \"" + uri + "\"");
    }
    CHECK(folder.load("../outside.bin", true).message == "loaded");
}

TEST_CASE("glTF files: a symbolic link is judged by where it leads") {
    const SceneFolder folder;
    fs::create_symlink("../outside.bin", folder.scene() / "link-out.bin");
    fs::create_symlink("inside.bin", folder.scene() / "link-in.bin");
    fs::create_directory_symlink("..", folder.scene() / "up");
    CHECK(folder.load("link-in.bin").message == "loaded");
    CHECK(folder.load("link-out.bin").message == kUri + "expected a file in the scene's folder, got \"link-out.bin\"");
    CHECK(folder.load("up/outside.bin").kind == ErrorKind::scene);
    CHECK(folder.load("up/outside.bin", true).message == "loaded");
}

TEST_CASE("glTF files: absolute paths and schemes are refused, even where outside files are allowed") {
    const SceneFolder folder;
    for (const bool allowExternal : {false, true}) {
        CHECK(folder.load((folder.scene() / "inside.bin").string(), allowExternal)
                  .message.starts_with(kUri + "expected a relative path, got "));
        for (const char* uri : {"file:inside.bin", "http://host/x.bin", "C:/x.bin", "%66ile:inside.bin"}) {
            CAPTURE(uri);
            CHECK(folder.load(uri, allowExternal).message ==
                  kUri + "expected a relative path or a data URI, got \"" + uri + "\"");
        }
    }
}

TEST_CASE("glTF files: broken escapes, empty names and NUL are refused") {
    const SceneFolder folder;
    CHECK(folder.load("%zz.bin").message == kUri + "expected two hexadecimal digits after %, got \"%zz.bin\"");
    CHECK(folder.load("inside.bin%2").kind == ErrorKind::scene);
    CHECK(folder.load("").message == kUri + "expected the name of a file, got \"\"");
    CHECK(folder.load("inside.bin%00.png").kind == ErrorKind::scene);
}

TEST_CASE("glTF files: a file that is missing or a folder is an I/O error that names the URI's path") {
    const SceneFolder folder;
    for (const char* uri : {"gone.bin", "sub"}) {
        const Refusal refusal = folder.load(uri);
        CHECK(refusal.kind == ErrorKind::io);
        CHECK(refusal.message.starts_with(kUri));
    }
}

TEST_CASE("glTF files: from memory and without a folder only data URIs are read") {
    Document document;
    document.triangle();
    document.json["buffers"] = {{{"byteLength", 72}, {"uri", "inside.bin"}}};
    CHECK(document.refusal().message == kUri + "expected a data URI, as the scene has no folder, got \"inside.bin\"");
    document.json["buffers"][0]["uri"] = "data:;base64,AA*A";
    CHECK(document.refusal().message == kUri + "expected base64 data, got \"data:;base64,AA*A\"");
    document.json["buffers"][0]["uri"] = "data:text/plain,hello";
    CHECK(document.refusal().message == kUri + "expected data:TYPE;base64,DATA, got \"data:text/plain,hello\"");
    document.json["buffers"][0].erase("uri");
    CHECK(document.refusal().message ==
          "test.gltf: /buffers/0: expected a key \"uri\", as this buffer is not the binary chunk of a GLB file");
}

TEST_CASE("glTF files: loadScene reads a file by its path and a built-in scene by its URI") {
    const SceneFolder folder;
    Document document;
    document.triangle();
    std::ofstream(folder.scene() / "box.gltf") << document.text();
    CHECK(loadScene((folder.scene() / "box.gltf").string()).name == "box");
    CHECK(refusalOf([&] { loadScene((folder.scene() / "none.gltf").string()); }).kind == ErrorKind::io);
    CHECK(refusalOf([] { loadScene("builtin:no-such-scene"); }).kind == ErrorKind::usage);
    LoadOptions small;
    small.limits.maxFileBytes = 10;
    CHECK(refusalOf([&] { loadScene((folder.scene() / "box.gltf").string(), small); }).kind == ErrorKind::limit);
}

TEST_CASE("GLB: the binary chunk is the buffer without URI") {
    Document document;
    document.triangle();
    document.json["buffers"] = {{{"byteLength", document.data.size()}}};
    const std::string binary(reinterpret_cast<const char*>(document.data.data()), document.data.size());
    const std::string json = document.text();
    CHECK(loadText(glb(json, binary)).meshes.at(0).vertices.at(1).position == vec3(1, 0, 0));
    CHECK(refusalOf([&] { loadText(glb(json, binary.substr(4))); }).message ==
          "test.gltf: /buffers/0/byteLength: expected a whole number in [0, 68], got 72");
}

TEST_CASE("GLB: a file that is cut anywhere, of another version or with chunks out of order is refused") {
    const std::string whole = glb(R"({"asset":{"version":"2.0"}})", "1234");
    CHECK(loadText(whole).objects.empty());
    for (size_t size = 0; size < whole.size(); ++size) {
        CAPTURE(size);
        CHECK(refusalOf([&] { loadText(whole.substr(0, size)); }).kind == ErrorKind::scene);
    }
    CHECK(refusalOf([] { loadText(glb("{}", "", 1)); }).message == "test.gltf: GLB: expected version 2, got 1");
    CHECK(refusalOf([] { loadText(glb("{}", "", 2, 1)); }).kind == ErrorKind::scene);
    CHECK(refusalOf([] { loadText(glb("{}", "", 2, -40)); }).kind == ErrorKind::scene);
    std::string swapped = whole;
    swapped.replace(16, 4, "BIN", 4);
    CHECK(refusalOf([&] { loadText(swapped); }).message == "test.gltf: GLB: expected one JSON chunk, the first");
}

TEST_CASE("glTF wall: deep nesting and long arrays are refused by the limits, before a document is built") {
    const auto nested = [](int depth) {
        return R"({"asset":{"version":"2.0"},"extras":)" + std::string(size_t(depth), '[') +
               std::string(size_t(depth), ']') + "}";
    };
    CHECK(loadText(nested(127)).objects.empty());
    CHECK(refusalOf([&] { loadText(nested(128)); }).kind == ErrorKind::limit);
    CHECK(refusalOf([&] { loadText(nested(1'000'000)); }).kind == ErrorKind::limit);
    LoadOptions options;
    options.limits.maxElements = 3;
    const std::string four = R"({"asset":{"version":"2.0"},"extras":[1,2,3,4]})";
    CHECK(refusalOf([&] { loadText(four, options); }).kind == ErrorKind::limit);
    CHECK(loadText(four).objects.empty());
}

TEST_CASE("glTF wall: offsets, lengths, counts and strides that overflow or leave the buffer are refused") {
    const std::string largest = "18446744073709551615";
    const auto with = [](const std::string& pointer, const Json& value) {
        Document document;
        document.triangle();
        document.json[Json::json_pointer(pointer)] = value;
        return document.refusal();
    };
    CHECK(with("/accessors/0/byteOffset", ~0ull).message ==
          "test.gltf: /accessors/0/byteOffset: expected a whole number in [0, 60], got " + largest);
    CHECK(with("/accessors/0/byteOffset", 40).message ==
          "test.gltf: /accessors/0: expected a count of at most 2, as the buffer view ends there, got 3");
    CHECK(with("/accessors/0/byteOffset", -1).message ==
          "test.gltf: /accessors/0/byteOffset: expected a whole number in [0, 60], got -1");
    CHECK(with("/accessors/0/byteOffset", 1e300).kind == ErrorKind::scene);
    CHECK(with("/accessors/0/byteOffset", 0.5).kind == ErrorKind::scene);
    CHECK(with("/accessors/0/count", ~0ull).message ==
          "test.gltf: /accessors/0/count: expected at most 200000000 elements, got " + largest);
    CHECK(with("/accessors/0/count", 7).message ==
          "test.gltf: /accessors/0: expected a count of at most 6, as the buffer view ends there, got 7");
    CHECK(with("/bufferViews/0/byteOffset", 73).kind == ErrorKind::scene);
    CHECK(with("/bufferViews/0/byteOffset", 1).message ==
          "test.gltf: /bufferViews/0/byteLength: expected a whole number in [0, 71], got 72");
    CHECK(with("/bufferViews/0/byteLength", ~0ull).kind == ErrorKind::scene);
    CHECK(with("/bufferViews/0/byteStride", 253).kind == ErrorKind::scene);
    CHECK(with("/bufferViews/0/byteStride", 252).message ==
          "test.gltf: /accessors/0: expected a count of at most 1, as the buffer view ends there, got 3");
    CHECK(with("/bufferViews/0/buffer", 1).message ==
          "test.gltf: /bufferViews/0/buffer: expected a whole number in [0, 0], got 1");
    CHECK(with("/accessors/0/componentType", 5124).kind == ErrorKind::scene);
    CHECK(with("/accessors/0/bufferView", 3).kind == ErrorKind::scene);
    CHECK(with("/meshes/0/primitives/0/attributes/POSITION", 9).message ==
          "test.gltf: /meshes/0/primitives/0/attributes/POSITION: expected a whole number in [0, 1], got 9");
    CHECK(with("/nodes/0/mesh", 1).message == "test.gltf: /nodes/0/mesh: expected a whole number in [0, 0], got 1");
    CHECK(with("/nodes", "many").message == "test.gltf: /nodes: expected an array, got \"many\"");
}

TEST_CASE("glTF wall: a number beyond float's range is refused and never becomes infinite") {
    Document document;
    document.triangle();
    document.json["nodes"][0]["translation"] = {0, 1e39, 0};
    CHECK(document.refusal().message ==
          "test.gltf: /nodes/0/translation/1: expected a number that fits into 32 bits, got 1e+39");
    const std::string overflowing = R"({"asset":{"version":"2.0"},"extras":1e999})";
    CHECK(refusalOf([&] { loadText(overflowing); }).kind == ErrorKind::scene);
}

TEST_CASE("glTF wall: a small file can't ask for many elements by zeros that no buffer holds") {
    const std::string zeros = R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"componentType":5126,"type":"VEC3","count":60000000}]})";
    const Refusal refusal = refusalOf([&] { loadText(zeros); });
    CHECK(refusal.kind == ErrorKind::limit);
    CHECK(refusal.message == "test.gltf: /accessors/0/count: expected at most 1000000 elements, got 60000000");
}

TEST_CASE("glTF wall: primitives that are not drawn cost once, however many nodes place their mesh") {
    Json json = {{"asset", {{"version", "2.0"}}}, {"scenes", Json::array({Json::object()})}, {"nodes", Json::array()}};
    json["meshes"] = Json::array({Json::object()});
    for (int i = 0; i < 20000; ++i)
        json["meshes"][0]["primitives"].push_back({{"attributes", Json::object()}, {"mode", 0}});
    for (int i = 0; i < 60000; ++i) {
        json["nodes"].push_back({{"mesh", 0}});
        json["scenes"][0]["nodes"].push_back(i);
    }
    CHECK(loadText(json.dump()).objects.empty());  // 1.2e9 visits took minutes
}

TEST_CASE("glTF: what is neither GLB nor JSON is told so") {
    CHECK(refusalOf([] { loadText("PK\x03\x04"); }).message ==
          "test.gltf: expected \"glTF\" (GLB) or a JSON object at the beginning");
}

TEST_CASE("glTF: other major versions are refused, later minor ones are read") {
    CHECK(refusalOf([] { loadText(R"({"asset":{"version":"1.0"}})"); }).message ==
          "test.gltf: /asset/version: expected 2.x, got \"1.0\"");
    CHECK(loadText(R"({"asset":{"version":"2.7"}})").objects.empty());
    CHECK(refusalOf([] { loadText(R"({"asset":{"version":"2.1","minVersion":"2.1"}})"); }).message ==
          "test.gltf: /asset/minVersion: expected 2.0, got \"2.1\"");
    CHECK(refusalOf([] { loadText("{}"); }).message == "test.gltf: /: expected a key \"asset\", got none");
    CHECK(refusalOf([] { loadText("[]"); }).message == "test.gltf: /: expected an object, got an array of 0");
}

TEST_CASE("glTF: an unknown extension is a warning where it is used and an error where it is required") {
    const Scene scene =
        loadText(R"({"asset":{"version":"2.0"},"extensionsUsed":["EXT_a","EXT_b","KHR_mesh_quantization"]})");
    CHECK(scene.warnings == std::vector<std::string>{"extension EXT_a is not supported; ignored",
                                                     "extension EXT_b is not supported; ignored"});
    const Refusal refusal = refusalOf([] {
        loadText(
            R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_texture_transform","KHR_draco_mesh_compression"]})");
    });
    CHECK(refusal.kind == ErrorKind::scene);
    CHECK(refusal.message.starts_with("test.gltf: /extensionsRequired/1: expected one of KHR_lights_punctual"));
    CHECK(refusal.message.ends_with("got \"KHR_draco_mesh_compression\""));
}
