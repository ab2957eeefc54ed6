#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/builtin/garden.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/builtin/shapes.hpp"

/// A garden at dusk: a stone lantern by a pond, a maple over it, a footbridge behind, the last glow over the hills, and
/// the fireflies.
namespace luciole {

namespace {

using namespace garden;

constexpr vec2 kLantern(-1.55f, 1.15f);
constexpr vec2 kMaple(-3.2f, -1.6f);
const vec3 kEye(0.35f, 1.5f, 6.6f);

float between(Random& random, double low, double high) { return float(random.between(low, high)); }

vec3 onGround(vec2 xz, float above = 0) { return {xz.x, groundHeight(xz) + above, xz.y}; }

float distanceToPath(vec2 xz) {
    float nearest = 1e9f;
    for (int i = 0; i <= 24; ++i) nearest = std::min(nearest, glm::distance(xz, pathAt(float(i) / 24)));
    return nearest;
}

Material matte(const char* name, vec3 color, float roughness = 0.9f) {
    return {.name = name, .baseColor = vec4(color, 1), .metallic = 0, .roughness = roughness};
}

/// Of what the garden is set in: no light shines on it, and it keeps none off.
Material unlit(const char* name, vec3 color = vec3(1)) {
    Material material = matte(name, color);
    material.equation = LightEquation::unlit;
    material.castsShadows = false;
    return material;
}

Material foliage(const char* name) {
    Material material = matte(name, vec3(1), 0.7f);
    material.doubleSided = true;
    return material;
}

/// Far things and the water: what the garden is set in.
void addSetting(Scene& scene, const Random& random) {
    const vec3 glow = glm::normalize(vec3(-0.05f, 0, -1));
    addObject(scene, "sky", addMesh(scene, sky(glow), "sky"), addMaterial(scene, unlit("sky")));
    addObject(scene, "far hills", addMesh(scene, hills(80, 11, random), "far hills"),
              addMaterial(scene, unlit("far hills", {0.035f, 0.04f, 0.085f})));
    Random nearRandom = random;
    nearRandom.next();
    addObject(scene, "near hills", addMesh(scene, hills(52, 5, nearRandom), "near hills"),
              addMaterial(scene, unlit("near hills", {0.011f, 0.016f, 0.03f})));
    addObject(scene, "ground", addMesh(scene, ground(), "ground"), addMaterial(scene, matte("earth", vec3(1), 0.95f)));
    // Nothing is mirrored here, so the water's own colour stands for the sky in it, as a metal's would.
    addObject(
        scene, "water", addMesh(scene, water(), "water"),
        addMaterial(scene,
                    {.name = "water", .baseColor = vec4(0.32f, 0.38f, 0.5f, 1), .metallic = 1, .roughness = 0.2f}));
    const vec3 moon = 84.0f * glm::normalize(vec3(0.2f, 0.215f, -1));
    Material glowing = matte("moon", vec3(0));
    glowing.emissive = vec3(1.5f, 1.42f, 1.2f);
    glowing.castsShadows = false;
    addObject(scene, "moon", addMesh(scene, shapes::sphere(1.15f, 32, 16), "moon"), addMaterial(scene, glowing),
              placed(moon));
}

void addStars(Scene& scene, Random random) {
    Material glowing = matte("star", vec3(0));
    glowing.emissive = vec3(0.8f, 0.85f, 1);
    glowing.castsShadows = false;
    const uint32_t star = addMesh(scene, shapes::bead(1), "star"), material = addMaterial(scene, glowing);
    for (int i = 0; i < 220; ++i) {
        const float longitude = between(random, -1.1, 1.1), latitude = between(random, 0.12, 0.75);
        const vec3 direction(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                             -std::cos(longitude) * std::cos(latitude));
        const float size = 0.035f + 0.07f * std::pow(between(random, 0, 1), 4.0f);
        addObject(scene, fmt::format("star {}", i), star, material, placed(86.0f * direction, 0, size));
    }
}

void addTrees(Scene& scene, Random random) {
    struct Planted {
        const char* name;
        vec2 at;
        float size;
        int kind;
    };
    enum Kind { maple, oak, farMaple, farOak };
    constexpr std::array<Planted, 9> kTrees = {{{"maple", kMaple, 1, maple},
                                                {"oak", {5.6f, -2.6f}, 1.15f, oak},
                                                {"oak", {-7.4f, -6.5f}, 1.2f, farOak},
                                                {"oak", {7.4f, -8.5f}, 1.1f, farOak},
                                                {"maple", {1.6f, -10.5f}, 0.7f, farMaple},
                                                {"oak", {-3.2f, -11}, 0.85f, farOak},
                                                {"oak", {11, -12}, 1.2f, farOak},
                                                {"oak", {-11, -11}, 1.3f, farOak},
                                                {"maple", {5.2f, -13.5f}, 0.8f, farMaple}}};
    const uint32_t bark = addMaterial(scene, matte("bark", {0.1f, 0.075f, 0.055f}));
    const uint32_t leaves = addMaterial(scene, foliage("leaves"));
    struct Meshes {
        uint32_t wood, leaves;
    };
    const auto addKind = [&](const char* name, float height, vec3 tint, int levels) {
        Tree made = tree(Random(random.next()), height, tint, levels);
        return Meshes{addMesh(scene, std::move(made.wood), fmt::format("{} wood", name)),
                      addMesh(scene, std::move(made.leaves), fmt::format("{} leaves", name))};
    };
    const vec3 crimson(0.5f, 0.1f, 0.035f), green(0.09f, 0.17f, 0.06f);
    const std::array<Meshes, 4> kinds = {addKind("maple", 4.4f, crimson, 5), addKind("oak", 5.2f, green, 5),
                                         addKind("far maple", 4.4f, crimson, 4), addKind("far oak", 5.2f, green, 4)};
    int number = 0;
    for (const Planted& planted : kTrees) {
        const Meshes& kind = kinds[size_t(planted.kind)];
        const mat4 place = placed(onGround(planted.at), between(random, 0, 2 * kPi), planted.size);
        addObject(scene, fmt::format("{} {}", planted.name, number), kind.wood, bark, place);
        addObject(scene, fmt::format("{} {} leaves", planted.name, number++), kind.leaves, leaves, place);
    }
}

void addStones(Scene& scene, Random random) {
    std::array<uint32_t, 3> kinds{};
    for (size_t i = 0; i < kinds.size(); ++i)
        kinds[i] = addMesh(scene, stone(Random(random.next())), fmt::format("stone {}", i));
    const uint32_t material = addMaterial(scene, matte("stone", vec3(1), 0.8f));
    int number = 0;
    const auto lay = [&](vec3 at, vec3 size) {
        const mat4 place = glm::scale(placed(at, between(random, 0, 2 * kPi)), size);
        addObject(scene, fmt::format("stone {}", number++), kinds[random.below(3)], material, place);
    };
    constexpr int kSteps = 9;
    for (int i = 0; i < kSteps; ++i) {
        const vec2 at = pathAt(float(i) / (kSteps - 1)) + 0.06f * vec2(between(random, -1, 1), between(random, -1, 1));
        lay(onGround(at, 0.0f), vec3(between(random, 0.22, 0.28), 0.09f, between(random, 0.22, 0.28)));
    }
    // Around the shore, where the ground dips under the water.
    for (int tries = 0, laid = 0; tries < 4000 && laid < 46; ++tries) {
        const vec2 at(between(random, -2.6, 5.5), between(random, -7, 1.6));
        const float edge = pondEdge(at);
        if (edge < 0.93f || edge > 1.12f || glm::distance(at, kLantern) < 0.6f) continue;
        const float size = between(random, 0.1, 0.34);
        lay(onGround(at, 0.1f * size), vec3(size));
        ++laid;
    }
}

void addGrass(Scene& scene, Random random) {
    constexpr int kKinds = 6, kTufts = 820;
    std::array<uint32_t, kKinds> tufts{};
    for (uint32_t& tuft : tufts) tuft = addMesh(scene, grassTuft(Random(random.next())), "grass");
    const uint32_t reed = addMesh(scene, reeds(Random(random.next())), "reeds");
    const uint32_t grass = addMaterial(scene, foliage("grass"));
    int number = 0;
    for (int tries = 0; tries < 40 * kTufts && number < kTufts; ++tries) {
        // More of it near the eye, where each blade shows.
        const float away = 1.4f + 13 * std::pow(between(random, 0, 1), 1.6f);
        const float angle = between(random, -0.62, 0.62);
        const vec2 at = vec2(kEye.x, kEye.z) + away * vec2(std::sin(angle), -std::cos(angle));
        if (pondEdge(at) < 1.1f || distanceToPath(at) < 0.34f || glm::distance(at, kLantern) < 0.42f) continue;
        // Low where it stands before the eye, so that it frames the pond and does not hide it.
        const float size = between(random, 0.75, 1.3) * glm::mix(0.42f, 1.0f, glm::smoothstep(1.4f, 6.5f, away));
        addObject(scene, fmt::format("grass {}", number++), tufts[random.below(kKinds)], grass,
                  placed(onGround(at, -0.02f), between(random, 0, 2 * kPi), size));
    }
    number = 0;
    for (int tries = 0; tries < 4000 && number < 44; ++tries) {
        const vec2 at(between(random, -2.5, 5.5), between(random, -6, 0.4));
        const float edge = pondEdge(at);
        // They stand in groups, and leave the near shore open.
        if (edge < 0.86f || edge > 1.06f || std::sin(2.1f * at.x + 1.3f * at.y) < 0.25f) continue;
        addObject(scene, fmt::format("reeds {}", number++), reed, grass,
                  placed(onGround(at), between(random, 0, 2 * kPi), between(random, 0.7, 1.1)));
    }
}

void addLilies(Scene& scene, Random random) {
    const uint32_t pad = addMesh(scene, lilyPad(), "lily pad"), flower = addMesh(scene, lotus(), "lotus");
    Material green = foliage("lily pad");
    green.baseColor = {0.07f, 0.17f, 0.07f, 1};
    green.roughness = 0.4f;
    const uint32_t padMaterial = addMaterial(scene, green), petals = addMaterial(scene, foliage("lotus"));
    constexpr std::array<vec2, 4> kGroups = {vec2{0.55f, -0.15f}, {2.5f, -0.4f}, {1.7f, -1.9f}, {3.4f, -1.5f}};
    int number = 0;
    for (const vec2 group : kGroups) {
        std::vector<vec3> laid;  // x, z, radius
        for (int tries = 0; tries < 60 && laid.size() < 8; ++tries) {
            const vec2 at = group + vec2(between(random, -0.75, 0.75), between(random, -0.5, 0.5));
            const float radius = between(random, 0.1, 0.24);
            const bool overlaps = std::ranges::any_of(
                laid, [&](vec3 other) { return glm::distance(vec2(other), at) < 0.95f * (radius + other.z); });
            if (overlaps || pondEdge(at) > 0.85f) continue;
            laid.push_back(vec3(at, radius));
            addObject(scene, fmt::format("lily pad {}", number++), pad, padMaterial,
                      placed({at.x, kWaterLevel + 0.012f, at.y}, between(random, 0, 2 * kPi), radius));
        }
        addObject(scene, fmt::format("lotus {}", number), flower, petals,
                  placed({group.x + 0.1f, kWaterLevel + 0.03f, group.y + 0.12f}, between(random, 0, 2 * kPi), 0.17f));
    }
}

void addBuilt(Scene& scene) {
    const Lantern made = lantern();
    const mat4 place = placed(onGround(kLantern, -0.02f), 0.5f);
    addObject(scene, "lantern", addMesh(scene, made.stone, "lantern"),
              addMaterial(scene, matte("granite", {0.3f, 0.285f, 0.265f}, 0.8f)), place);
    Material paper = matte("lantern paper", {0.6f, 0.5f, 0.35f});
    paper.emissive = {1.25f, 0.5f, 0.12f};
    paper.castsShadows = false;  // it lets the flame through
    addObject(scene, "lantern paper", addMesh(scene, made.paper, "lantern paper"), addMaterial(scene, paper), place);
    addObject(scene, "bridge", addMesh(scene, bridge(4.6f), "bridge"),
              addMaterial(scene, matte("vermilion", {0.42f, 0.06f, 0.03f}, 0.5f)),
              placed({2.7f, 0.22f, -3.7f}, -0.12f));
}

void addStillLights(Scene& scene) {
    scene.ambience = {.sky = {0.05f, 0.072f, 0.135f}, .ground = {0.016f, 0.018f, 0.02f}};
    scene.lights.push_back({.name = "moon",
                            .type = LightType::directional,
                            .directionWorld = glm::normalize(vec3(-0.2f, -0.4f, 1)),
                            .color = {0.14f, 0.19f, 0.28f}});
    scene.lights.push_back({.name = "lantern",
                            .positionWorld = onGround(kLantern, kFlameHeight),
                            .color = {2.6f, 1.15f, 0.36f},
                            .range = 5});
}

/// Where a firefly hovers: most of them over the grass and the water that the eye rests on, some about the trees.
vec3 hover(Random& random) {
    const uint32_t kind = random.below(22);
    const auto aboveGround = [&](vec2 at, float low, float high) {
        const float height = std::max(groundHeight(at), kWaterLevel);
        const float share = between(random, 0, 1);
        return vec3(at.x, height + low + (high - low) * share * share, at.y);
    };
    const auto scatter = [&](vec2 centre, vec2 radii) {
        const float r = std::sqrt(between(random, 0, 1)), angle = between(random, 0, 2 * kPi);
        return centre + radii * r * vec2(std::cos(angle), std::sin(angle));
    };
    if (kind < 7) return aboveGround(scatter({-0.6f, 1.2f}, {3.4f, 2.6f}), 0.08f, 1.3f);
    if (kind < 11) return aboveGround(scatter({1.8f, -1.2f}, {3.6f, 2.4f}), 0.1f, 1.1f);
    if (kind < 14) return onGround(scatter(kMaple, vec2(1.9f)), between(random, 0.4, 4));
    return aboveGround(scatter({0.5f, -6}, {11, 6}), 0.15f, 2.6f);
}

void addFireflies(Scene& scene, uint32_t count, Random random) {
    constexpr std::array<vec3, 3> kColors = {vec3{0.62f, 1, 0.12f}, {0.9f, 0.95f, 0.14f}, {1, 0.7f, 0.16f}};
    const uint32_t far = addMesh(scene, shapes::bead(1), "far firefly");
    const uint32_t near = addMesh(scene, shapes::sphere(1, 6, 4), "near firefly");
    std::array<uint32_t, kColors.size()> glows{};
    for (size_t i = 0; i < kColors.size(); ++i) {
        Material material = matte("firefly", vec3(0));
        material.emissive = 1.9f * kColors[i];
        material.castsShadows = false;  // the light is inside
        glows[i] = addMaterial(scene, material);
    }
    // However many there are, the garden stays about as bright.
    const float crowd = std::min(1.0f, std::sqrt(1000.0f / float(std::max(count, 1u))));
    for (uint32_t i = 0; i < count; ++i) {
        vec3 at = hover(random);
        while (glm::distance(at, kEye) < 1.5f) at = hover(random);
        const uint32_t kind = random.below(uint32_t(kColors.size()));
        const float vigour = between(random, 0.35, 1) * crowd;
        const std::string name = fmt::format("firefly {}", i);
        scene.lights.push_back({.name = name,
                                .positionWorld = at,
                                .color = 0.055f * vigour * kColors[kind],
                                .range = 1.3f * std::sqrt(crowd)});
        const float distance = glm::distance(at, kEye);
        addObject(scene, name, distance < 5 ? near : far, glows[kind], placed(at, 0, 0.006f + 0.007f * vigour));
    }
}

}  // namespace

Scene makeFireflies(const FirefliesOptions& options) {
    Scene scene;
    const auto stream = [&](uint64_t number) { return Random(options.seed, number); };
    addSetting(scene, stream(1));
    addStars(scene, stream(2));
    addTrees(scene, stream(3));
    addStones(scene, stream(4));
    addGrass(scene, stream(5));
    addLilies(scene, stream(6));
    addBuilt(scene);
    addStillLights(scene);
    addFireflies(scene, options.lights, stream(7));
    scene.exposureEv = 0.4f;
    scene.cameras.push_back({.name = "garden", .worldFromView = lookAt(kEye, {0.25f, 1.05f, -1.5f}), .yFov = 0.74f});
    return scene;
}

}  // namespace luciole
