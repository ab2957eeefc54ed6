#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/builtin/garden.hpp"
#include "scene/builtin/shapes.hpp"

namespace luciole::garden {

namespace {

constexpr float kQuarter = float(kPi) / 2;

mat4 turned(float angle) { return glm::rotate(mat4(1), angle, vec3(0, 1, 0)); }

/// One of four sides of a roof whose corners curl up, facing +Z and up; eaves at `eaves`, ridge at `ridge`.
Mesh roofSide(float halfWidth, float eaves, float ridge) {
    const auto side = [=](double u, double v) {
        const double across = 2 * u - 1, half = double(halfWidth) * (1 - v) + 0.03;
        const double curl = 0.09 * across * across * across * across * (1 - v) * (1 - v);
        return dvec3(across * half, double(eaves) + double(ridge - eaves) * std::pow(v, 1.6) + curl, half);
    };
    return shapes::patch(10, 8, side, {2 * halfWidth, halfWidth});
}

/// The underside of the same roof.
Mesh roofUnderside(float halfWidth, float eaves) {
    const auto side = [=](double u, double v) {
        const double across = 1 - 2 * u, half = double(halfWidth) * (1 - v) + 0.03;
        const double curl = 0.09 * across * across * across * across * (1 - v) * (1 - v);
        return dvec3(across * half, double(eaves) + curl - 0.02 * v, half);
    };
    return shapes::patch(10, 4, side, {2 * halfWidth, halfWidth});
}

}  // namespace

Lantern lantern() {
    constexpr std::array<vec2, 22> kFoot = {
        vec2{0.34f, 0},  {0.34f, 0.1f},   {0.34f, 0.1f},   {0.31f, 0.13f},  {0.22f, 0.18f},  {0.15f, 0.2f},
        {0.15f, 0.2f},   {0.13f, 0.22f},  {0.115f, 0.35f}, {0.115f, 0.35f}, {0.135f, 0.37f}, {0.135f, 0.41f},
        {0.115f, 0.43f}, {0.115f, 0.43f}, {0.115f, 0.58f}, {0.15f, 0.64f},  {0.15f, 0.64f},  {0.27f, 0.7f},
        {0.31f, 0.74f},  {0.31f, 0.8f},   {0.31f, 0.8f},   {0, 0.8f}};
    constexpr std::array<vec2, 9> kJewel = {vec2{0.1f, 1.38f}, {0.1f, 1.42f},   {0.1f, 1.42f},
                                            {0.045f, 1.44f},   {0.045f, 1.46f}, {0.085f, 1.52f},
                                            {0.075f, 1.58f},   {0.02f, 1.65f},  {0, 1.67f}};
    constexpr float kHalf = 0.19f, kLow = 0.8f, kHigh = 1.16f, kPost = 0.045f;
    Lantern made;
    made.stone = shapes::lathe(shapes::smoothProfile(kFoot, 2), 24);
    shapes::append(made.stone, shapes::lathe(shapes::smoothProfile(kJewel, 2), 16));
    for (int i = 0; i < 4; ++i) {
        const mat4 turn = turned(kQuarter * float(i));
        shapes::append(made.stone, roofSide(0.42f, kHigh, 1.4f), turn);
        shapes::append(made.stone, roofUnderside(0.42f, kHigh), turn);
        shapes::append(made.stone, shapes::box({kHalf - kPost, kLow, kHalf - kPost}, {kHalf, kHigh, kHalf}), turn);
        shapes::append(made.stone, shapes::box({-kHalf, kLow, kHalf - kPost}, {kHalf, kLow + 0.05f, kHalf - 0.005f}),
                       turn);
        shapes::append(made.stone, shapes::box({-0.012f, kLow, kHalf - 0.03f}, {0.012f, kHigh, kHalf - 0.01f}), turn);
        shapes::append(made.stone, shapes::box({-kHalf, 0.97f, kHalf - 0.03f}, {kHalf, 0.994f, kHalf - 0.012f}), turn);
        const float inside = kHalf - 0.025f;
        shapes::append(made.paper, shapes::rectangle({-inside, kLow, inside}, {2 * inside, 0, 0}, {0, kHigh - kLow, 0}),
                       turn);
    }
    return made;
}

Mesh bridge(float length) {
    constexpr int kPlanks = 26;
    constexpr float kHalfWidth = 0.55f, kRise = 0.55f;
    const auto height = [&](float t) { return kRise * (1 - (2 * t - 1) * (2 * t - 1)); };
    const auto at = [&](float t, float above, float z) { return vec3((t - 0.5f) * length, height(t) + above, z); };
    Mesh mesh;
    const float plank = length / kPlanks;
    for (int i = 0; i < kPlanks; ++i) {
        const float t = (float(i) + 0.5f) / kPlanks;
        const float slope = std::atan2(height(t + 0.01f) - height(t - 0.01f), 0.02f * length);
        const mat4 place = glm::rotate(glm::translate(mat4(1), at(t, 0, 0)), slope, vec3(0, 0, 1));
        shapes::append(mesh, shapes::box({-0.46f * plank, -0.05f, -kHalfWidth}, {0.46f * plank, 0, kHalfWidth}), place);
    }
    constexpr int kPosts = 6;
    for (const float z : {-kHalfWidth, kHalfWidth}) {
        for (int i = 0; i <= kPosts; ++i) {
            const float t = 0.03f + 0.94f * float(i) / kPosts;
            shapes::append(mesh, shapes::limb(at(t, -0.25f, z), at(t, 0.62f, z), 0.045f, 0.04f, 8));
            shapes::append(mesh, shapes::sphere(0.055f, 8, 5), glm::translate(mat4(1), at(t, 0.64f, z)));
        }
        constexpr int kPieces = 12;
        for (int i = 0; i < kPieces; ++i) {
            const float a = 0.03f + 0.94f * float(i) / kPieces, b = 0.03f + 0.94f * float(i + 1) / kPieces;
            shapes::append(mesh, shapes::limb(at(a, 0.56f, z), at(b, 0.56f, z), 0.032f, 0.032f, 8));
            shapes::append(mesh, shapes::limb(at(a, 0.3f, z), at(b, 0.3f, z), 0.022f, 0.022f, 6));
            shapes::append(mesh, shapes::limb(at(a, -0.1f, z), at(b, -0.1f, z), 0.06f, 0.06f, 8));
        }
    }
    return mesh;
}

}  // namespace luciole::garden
