#include "scene/rig/values.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace luciole::rig {
namespace {

/// Bytes of the UTF-8 character that starts `text`, at least 1.
size_t characterSize(std::string_view text) {
    size_t size = 1;
    while (size < text.size() && (uint8_t(text[size]) & 0xC0) == 0x80) ++size;
    return size;
}

double linearFromSrgb(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

vec3 hexColor(const JsonNode& node) {
    const std::string& text = node.string();
    bool good = text.size() == 7 && text[0] == '#';
    vec3 result(0);
    for (int i = 0; good && i < 3; ++i) {
        const int high = hexDigit(text[size_t(2 * i + 1)]), low = hexDigit(text[size_t(2 * i + 2)]);
        good = high >= 0 && low >= 0;
        result[i] = float(linearFromSrgb((high * 16 + low) / 255.0));
    }
    if (!good) node.fail("a colour as \"#rrggbb\" or [r, g, b]");
    return result;
}

}  // namespace

bool matches(std::string_view pattern, std::string_view name) {
    // After a mismatch only the latest star needs to take in one more character: earlier ones can't do better.
    constexpr size_t kNoStar = ~size_t(0);
    size_t p = 0, n = 0, afterStar = kNoStar, starEnd = 0;
    while (n < name.size()) {
        const bool escaped = p + 1 < pattern.size() && pattern[p] == '\\';
        if (p < pattern.size() && pattern[p] == '*') {
            afterStar = ++p;
            starEnd = n;
        } else if (p < pattern.size() && pattern[p] == '?') {
            ++p;
            n += characterSize(name.substr(n));
        } else if (p < pattern.size() && pattern[p + escaped] == name[n]) {
            p += 1 + size_t(escaped);
            ++n;
        } else if (afterStar != kNoStar) {
            p = afterStar;
            n = starEnd += characterSize(name.substr(starEnd));
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

vec3 color(const JsonNode& node) {
    if (node.isString()) return hexColor(node);
    if (!node.isArray() || node.size() != 3) node.fail("a colour as \"#rrggbb\" or [r, g, b]");
    return vec3(node[0].number(0), node[1].number(0), node[2].number(0));
}

vec3 direction(const JsonNode& node) {
    const dvec3 value(node.vector3());
    const double length = glm::length(value);
    if (!(length > 0)) node.fail("a direction other than zero");
    return vec3(value / length);
}

double between(const JsonNode& node, double low, double high) {
    const double value = node.isNumber() ? node.number() : low;
    if (!(value > low && value < high)) node.fail(fmt::format("a number above {} and below {}", low, high));
    return value;
}

dvec2 interval(const JsonNode& node, double least, double most) {
    if (node.isNumber()) return dvec2(node.number(least, most));
    if (!node.isArray() || node.size() != 2) node.fail("a number or [low, high]");
    const dvec2 ends(node[0].number(least, most), node[1].number(least, most));
    if (ends.x > ends.y)
        node.failWith(fmt::format("expected [low, high] with low <= high, got [{}, {}]", ends.x, ends.y));
    return ends;
}

std::string someNames(size_t count, const NameOf& nameOf) {
    constexpr size_t kShown = 8;
    std::string result;
    for (size_t i = 0; i < std::min(count, kShown); ++i) {
        result += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", nameOf(i));
    }
    if (count > kShown) result += fmt::format(" and {} more", count - kShown);
    return count == 0 ? "none" : result;
}

std::vector<size_t> select(const JsonNode& patterns, std::string_view noun, size_t count, const NameOf& nameOf) {
    if (!patterns.isString() && !patterns.isArray()) patterns.fail("a pattern or an array of patterns");
    if (patterns.isArray() && patterns.size() == 0) patterns.fail("at least one pattern");
    const std::vector<JsonNode> each = patterns.isArray() ? patterns.elements() : std::vector{patterns};
    std::vector<bool> chosen(count);
    for (const JsonNode& node : each) {
        const std::string& pattern = node.string();
        bool any = false;
        for (size_t i = 0; i < count; ++i) {
            if (!matches(pattern, nameOf(i))) continue;
            chosen[i] = any = true;
        }
        if (!any)
            node.failWith(
                fmt::format("pattern \"{}\" matches no {}; there are: {}", pattern, noun, someNames(count, nameOf)));
    }
    std::vector<size_t> result;
    for (size_t i = 0; i < count; ++i) {
        if (chosen[i]) result.push_back(i);
    }
    return result;
}

}  // namespace luciole::rig
