#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <luciole/math.hpp>

#include "scene/json.hpp"

/// The small values that rig files are made of. All throw Error(scene) with file, JSON path, expected and found.
namespace luciole::rig {

/// Whether `name` as a whole fits a shell-style pattern: `*` any text, `?` one character (UTF-8), `\` takes the next
/// character as it is.
bool matches(std::string_view pattern, std::string_view name);

/// [r, g, b] linear Rec. 709, each >= 0, or "#rrggbb" in sRGB.
vec3 color(const JsonNode& node);

/// [x, y, z] of any length but zero, brought to unit length.
vec3 direction(const JsonNode& node);

/// Number in the open interval (low, high).
double between(const JsonNode& node, double low, double high);

/// Degrees or any other range as [low, high]; a plain number stands for both ends. Both within [least, most].
dvec2 interval(const JsonNode& node, double least, double most);

using NameOf = std::function<const std::string&(size_t)>;
std::string someNames(size_t count, const NameOf& nameOf);

/// Indices in [0, count) whose name fits the pattern, or one of the patterns, in `patterns`.
/// A pattern that fits no name is an error, which gives some of the names there are.
/// \param noun what is searched, for messages: "light"
std::vector<size_t> select(const JsonNode& patterns, std::string_view noun, size_t count, const NameOf& nameOf);

template <typename Named>
std::vector<size_t> select(const JsonNode& patterns, std::string_view noun, const std::vector<Named>& list) {
    return select(patterns, noun, list.size(), [&](size_t i) -> const std::string& { return list[i].name; });
}

/// Index of the first element of this name, or the list's size.
template <typename Named>
size_t indexOf(const std::vector<Named>& list, std::string_view name) {
    size_t i = 0;
    while (i < list.size() && list[i].name != name) ++i;
    return i;
}

/// Some of the list's names, for messages: `"a", "b", "c" and 12 more`.
template <typename Named>
std::string someNames(const std::vector<Named>& list) {
    return someNames(list.size(), [&](size_t i) -> const std::string& { return list[i].name; });
}

}  // namespace luciole::rig
