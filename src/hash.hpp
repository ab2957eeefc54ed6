#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include <luciole/math.hpp>

namespace luciole {

/// FNV-1a, 64 bits (Fowler, Noll and Vo), of what is added. For telling things apart, not against an adversary.
class Hash {
public:
    template <typename T>
        requires std::is_arithmetic_v<T>
    Hash& add(T value) {
        for (const unsigned char byte : std::bit_cast<std::array<unsigned char, sizeof value>>(value)) hash_ = (hash_ ^ byte) * 0x100000001b3u;
        return *this;
    }
    Hash& add(std::string_view text) {
        for (const char letter : text) add(letter);
        return *this;
    }
    template <glm::length_t L, typename T, glm::qualifier Q>
    Hash& add(const glm::vec<L, T, Q>& v) {
        for (glm::length_t i = 0; i < L; ++i) add(v[i]);
        return *this;
    }
    template <glm::length_t C, glm::length_t R, typename T, glm::qualifier Q>
    Hash& add(const glm::mat<C, R, T, Q>& m) {
        for (glm::length_t i = 0; i < C; ++i) add(m[i]);
        return *this;
    }
    uint64_t value() const { return hash_; }

private:
    uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace luciole
