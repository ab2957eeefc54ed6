#include <algorithm>
#include <array>
#include <cmath>

#include "scene/builtin/garden.hpp"
#include "scene/builtin/shapes.hpp"

namespace luciole::garden {

namespace {

float ellipse(vec2 xz, vec2 centre, vec2 radii) {
    const vec2 q = (xz - centre) / radii;
    const float angle = std::atan2(q.y, q.x);
    return glm::length(q) * (1 + 0.07f * std::sin(3 * angle + 0.6f) + 0.04f * std::sin(5 * angle));
}

/// Gives each vertex the colour that `color` has at its position.
template <class Color>
void paint(Mesh& mesh, const Color& color) {
    for (Vertex& vertex : mesh.vertices) vertex.color = vec4(glm::clamp(color(vertex), vec3(0), vec3(1)), 1);
}

}  // namespace

float pondEdge(vec2 xz) {
    return std::min(ellipse(xz, {1.4f, -1.1f}, {3.3f, 2.1f}), ellipse(xz, {2.8f, -5.2f}, {1.5f, 3.6f}));
}

float groundHeight(vec2 xz) {
    const float waves = 0.10f * std::sin(0.71f * xz.x + 1.3f) * std::cos(0.63f * xz.y) +
                        0.04f * std::sin(1.9f * xz.x) * std::sin(1.7f * xz.y + 0.5f);
    const float back = std::max(0.0f, -xz.y - 4);
    const float rise = 0.011f * back * back;
    const float land = 0.2f + waves + std::min(rise, 2.2f);
    return glm::mix(-0.5f, land, glm::smoothstep(0.82f, 1.2f, pondEdge(xz)));
}

vec2 pathAt(float t) { return {glm::mix(0.35f, -1.15f, t) + 0.35f * std::sin(2.6f * t), glm::mix(5.4f, 1.7f, t)}; }

Mesh ground() {
    constexpr int kCells = 56;
    const auto height = [](double u, double v) {
        // Finer near the middle: the cubic keeps half of the cells within a quarter of the width.
        const auto spread = [](double s) { return 26 * (0.35 * s + 0.65 * s * s * s); };
        const double x = spread(2 * u - 1), z = -3 - spread(2 * v - 1);
        return dvec3(x, double(groundHeight({float(x), float(z)})), z);
    };
    Mesh mesh = shapes::patch(kCells, kCells, height, {52, 52});
    paint(mesh, [](const Vertex& v) {
        const float wet = 1 - glm::smoothstep(0.95f, 1.35f, pondEdge({v.position.x, v.position.z}));
        const float patchy = 0.5f + 0.5f * std::sin(2.3f * v.position.x + std::sin(1.7f * v.position.z));
        return glm::mix(glm::mix(vec3(0.035f, 0.06f, 0.02f), vec3(0.06f, 0.085f, 0.025f), patchy),
                        vec3(0.07f, 0.06f, 0.045f), wet);
    });
    return mesh;
}

Mesh water() {
    constexpr std::array<vec3, 5> kWaves = {
        vec3{2.1f, 3.9f, 0.3f}, {5.2f, -3.3f, 1.9f}, {-6.7f, 7.9f, 4.1f}, {12.3f, 9.1f, 2.2f}, {-3.1f, 13.7f, 0.7f}};
    const auto surface = [&](double u, double v) {
        const double x = -3 + 9 * u, z = 2.5 - 12 * v;
        double y = kWaterLevel;
        for (const vec3 wave : kWaves)
            y += 0.009 / std::hypot(wave.x, wave.y) * std::sin(wave.x * x + wave.y * z + wave.z);
        return dvec3(x, y, z);
    };
    Mesh mesh = shapes::patch(44, 56, surface, {9, 12});
    // What lies far away mirrors more of the sky.
    paint(mesh, [](const Vertex& v) {
        return glm::mix(vec3(0.22f, 0.27f, 0.34f), vec3(0.85f, 0.8f, 0.9f),
                        1 - glm::smoothstep(-8.0f, 1.5f, v.position.z));
    });
    return mesh;
}

Mesh sky(vec3 glow) {
    constexpr double kRadius = 90;
    const auto dome = [](double u, double v) {
        const double longitude = 2 * kPi * u, latitude = kPi / 2 * (1.12 * v * v - 0.12);
        return kRadius * dvec3(std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                               std::cos(latitude) * std::sin(longitude));
    };
    Mesh mesh = shapes::patch(48, 20, dome, {1, 1});
    paint(mesh, [&](const Vertex& v) {
        const vec3 direction = glm::normalize(v.position);
        const float up = std::max(direction.y, 0.0f);
        const float towards =
            0.5f + 0.5f * glm::dot(glm::normalize(vec3(direction.x, 0, direction.z) + vec3(1e-6f)), glow);
        const vec3 zenith(0.008f, 0.016f, 0.05f), middle(0.03f, 0.055f, 0.15f), low(0.13f, 0.12f, 0.22f);
        const vec3 blue =
            glm::mix(glm::mix(low, middle, glm::smoothstep(0.0f, 0.2f, up)), zenith, glm::smoothstep(0.12f, 0.7f, up));
        const float width = std::pow(towards, 6.0f);
        return blue + width * (vec3(0.55f, 0.19f, 0.05f) * std::exp(-up / 0.07f) +
                               vec3(0.2f, 0.06f, 0.09f) * std::exp(-up / 0.2f));
    });
    return mesh;
}

Mesh hills(float distance, float height, Random random) {
    std::array<float, 6> phases;
    for (float& phase : phases) phase = float(random.between(0, 2 * kPi));
    const auto slope = [&](double u, double v) {
        const double angle = 2 * kPi * u;
        double crest = 0.55;
        for (size_t i = 0; i < phases.size(); ++i)
            crest += 0.3 / double(i + 1) * std::sin(double(3 + 4 * i) * angle + double(phases[i]));
        const double radius = distance - 6 * (1 - v);
        return dvec3(radius * std::cos(angle), height * std::max(crest, 0.1) * v - 1 + v, radius * std::sin(angle));
    };
    return shapes::patch(280, 1, slope, {280, 1});
}

}  // namespace luciole::garden
