#include "scene/json.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <luciole/error.hpp>

namespace luciole {
namespace {

using nlohmann::json;

/// All values together may be this many times what one array may hold: a light or an accessor has about so many
/// members.
constexpr uint64_t kValuesPerElement = 16;

/// Walks the text without building anything and stops at the first thing beyond the limits.
class Wall : public nlohmann::json_sax<json> {
public:
    Wall(const std::string& file, const LoadLimits& limits) : file_(file), limits_(limits) {}

    bool null() override { return count(); }
    bool boolean(bool) override { return count(); }
    bool number_integer(int64_t) override { return count(); }
    bool number_unsigned(uint64_t) override { return count(); }
    bool number_float(double, const std::string&) override { return count(); }
    bool string(std::string&) override { return count(); }
    bool binary(json::binary_t&) override { return count(); }
    bool start_object(size_t) override { return open(); }
    bool start_array(size_t) override { return open(); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(std::string& name) override {
        if (!levels_.back().keys.insert(name).second) {
            throw Error(ErrorKind::scene, fmt::format("{}: key \"{}\" is given twice in one object", file_, name));
        }
        return true;
    }

    bool parse_error(size_t, const std::string&, const nlohmann::detail::exception& error) override {
        std::string_view what =
            error.what();  // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
        if (const size_t end = what.find("] "); end != what.npos) what.remove_prefix(end + 2);
        throw Error(ErrorKind::scene, fmt::format("{}: {}", file_, what));
    }

private:
    struct Level {
        uint64_t values = 0;
        std::set<std::string> keys;
    };

    bool count() {
        if (++values_ / kValuesPerElement > limits_.maxElements) {
            throw Error(ErrorKind::limit, fmt::format("{}: expected at most {} values in all, got more", file_,
                                                      limits_.maxElements * kValuesPerElement));
        }
        if (!levels_.empty() && ++levels_.back().values > limits_.maxElements) {
            throw Error(ErrorKind::limit,
                        fmt::format("{}: expected at most {} elements in an array or object, got more", file_,
                                    limits_.maxElements));
        }
        return true;
    }
    bool open() {
        count();
        levels_.emplace_back();
        if (levels_.size() > limits_.maxJsonDepth) {
            throw Error(ErrorKind::limit,
                        fmt::format("{}: expected nesting of at most {}, got more", file_, limits_.maxJsonDepth));
        }
        return true;
    }
    bool close() {
        levels_.pop_back();
        return true;
    }

    const std::string& file_;
    const LoadLimits& limits_;
    std::vector<Level> levels_;
    uint64_t values_ = 0;
};

std::string escaped(std::string_view key) {
    std::string result;
    for (const char c : key) {
        if (c == '~') {
            result += "~0";
        } else if (c == '/') {
            result += "~1";
        } else {
            result += c;
        }
    }
    return result;
}

std::string describe(const json& value) {
    constexpr size_t kLongest = 60;
    if (value.is_object()) return "an object";
    if (value.is_array()) return fmt::format("an array of {}", value.size());
    const std::string text = value.dump(-1, ' ', true);  // ASCII only, so that a cut can't split a character
    return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

}  // namespace

json parseJson(std::string_view text, const std::string& nameForErrors, const LoadLimits& limits) {
    Wall wall(nameForErrors, limits);
    json::sax_parse(text, &wall);
    return json::parse(text);
}

std::string JsonNode::where() const { return fmt::format("{}: {}", *file_, path_.empty() ? "/" : path_); }

void JsonNode::failWith(std::string_view message) const {
    throw Error(ErrorKind::scene, fmt::format("{}: {}", where(), message));
}

void JsonNode::fail(std::string_view expected) const {
    failWith(fmt::format("expected {}, got {}", expected, describe(*value_)));
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
    if (!isObject()) fail("an object");
    const auto found = value_->find(key);
    if (found == value_->end()) return std::nullopt;
    return JsonNode(*found, file_, fmt::format("{}/{}", path_, escaped(key)));
}

JsonNode JsonNode::at(std::string_view key) const {
    if (auto found = find(key)) return *found;
    failWith(fmt::format("expected a key \"{}\", got none", key));
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
    if (!isObject()) fail("an object");
    std::vector<std::pair<std::string, JsonNode>> result;
    for (const auto& [key, value] : value_->items()) {
        result.emplace_back(key, JsonNode(value, file_, fmt::format("{}/{}", path_, escaped(key))));
    }
    return result;
}

void JsonNode::expectKeys(std::initializer_list<std::string_view> known, std::span<const std::string_view> more) const {
    std::vector<std::string_view> all(known);
    all.insert(all.end(), more.begin(), more.end());
    for (const auto& [key, member] : members()) {
        if (std::find(all.begin(), all.end(), key) == all.end()) {
            member.failWith(fmt::format("unknown key; expected one of {}", fmt::join(all, ", ")));
        }
    }
}

size_t JsonNode::size() const {
    if (!isArray()) fail("an array");
    return value_->size();
}

JsonNode JsonNode::operator[](size_t index) const {
    if (index >= size()) fail(fmt::format("at least {} elements", index + 1));
    return JsonNode((*value_)[index], file_, fmt::format("{}/{}", path_, index));
}

std::vector<JsonNode> JsonNode::elements() const {
    std::vector<JsonNode> result;
    result.reserve(size());
    for (size_t i = 0; i < size(); ++i) result.push_back((*this)[i]);
    return result;
}

double JsonNode::number(double low, double high) const {
    const double value = isNumber() ? value_->get<double>() : std::nan("");
    if (value >= low && value <= high) return value;
    if (low == -kMost && high == kMost) fail("a number that fits into 32 bits");
    if (high == kMost) fail(fmt::format("a number >= {}", low));
    fail(fmt::format("a number in [{}, {}]", low, high));
}

double JsonNode::positiveNumber() const {
    const double value = isNumber() ? value_->get<double>() : 0;
    if (!(value >= double(std::numeric_limits<float>::min()) && value <= kMost)) fail("a number > 0");
    return value;
}

uint64_t JsonNode::integer(uint64_t low, uint64_t high) const {
    // 3.0 is a whole number in JSON, too.
    const double value = isNumber() ? value_->get<double>() : -1;
    const bool whole = value_->is_number_unsigned() || (value >= 0 && value < 0x1p53 && value == std::floor(value));
    const uint64_t result = !whole ? 0 : value_->is_number_unsigned() ? value_->get<uint64_t>() : uint64_t(value);
    if (!whole || result < low || result > high) fail(fmt::format("a whole number in [{}, {}]", low, high));
    return result;
}

bool JsonNode::boolean() const {
    if (!value_->is_boolean()) fail("true or false");
    return value_->get<bool>();
}

const std::string& JsonNode::string() const {
    if (!isString()) fail("a string");
    return value_->get_ref<const std::string&>();
}

size_t JsonNode::choice(std::initializer_list<std::string_view> names) const {
    const auto found = isString() ? std::find(names.begin(), names.end(), string()) : names.end();
    if (found == names.end()) fail(fmt::format("one of {}", fmt::join(names, ", ")));
    return size_t(found - names.begin());
}

vec3 JsonNode::vector3() const {
    if (!isArray() || size() != 3) fail("three numbers");
    return vec3((*this)[0].number(), (*this)[1].number(), (*this)[2].number());
}

}  // namespace luciole
