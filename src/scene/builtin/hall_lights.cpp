#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/builtin/hall.hpp"
#include "scene/builtin/shapes.hpp"
#include "scene/random.hpp"

namespace luciole {

namespace {

using namespace hall;

/// Colours of the lamps, linear: the nave is warm, the aisles are cool, a few accents are neither.
constexpr std::array<vec3, 8> kPalette = {vec3{1, 0.5f, 0.18f}, {1, 0.66f, 0.36f}, {1, 0.33f, 0.1f},
                                          {1, 0.58f, 0.25f},    {0.3f, 0.52f, 1},  {0.22f, 0.75f, 0.9f},
                                          {0.55f, 0.4f, 1},     {1, 0.3f, 0.42f}};
constexpr uint32_t kWarm = 0, kCool = 4, kRose = 7;

struct Lamp {
    Light light;
    uint32_t color = 0;  ///< index into kPalette
};

Lamp pointLamp(vec3 position, uint32_t color, float vigour) {
    return {{.positionWorld = position, .color = vigour * kPalette[color]}, color};
}

Lamp spotLamp(vec3 position, vec3 target, float outerCone, uint32_t color) {
    return {{.type = LightType::spot,
             .positionWorld = position,
             .directionWorld = glm::normalize(target - position),
             .color = kPalette[color],
             .innerConeAngle = 0.4f * outerCone,
             .outerConeAngle = outerCone},
            color};
}

/// The kinds of places follow each other in turn, so that any number of lights is spread over all of them. Lamps close
/// to a surface are weaker, or it would be burnt out.
Lamp hang(uint32_t i, float length, int bays, Random& random) {
    const auto between = [&](double low, double high) { return float(random.between(low, high)); };
    const uint32_t warm = kWarm + random.below(4), cool = kCool + random.below(3);
    const float side = random.below(2) == 0 ? -1.0f : 1.0f;
    // The golden ratio's multiples spread evenly for any number of lights.
    const float along = float(std::fmod(0.29 + i * 0.6180339887498949 + random.between(0, 0.02), 1.0));
    const float z = -0.6f - along * (length - 1.2f);
    const float bay = std::floor(along * float(bays));
    const vec2 column(side * kColumnX, -kBay * (bay + float(random.below(2))));
    const float angle = between(0, 2 * kPi);
    const vec2 around(std::cos(angle), std::sin(angle));
    constexpr uint32_t kInApse = 13;
    // Small ranges would leave vault and walls dark: later lamps hang along them instead of in the open.
    const bool crowded = i >= 1024;
    if (i % 48 == kInApse)
        return pointLamp({side * between(0.9, 1.8), between(1.4, 3.6), between(0.5, 1) - length}, warm, 0.8f);
    switch (i % 8) {
        case 0: {
            if (!crowded) return pointLamp({between(-2.4, 2.4), between(2.8, 5.4), z}, warm, 1.5f);
            const float over = between(0, kPi), reach = kNaveX - between(0.3, 0.6);
            return pointLamp({reach * std::cos(over), kCornice + reach * std::sin(over), z}, warm, 0.6f);
        }
        case 1: {
            const vec2 ring = column + between(0.95, 1.35) * around;
            return pointLamp({ring.x, between(1.2, 4), ring.y}, warm, 0.45f);
        }
        case 2:
            if (!crowded) return pointLamp({side * between(4.8, 7.4), between(0.4, 2.8), z}, cool, 0.6f);
            return pointLamp({side * (kWallX - between(0.3, 0.6)), between(0.2, kAisleTop - 0.5), z}, cool, 0.6f);
        case 3:
            return pointLamp({between(-3, 3), between(0.2, 0.55), z}, warm, 0.25f);
        case 4: {
            const float x = side * between(5.2, 7.2), y = kAisleTop - between(0.5, 0.9);
            return spotLamp({x, y, z}, {x + between(-0.6, 0.6), 0, z + between(-0.6, 0.6)}, 0.65f, cool);
        }
        case 5: {
            const vec2 foot = column + 1.05f * around;
            return spotLamp({foot.x, between(0.2, 0.4), foot.y}, {column.x, between(3.5, 5), column.y}, 0.5f, warm);
        }
        case 6: {
            const float alcove = -kBay * (bay + 0.5f);
            return pointLamp({side * (kWallX - between(0.3, 0.8)), between(1.3, 3.2), alcove + between(-0.7, 0.7)},
                             random.below(4) == 0 ? kRose : cool, 0.5f);
        }
        default:
            return pointLamp({side * between(1.8, 2.7), kCornice + between(0.3, 1.2), z},
                             random.below(5) == 0 ? kRose : warm, 0.5f);
    }
}

bool isFree(vec3 position, const std::vector<HallSolid>& solids, float length, vec3 eye) {
    if (glm::distance(position, eye) < 1.2f || position.z > -0.1f || position.z < -length + 0.1f) return false;
    return std::ranges::none_of(solids, [&](const HallSolid& solid) {
        const vec2 away = vec2(position.x, position.z) - solid.centre;
        return position.y < solid.top + 2 * kLampRadius && glm::length(away) < solid.radius + 2 * kLampRadius;
    });
}

}  // namespace

void addHallLights(Scene& scene, const HallOptions& options, int bays, const std::vector<HallSolid>& solids, vec3 eye,
                   uint32_t lamps) {
    Random random(options.seed, 2);
    const float length = kBay * float(bays);
    const uint32_t bead = lamps > 0 ? addMesh(scene, shapes::bead(kLampRadius), "lamp") : kNone;
    std::array<uint32_t, kPalette.size()> glows{};
    for (size_t i = 0; lamps > 0 && i < kPalette.size(); ++i)
        glows[i] = addMaterial(scene, {.name = fmt::format("glow {}", i),
                                       .castsShadows = false,  // the light is inside
                                       .baseColor = vec4(0, 0, 0, 1),
                                       .metallic = 0,
                                       .emissive = 1.8f * kPalette[i]});
    scene.lights.reserve(options.lights);
    for (uint32_t i = 0; i < options.lights; ++i) {
        Lamp lamp = hang(i, length, bays, random);
        while (!isFree(lamp.light.positionWorld, solids, length, eye)) lamp = hang(i, length, bays, random);
        lamp.light.name = fmt::format("lamp {}", i);
        if (i < lamps) addObject(scene, lamp.light.name, bead, glows[lamp.color], placed(lamp.light.positionWorld));
        scene.lights.push_back(std::move(lamp.light));
    }
}

}  // namespace luciole
