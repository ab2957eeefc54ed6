#pragma once
#include <cmath>
#include <span>
#include <utility>

#include <luciole/scene.hpp>

/// Light volumes whose insides have closed forms. All are oriented outwards.
namespace luciole::test {

inline void append(LightVolume& volume, const LightVolume& more) {
    const auto first = uint32_t(volume.positionsWorld.size());
    volume.positionsWorld.insert(volume.positionsWorld.end(), more.positionsWorld.begin(), more.positionsWorld.end());
    for (const uint32_t index : more.indices) volume.indices.push_back(first + index);
}

/// What is between y = low and y = high over a polygon in the XZ plane.
/// \param outline seen from above (+Y), counter-clockwise with +X right and +Z down, so that x grows to the right
/// \param fan index of a corner from which all of the polygon is seen
inline LightVolume prismVolume(std::span<const vec2> outline, float low, float high, uint32_t fan = 0) {
    LightVolume volume{.name = "prism", .positionsWorld = {}, .indices = {}};
    const auto n = uint32_t(outline.size());
    for (const vec2& p : outline) {
        volume.positionsWorld.emplace_back(p.x, low, p.y);
        volume.positionsWorld.emplace_back(p.x, high, p.y);
    }
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t a = 2 * i, b = 2 * ((i + 1) % n);
        volume.indices.insert(volume.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
    for (uint32_t i = 1; i + 1 < n; ++i) {
        const uint32_t o = 2 * fan, a = 2 * ((fan + i) % n), b = 2 * ((fan + i + 1) % n);
        volume.indices.insert(volume.indices.end(), {o + 1, a + 1, b + 1, o, b, a});
    }
    return volume;
}

inline LightVolume boxVolume(vec3 low, vec3 high) {
    const vec2 outline[] = {{low.x, high.z}, {high.x, high.z}, {high.x, low.z}, {low.x, low.z}};
    return prismVolume(outline, low.y, high.y);
}

/// Torus round the Y axis.
/// \param major from the axis to the tube's middle; \param minor the tube's radius, at the vertices
inline LightVolume torusVolume(float major, float minor, uint32_t around, uint32_t across) {
    LightVolume volume{.name = "torus", .positionsWorld = {}, .indices = {}};
    for (uint32_t i = 0; i < around; ++i)
        for (uint32_t j = 0; j < across; ++j) {
            const double u = 2 * kPi * i / around, v = 2 * kPi * j / across;
            const double r = double(major) + double(minor) * std::cos(v);
            volume.positionsWorld.emplace_back(r * std::sin(u), double(minor) * std::sin(v), r * std::cos(u));
        }
    for (uint32_t i = 0; i < around; ++i)
        for (uint32_t j = 0; j < across; ++j) {
            const uint32_t a = i * across, b = (i + 1) % around * across, k = (j + 1) % across;
            volume.indices.insert(volume.indices.end(), {a + j, b + j, b + k, a + j, b + k, a + k});
        }
    return volume;
}

inline LightVolume turnedOver(LightVolume volume) {
    for (size_t i = 0; i < volume.indices.size(); i += 3) std::swap(volume.indices[i], volume.indices[i + 1]);
    return volume;
}

}  // namespace luciole::test
