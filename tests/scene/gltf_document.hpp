#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>

namespace luciole::test {

using Json = nlohmann::json;

inline std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? uint32_t(bytes[i + k]) : 0);
        for (size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kAlphabet[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

inline Scene loadText(const std::string& json, const LoadOptions& options = {}) {
    return loadGltf(std::as_bytes(std::span(json)), "test.gltf", {}, options);
}

/// The kind and message with which `load` is refused; kind usage and "loaded" if it is not.
struct Refusal {
    ErrorKind kind = ErrorKind::usage;
    std::string message = "loaded";
};
template <typename Load>
Refusal refusalOf(const Load& load) {
    try {
        load();
    } catch (const Error& e) {
        return {e.kind(), e.what()};
    }
    return {};
}

/// A glTF document in the making. All data lies in one embedded buffer with one buffer view.
struct Document {
    Json json = {{"asset", {{"version", "2.0"}}},
                 {"scenes", Json::array({{{"nodes", {0}}}})},
                 {"nodes", Json::array({Json::object({{"name", "node"}, {"mesh", 0}})})},
                 {"bufferViews", Json::array({Json::object({{"buffer", 0}})})}};
    std::vector<std::byte> data;

    /// Offset of `values` in the buffer.
    template <typename T>
    size_t add(const std::vector<T>& values) {
        data.resize((data.size() + 3) / 4 * 4);
        const size_t offset = data.size();
        const auto bytes = std::as_bytes(std::span(values));
        data.insert(data.end(), bytes.begin(), bytes.end());
        return offset;
    }

    /// Adds an accessor over `values`, which are `components` to an element.
    template <typename T>
    uint32_t accessor(const std::vector<T>& values, size_t components = 1, bool normalized = false) {
        constexpr const char* kTypes[]{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        json["accessors"].push_back({{"bufferView", 0},
                                     {"byteOffset", add(values)},
                                     {"componentType", componentType<T>()},
                                     {"normalized", normalized},
                                     {"count", values.size() / components},
                                     {"type", kTypes[components]}});
        return uint32_t(json["accessors"].size() - 1);
    }

    /// One mesh of one primitive.
    Document& primitive(const Json& primitive) {
        json["meshes"] = Json::array({{{"name", "mesh"}, {"primitives", Json::array({primitive})}}});
        return *this;
    }

    /// The triangle (0,0,0) (1,0,0) (0,1,0), with normals along +Z.
    Document& triangle() {
        const uint32_t positions = accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
        const uint32_t normals = accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
        return primitive({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    }
    Json& attributes() { return json["meshes"][0]["primitives"][0]["attributes"]; }

    std::string text() {
        Json whole = json;
        if (!data.empty() && !whole.contains("buffers")) {
            whole["buffers"] = {
                {{"byteLength", data.size()}, {"uri", "data:application/octet-stream;base64," + base64(data)}}};
        }
        if (!whole["bufferViews"][0].contains("byteLength")) whole["bufferViews"][0]["byteLength"] = data.size();
        return whole.dump();
    }
    Scene load(const LoadOptions& options = {}) { return loadText(text(), options); }
    Refusal refusal(const LoadOptions& options = {}) {
        return refusalOf([&] { load(options); });
    }

private:
    template <typename T>
    static int componentType() {
        if (std::is_same_v<T, int8_t>) return 5120;
        if (std::is_same_v<T, uint8_t>) return 5121;
        if (std::is_same_v<T, int16_t>) return 5122;
        if (std::is_same_v<T, uint16_t>) return 5123;
        if (std::is_same_v<T, uint32_t>) return 5125;
        return 5126;
    }
};

}  // namespace luciole::test
