#pragma once
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <luciole/math.hpp>
#include <luciole/scene_io.hpp>
#include <nlohmann/json.hpp>

namespace luciole {

/// Parses untrusted JSON. Depth, the size of every array and object, and the number of values in all are checked before
/// a document is built.
/// \throws Error(scene) with line and column for a syntax error or a key given twice, Error(limit) beyond `limits`
nlohmann::json parseJson(std::string_view text, const std::string& nameForErrors, const LoadLimits& limits);

/// A value of a JSON document together with the JSON pointer (RFC 6901) that leads to it. Every accessor checks the
/// type and throws Error(scene): `hall.json: /lights/3/range: expected a number > 0, got -1`.
/// Refers to the document and to the file name: both must live longer.
class JsonNode {
public:
    JsonNode(const nlohmann::json& document, const std::string& nameForErrors)
        : value_(&document), file_(&nameForErrors) {}

    const nlohmann::json& raw() const { return *value_; }
    const std::string& path() const { return path_; }  ///< empty for the document itself
    std::string where() const;                         ///< `FILE: PATH`, as messages begin

    bool isObject() const { return value_->is_object(); }
    bool isArray() const { return value_->is_array(); }
    bool isNull() const { return value_->is_null(); }
    bool isString() const { return value_->is_string(); }
    bool isNumber() const { return value_->is_number(); }

    /// `FILE: PATH: expected EXPECTED, got <this value>`
    [[noreturn]] void fail(std::string_view expected) const;
    /// `FILE: PATH: MESSAGE`
    [[noreturn]] void failWith(std::string_view message) const;

    // Objects.
    std::optional<JsonNode> find(std::string_view key) const;  ///< nothing if the key is absent
    JsonNode at(std::string_view key) const;                   ///< a missing key is an error
    std::vector<std::pair<std::string, JsonNode>> members() const;
    /// Any key that is neither in `known` nor in `more` is an error.
    void expectKeys(std::initializer_list<std::string_view> known, std::span<const std::string_view> more = {}) const;

    // Arrays.
    size_t size() const;
    JsonNode operator[](size_t index) const;
    std::vector<JsonNode> elements() const;

    // Plain values. Numbers fit into a float, as that is where they end up.
    static constexpr double kMost = double(std::numeric_limits<float>::max());
    double number(double low = -kMost, double high = kMost) const;  ///< in [low, high]
    double positiveNumber() const;                                  ///< > 0
    uint64_t integer(uint64_t low, uint64_t high) const;            ///< whole, in [low, high]
    bool boolean() const;
    const std::string& string() const;
    /// One of `names`; returns its index.
    size_t choice(std::initializer_list<std::string_view> names) const;
    vec3 vector3() const;  ///< [x, y, z]

private:
    JsonNode(const nlohmann::json& value, const std::string* file, std::string path)
        : value_(&value), file_(file), path_(std::move(path)) {}

    const nlohmann::json* value_;
    const std::string* file_;
    std::string path_;
};

}  // namespace luciole
