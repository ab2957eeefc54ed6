#pragma once
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <luciole/error.hpp>

#include "scene/json.hpp"

/// What glTF files need of JSON beyond JsonNode: references into the document's lists, vectors, defaults.
namespace luciole::gltf {

/// The value of `reference` as an index into the document's list `list`.
inline uint32_t indexInto(const JsonNode& root, std::string_view list, const JsonNode& reference) {
    const auto array = root.find(list);
    const size_t count = array ? array->size() : 0;
    if (count == 0) reference.fail(fmt::format("no reference to {}, as there are none", list));
    return uint32_t(reference.integer(0, count - 1));
}

/// The element of the document's list `list` that `reference` refers to.
inline JsonNode resolve(const JsonNode& root, std::string_view list, const JsonNode& reference) {
    const uint32_t index = indexInto(root, list, reference);
    return root.at(list)[index];
}

inline std::optional<JsonNode> extension(const JsonNode& object, std::string_view name) {
    const auto extensions = object.find("extensions");
    return extensions ? extensions->find(name) : std::nullopt;
}

/// An array of exactly N numbers in [low, high].
template <int N>
glm::vec<N, double> vectorOf(const JsonNode& array, double low = -JsonNode::kMost, double high = JsonNode::kMost) {
    if (!array.isArray() || array.size() != N) array.fail(fmt::format("an array of {} numbers", N));
    glm::vec<N, double> v(0.0);
    for (int i = 0; i < N; ++i) v[i] = array[size_t(i)].number(low, high);
    return v;
}

template <int N>
glm::vec<N, double> vectorOr(const JsonNode& object, std::string_view key, const glm::vec<N, double>& fallback,
                             double low = -JsonNode::kMost, double high = JsonNode::kMost) {
    const auto array = object.find(key);
    return array ? vectorOf<N>(*array, low, high) : fallback;
}

inline double numberOr(const JsonNode& object, std::string_view key, double fallback, double low = -JsonNode::kMost,
                       double high = JsonNode::kMost) {
    const auto value = object.find(key);
    return value ? value->number(low, high) : fallback;
}

inline uint64_t integerOr(const JsonNode& object, std::string_view key, uint64_t fallback, uint64_t low,
                          uint64_t high) {
    const auto value = object.find(key);
    return value ? value->integer(low, high) : fallback;
}

inline bool booleanOr(const JsonNode& object, std::string_view key, bool fallback) {
    const auto value = object.find(key);
    return value ? value->boolean() : fallback;
}

inline std::string stringOr(const JsonNode& object, std::string_view key, const std::string& fallback) {
    const auto value = object.find(key);
    return value ? value->string() : fallback;
}

}  // namespace luciole::gltf
