#include "render/tables.hpp"

#include <algorithm>
#include <cmath>

namespace luciole::render {

using namespace shared;

// As the shaders lay them out (scalar block layout).
static_assert(sizeof(ViewConstants) == 320);
static_assert(sizeof(ObjectConstants) == 112);
static_assert(sizeof(TextureSlot) == 28);
static_assert(sizeof(SurfaceConstants) == 84 + kTextureSlots * sizeof(TextureSlot));
static_assert(sizeof(MaterialConstants) == 36);
static_assert(sizeof(LightConstants) == 76 && kUniformLights * sizeof(LightConstants) <= 65536);

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
    constants.viewFromGBuffer = mat4(inverse(clip) * unbias);
    constants.sky = ambience.sky;
    constants.ground = ambience.ground;
    constants.upView = vec3(dmat3(viewFromWorld) * dvec3(ambience.upWorld));
    constants.orthographic = view.camera.orthographic;
    constants.extent = vec2(view.extent);
    constants.exposure = 1;
    return constants;
}

LightConstants lightConstants(const Light& light, const dmat4& viewFromWorld, uint32_t functionCount) {
    LightConstants constants{};
    constants.type = uint32_t(light.type);
    constants.position = vec3(viewFromWorld * dvec4(light.positionWorld, 1));
    constants.direction = vec3(normalize(dmat3(viewFromWorld) * dvec3(light.directionWorld)));
    constants.color = light.color;
    const bool bounded = std::isfinite(light.range);
    constants.range = bounded ? light.range : std::numeric_limits<float>::max();
    constants.inverseRange = bounded ? 1 / light.range : 0;
    const double cosOuter = std::cos(double(light.outerConeAngle));
    const double scale = 1 / std::max(0.001, std::cos(double(light.innerConeAngle)) - cosOuter);
    constants.coneScale = float(scale);
    constants.coneOffset = float(-cosOuter * scale);
    constants.cosOuter = float(cosOuter);
    constants.flags = (light.contribution != LightContribution::specularOnly ? kLightDiffuse : 0) |
                      (light.contribution != LightContribution::diffuseOnly ? kLightSpecular : 0) |
                      (light.infiniteViewer && light.type == LightType::directional ? kLightInfiniteViewer : 0);
    constants.attenuation = light.attenuation == kNone ? kNoIndex : functionCount + light.attenuation;
    constants.falloff = light.falloff;
    constants.linkGroup = light.linkGroup;
    return constants;
}

uint32_t lightFeatures(const std::vector<Light>& lights) {
    uint32_t features = 0;
    for (const Light& light : lights) {
        features |= light.type == LightType::directional ? kUsesDirectional : kUsesLocal;
        if (light.type == LightType::spot) features |= kUsesSpot;
        if (light.attenuation != kNone || light.falloff != kNone) features |= kUsesCurves;
        if (light.linkGroup != kNone) features |= kUsesLinks;
        if (light.contribution != LightContribution::diffuseAndSpecular || light.infiniteViewer) features |= kUsesContributions;
    }
    return features;
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

}  // namespace luciole::render
