#include "render/tables.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>

#include "render/lighting/light_tree.shared.h"
#include "render/lighting/light_volume.shared.h"

namespace luciole::render {

using namespace shared;

// As the shaders lay them out (scalar block layout).
static_assert(sizeof(ViewConstants) == 352);
static_assert(sizeof(TextureSlot) == 28);
static_assert(sizeof(SurfaceConstants) == 84 + kTextureSlots * sizeof(TextureSlot));
static_assert(sizeof(MaterialConstants) == 36);
static_assert(sizeof(PackedLight) == 56 && kUniformLights * sizeof(PackedLight) <= 65536);
static_assert(sizeof(LightKind) == 16 && kUniformLightKinds * sizeof(LightKind) <= 65536);

dmat4 clipFromView(const Camera& camera, double aspect) {
    dmat4 m(0);
    if (camera.orthographic) {
        const double depth = double(camera.zFar) - camera.zNear;
        m[0][0] = 1 / (camera.halfHeight * aspect);
        m[1][1] = -1 / double(camera.halfHeight);
        m[2][2] = 1 / depth;
        m[3][2] = camera.zFar / depth;
        m[3][3] = 1;
    } else {
        const double f = 1 / std::tan(0.5 * camera.yFov);
        m[0][0] = f / aspect;
        m[1][1] = -f;
        m[2][3] = -1;
        m[3][2] = camera.zNear;
    }
    return m;
}

ViewConstants viewConstants(const View& view, const Ambience& ambience) {
    const dmat4 clip = clipFromView(view.camera, double(view.extent.x) / view.extent.y);
    const dmat4 worldFromView(view.camera.worldFromView);
    const dmat4 viewFromWorld = inverse(worldFromView);
    // From the unit square to clip space: the un-bias of Calver's warp matrix.
    dmat4 unbias(1);
    unbias[0][0] = unbias[1][1] = 2;
    unbias[3][0] = unbias[3][1] = -1;
    ViewConstants constants{};
    constants.clipFromView = mat4(clip);
    constants.viewFromWorld = mat4(viewFromWorld);
    constants.worldFromView = mat4(worldFromView);
    constants.shadingFromGBuffer = mat4(dmat4(dmat3(worldFromView)) * inverse(clip) * unbias);
    constants.sky = ambience.sky;
    constants.ground = ambience.ground;
    constants.upWorld = ambience.upWorld;
    constants.orthographic = view.camera.orthographic;
    constants.extent = vec2(view.extent);
    constants.exposure = 1;
    constants.clipScale = vec2(clip[0][0], -clip[1][1]);
    constants.zNear = view.camera.zNear;
    constants.cullLights = 1;
    return constants;
}

vec4 viewSlack(const View& view, GBufferLayout layout, bool multisampled) {
    const Camera& camera = view.camera;
    const dmat4 clip = clipFromView(camera, double(view.extent.x) / view.extent.y);
    // Sideways a sixteenth of a pixel, as rasterizers snap vertices to a 256th; and calver stores x and y in 16 bits.
    const double stored = layout == GBufferLayout::calver ? std::max(view.extent.x, view.extent.y) / 65535.0 : 0;
    const double pixel = std::max(2 / (clip[0][0] * view.extent.x), 2 / (-clip[1][1] * view.extent.y)) * ((multisampled ? 1.0 : 1.0 / 16) + stored);
    constexpr double kRounding = 4e-6;    // of the matrices and positions, 32 units of roundoff
    constexpr double kDepthStep = 5e-7;   // of the rasterizer's depth, 8 units of roundoff of the largest depth it meets
    constexpr double kHalfStep = 1e-3;    // float: a half has 11 significant bits and may be truncated; all three coordinates
    constexpr double kCode = 1 / 65535.0; // calver: depth has 16 bits
    dvec4 slack(0);
    if (camera.orthographic) {
        const double depth = double(camera.zFar) - camera.zNear;
        slack.x = pixel + depth * (kDepthStep + (layout == GBufferLayout::calver ? kCode : 0));
        slack.y = kRounding;
    } else {
        slack.y = pixel + kRounding;
        slack.w = kDepthStep;
        // depth = near / z, so a step of depth is a step of z^2 / near.
        if (layout == GBufferLayout::calver) slack.z = kCode / camera.zNear;
        // Positions are not taken from depth here, and the depth of a surface that comes near the eye is rounded as such.
        if (layout == GBufferLayout::floatPosition) slack.z = kDepthStep / camera.zNear;
    }
    if (layout == GBufferLayout::floatPosition) slack.y += kHalfStep;
    return vec4(slack);
}

LightConstants lightConstants(const Light& light, uint32_t index, uint32_t functionCount) {
    const bool spot = light.type == LightType::spot;
    LightConstants constants{};
    constants.type = uint32_t(light.type);
    if (light.type != LightType::directional) constants.position = light.positionWorld;
    constants.direction = light.type == LightType::point ? vec3(0, 0, -1) : vec3(normalize(dvec3(light.directionWorld)));
    constants.color = light.color;
    constants.range = std::min(light.range, kNoRange);
    constants.cosOuter = kFullCone;
    constants.coneScale = kFullConeScale;
    if (spot) {
        const double cosOuter = std::cos(double(light.outerConeAngle));
        constants.cosOuter = float(cosOuter);
        constants.coneScale = float(1 / std::max(0.001, std::cos(double(light.innerConeAngle)) - cosOuter));
    }
    constants.flags = (light.contribution != LightContribution::specularOnly ? kLightDiffuse : 0) |
                      (light.contribution != LightContribution::diffuseOnly ? kLightSpecular : 0) |
                      (light.infiniteViewer && light.type == LightType::directional ? kLightInfiniteViewer : 0);
    constants.attenuation = light.attenuation == kNone ? kNoIndex : functionCount + light.attenuation;
    constants.falloff = spot ? light.falloff : kNoIndex;
    constants.linkGroup = light.linkGroup;
    constants.volume = light.volume;
    constants.sceneIndex = index;
    return constants;
}

namespace {

using Kind = std::array<uint32_t, sizeof(LightKind) / 4>;

Kind kindOf(const LightConstants& light) {
    return std::bit_cast<Kind>(LightKind{light.attenuation, light.falloff, light.linkGroup, light.volume});
}

/// Spreads the lowest ten bits, two zeros after each (Karras 2012, "Maximizing Parallelism in the Construction of BVHs, Octrees, and
/// k-d Trees").
uint32_t spreadBits(uint32_t v) {
    v = (v | v << 16) & 0x030000ffu;
    v = (v | v << 8) & 0x0300f00fu;
    v = (v | v << 4) & 0x030c30c3u;
    return (v | v << 2) & 0x09249249u;
}

/// Indices in the order of codes of 30 bits, those of one code as they were: a radix sort, as all lights may move every frame (a million
/// take 9 ms on a core that needs 61 ms with std::sort).
std::vector<uint32_t> orderOf(const std::vector<uint32_t>& codes) {
    std::vector<uint32_t> order(codes.size()), next(codes.size());
    std::iota(order.begin(), order.end(), 0u);
    for (uint32_t shift = 0; shift < 30; shift += 10) {
        std::array<uint32_t, 1025> places{};
        for (const uint32_t code : codes) ++places[(code >> shift & 1023) + 1];
        std::partial_sum(places.begin(), places.end(), places.begin());
        for (const uint32_t i : order) next[places[codes[i] >> shift & 1023]++] = i;
        order.swap(next);
    }
    return order;
}

/// Adds lights along a Morton curve (Morton 1966, "A Computer Oriented Geodetic Data Base") through 1024 cells a side of a cube around
/// their positions.
void appendByPlace(std::vector<PackedLight>& table, const std::vector<PackedLight>& lights) {
    dvec3 low(INFINITY), high(-INFINITY);
    for (const PackedLight& light : lights) low = min(low, dvec3(light.position)), high = max(high, dvec3(light.position));
    const dvec3 size = high - low;
    const double scale = 1024 / std::max({size.x, size.y, size.z, 1e-30});
    std::vector<uint32_t> codes;
    codes.reserve(lights.size());
    for (const PackedLight& light : lights) {
        const uvec3 cell = min(uvec3((dvec3(light.position) - low) * scale), uvec3(1023));
        codes.push_back(spreadBits(cell.x) | spreadBits(cell.y) << 1 | spreadBits(cell.z) << 2);
    }
    for (const uint32_t i : orderOf(codes)) table.push_back(lights[i]);
}

}  // namespace

SortedLights sortLights(std::span<const Light> lights, uint32_t functionCount) {
    SortedLights sorted;
    std::vector<PackedLight> unbounded, shaped, meshes;
    shaped.reserve(lights.size());  // as good as all, where there are many
    std::map<Kind, uint32_t> kinds;
    for (uint32_t i = 0; i < lights.size(); ++i) {
        const LightConstants light = lightConstants(lights[i], i, functionCount);
        const auto [row, added] = kinds.try_emplace(kindOf(light), uint32_t(kinds.size()));
        if (added) sorted.kinds.push_back(std::bit_cast<LightKind>(row->first));
        const bool ball = light.type != kLightDirectional && light.range < kBoundless;
        (light.volume != kNoIndex ? meshes : ball ? shaped : unbounded).push_back(packLight(light, row->second));
    }
    sorted.unbounded = uint32_t(unbounded.size());
    sorted.shaped = uint32_t(shaped.size());
    sorted.meshes = uint32_t(meshes.size());
    sorted.sources.reserve(lights.size());
    for (const auto* some : {&unbounded, &shaped, &meshes}) appendByPlace(sorted.sources, *some);
    return sorted;
}

uint32_t addPlacedLights(SortedLights& lights, uint32_t linkGroup, uint32_t firstIndex, uint32_t count) {
    LightConstants placed{};
    placed.type = kLightSpot;
    placed.flags = kLightDiffuse | kLightLambertian;
    placed.direction = vec3(0, 0, -1);
    const auto kind = uint32_t(lights.kinds.size());
    lights.kinds.push_back({kNoIndex, kNoIndex, linkGroup, kNoIndex});
    std::vector<PackedLight> all(count, packLight(placed, kind));
    for (uint32_t i = 0; i < count; ++i) all[i].sceneIndex = firstIndex + i;
    const uint32_t first = lights.unbounded + lights.shaped;
    lights.sources.insert(lights.sources.begin() + first, all.begin(), all.end());
    lights.shaped += count;
    return first;
}

VolumeTables volumeTables(const Scene& scene) {
    VolumeTables tables;
    for (const LightVolume& volume : scene.lightVolumes) {
        VolumeConstants constants{.firstVertex = uint32_t(tables.vertices.size()),
                                  .vertexCount = uint32_t(volume.indices.size()),
                                  .low = vec3(std::numeric_limits<float>::infinity()),
                                  .high = vec3(-std::numeric_limits<float>::infinity())};
        for (const uint32_t index : volume.indices) {
            const vec3 position = volume.positionsWorld[index];
            constants.low = min(constants.low, position);
            constants.high = max(constants.high, position);
            tables.vertices.push_back(position);
        }
        tables.volumes.push_back(constants);
    }
    return tables;
}

namespace {

/// Encloses whatever a light reaches; its radius is that of everything where there is no telling.
vec4 reachOf(const LightConstants& light, const VolumeTables& volumes) {
    const bool placed = (light.flags & kLightLambertian) != 0;
    if (light.volume != kNoIndex) {
        const VolumeConstants& mesh = volumes.volumes[light.volume];
        return vec4(0.5f * (mesh.low + mesh.high), 0.5f * distance(mesh.low, mesh.high));
    }
    if (placed || light.type == kLightDirectional || light.range >= kBoundless) return vec4(0, 0, 0, kBoundless);
    return boundingBall(lightShape(light));
}

vec4 enclose(std::span<const vec4> balls) {
    vec3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
    for (const vec4& ball : balls) {
        low = min(low, vec3(ball) - ball.w);
        high = max(high, vec3(ball) + ball.w);
    }
    const vec3 center = 0.5f * low + 0.5f * high;
    float radius = 0;
    for (const vec4& ball : balls) radius = std::max(radius, distance(center, vec3(ball)) + ball.w);
    constexpr float kRounding = 1e-6f;  // of the centres and distances, 16 units of roundoff
    return vec4(center, radius + kRounding * (radius + length(center)));
}

}  // namespace

std::vector<vec4> lightTree(const SortedLights& lights, const VolumeTables& volumes) {
    std::vector<vec4> balls;
    balls.reserve(lights.sources.size());
    for (const PackedLight& light : lights.sources) balls.push_back(reachOf(unpackLight(light, lights.kinds[kindOf(light)]), volumes));
    constexpr size_t kFan = 1 << kTreeBits, kBelowRoot = 1 << (kTreeBits * kTreeLevels);
    std::vector<vec4> tree((balls.size() + kBelowRoot - 1) / kBelowRoot * treeSize(kTreeLevels));
    for (uint32_t level = 1; level <= kTreeLevels; ++level) {
        std::vector<vec4> parents;
        for (size_t i = 0; i < balls.size(); i += kFan) {
            const auto light = uint32_t(parents.size() << (kTreeBits * level));
            parents.push_back(enclose(std::span(balls).subspan(i, std::min(kFan, balls.size() - i))));
            tree[treePlace(level, light)] = parents.back();
        }
        balls = std::move(parents);
    }
    return tree;
}

uint32_t lightFeatures(std::span<const Light> lights) {
    uint32_t features = 0;
    for (const Light& light : lights) {
        features |= light.type == LightType::directional ? kUsesDirectional : kUsesLocal;
        if (light.type == LightType::spot) features |= kUsesSpot;
        if (light.attenuation != kNone || light.falloff != kNone) features |= kUsesCurves;
        if (light.linkGroup != kNone) features |= kUsesLinks;
        if (light.volume != kNone) features |= kUsesVolumes;
        if (light.contribution != LightContribution::diffuseAndSpecular || light.infiniteViewer) features |= kUsesContributions;
    }
    return features;
}

std::vector<uint32_t> volumeIndices() {
    std::vector<uint32_t> indices{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,   // -z, +z, -y
                                  2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};  // +y, -x, +x
    for (uint32_t lod = 1; lod < kVolumeLods; ++lod) {
        const uint32_t slices = volumeSlices(lod), rings = volumeRings(lod);
        const auto vertex = [&](uint32_t ring, uint32_t slice) { return 2 + (ring - 1) * slices + slice % slices; };
        for (uint32_t slice = 0; slice < slices; ++slice) {
            indices.insert(indices.end(), {1, vertex(1, slice), vertex(1, slice + 1)});
            for (uint32_t ring = 1; ring < rings; ++ring) {
                const uint32_t a = vertex(ring, slice), b = vertex(ring + 1, slice);
                const uint32_t c = vertex(ring + 1, slice + 1), d = vertex(ring, slice + 1);
                indices.insert(indices.end(), {a, b, c, a, c, d});
            }
            indices.insert(indices.end(), {0, vertex(rings, slice + 1), vertex(rings, slice)});
        }
    }
    indices.insert(indices.end(), {0, 1, 2});  // kVolumeScreen
    return indices;
}

namespace {

float largest(vec3 color) { return std::max({color.x, color.y, color.z}); }

TextureSlot slotOf(const TextureUse& use) { return {use.uvTransform[0], use.uvTransform[1], use.uvSet}; }

/// What the stored colour has to be multiplied by: 1 unless the colour can exceed the target's range.
float scaleFor(vec3 brightest) { return std::max(1.0f, largest(brightest)); }

}  // namespace

MaterialTables materialTables(const Material& material, float colorBound) {
    SurfaceConstants surface{};
    MaterialConstants constants{};
    surface.baseColor = material.baseColor;
    surface.roughness = material.roughness;
    surface.normalScale = material.normalScale;
    surface.occlusionStrength = material.occlusionStrength;
    surface.alphaCutoff = material.alphaCutoff;
    surface.proceduralColor = material.proceduralColor;
    surface.proceduralScale = material.proceduralScale;
    surface.equation = constants.equation = uint32_t(material.equation);
    surface.slots[kTextureBaseColor] = slotOf(material.baseColorTexture);
    surface.slots[kTextureMetallicRoughness] = slotOf(material.metallicRoughnessTexture);
    surface.slots[kTextureNormal] = slotOf(material.normalTexture);
    surface.slots[kTextureOcclusion] = slotOf(material.occlusionTexture);
    surface.slots[kTextureEmissive] = slotOf(material.emissiveTexture);

    const vec3 brightestBase = max(vec3(material.baseColor) * colorBound, material.proceduralColor);
    float kd = 1;
    switch (material.equation) {
        case LightEquation::metallicRoughness:
            surface.metallic = material.metallic;
            constants.kEmissive = largest(material.emissive);
            surface.cs1 = constants.kEmissive > 0 ? material.emissive / constants.kEmissive : vec3(0);
            constants.cs1Scale = 1;
            break;
        case LightEquation::shaped:
            kd = material.shaped.kd;
            surface.metallic = material.shaped.specularBlend;
            surface.cs1 = material.shaped.specularColor * material.shaped.ks;
            constants.kAmbient = material.shaped.kAmbient;
            constants.kEmissive = material.shaped.kEmissive;
            constants.diffuseFunction = material.shaped.diffuseFunction;
            constants.specularFunction = material.shaped.specularFunction;
            constants.cs1Scale = scaleFor(surface.cs1);
            break;
        case LightEquation::unlit:
            constants.kEmissive = 1;  // surface.frag puts the base colour into Cs1
            constants.cs1Scale = scaleFor(brightestBase);
            break;
    }
    constants.cs0Scale = scaleFor(brightestBase * kd);
    surface.cs0Factor = vec3(kd / constants.cs0Scale);
    surface.cs1Factor = 1 / constants.cs1Scale;
    return {surface, constants};
}

ObjectConstants objectConstants(const Object& object) {
    const dmat3 linear(object.worldFromObject);
    ObjectConstants constants{};
    constants.worldFromObject = object.worldFromObject;
    constants.worldNormalFromObject = mat3(transpose(inverse(linear)));
    constants.tangentSign = determinant(linear) < 0 ? -1.0f : 1.0f;
    constants.material = object.material + 1;
    constants.objectId = object.objectId;
    return constants;
}

std::vector<vec2> functionTable(const std::vector<Function>& functions) {
    std::vector<vec2> table;
    table.reserve(2 * functions.size() * kFunctionSamples);
    for (const double low : {-1.0, 0.0})
        for (const Function& function : functions)
            for (uint32_t i = 0; i < kFunctionSamples; ++i)
                table.push_back(vec2(evaluate(function, low + (1 - low) * i / (kFunctionSamples - 1), low)));
    return table;
}

std::vector<uint32_t> linkTable(const Scene& scene, uint32_t& words) {
    words = 1;
    for (const Object& object : scene.objects) words = std::max(words, object.objectId / 32 + 1);
    std::vector<uint32_t> table(scene.linkGroups.size() * words);
    for (size_t row = 0; row < scene.linkGroups.size(); ++row) {
        const auto& lit = scene.linkGroups[row].litObjects;
        for (size_t id = 0; id < std::min<size_t>(lit.size(), words * 32); ++id)
            if (lit[id]) table[row * words + id / 32] |= 1u << (id % 32);
    }
    return table;
}

ObjectClasses objectClasses(const Scene& scene) {
    ObjectClasses classes{.classOfObject = {0}};
    std::map<std::vector<bool>, uint32_t> known;
    for (const Object& object : scene.objects) {
        const uint32_t id = object.objectId;
        std::vector<bool> groups;
        for (const LinkGroup& group : scene.linkGroups) groups.push_back(id < group.litObjects.size() && group.litObjects[id]);
        const auto [place, added] = known.emplace(std::move(groups), uint32_t(classes.objectOfClass.size()));
        if (added) classes.objectOfClass.push_back(id);
        if (classes.classOfObject.size() <= id) classes.classOfObject.resize(id + 1);
        classes.classOfObject[id] = place->second;
    }
    if (classes.objectOfClass.empty()) classes.objectOfClass.push_back(0);
    return classes;
}

}  // namespace luciole::render
