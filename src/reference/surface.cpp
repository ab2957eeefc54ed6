#include "reference/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "reference/procedural.hpp"
#include "scene/mip_chain.hpp"

namespace luciole::reference {
namespace {

/// Mip chains of a scene, made once for each picture and encoding.
class LevelCache {
public:
    explicit LevelCache(const Scene& scene) : scene_(scene) {}

    SampledTexture::Levels levelsOf(uint32_t texels, bool srgb) {
        auto& levels = levels_[{texels, srgb}];
        if (!levels) levels = std::make_shared<std::vector<Texels>>(mipChain(scene_.texels[texels], srgb));
        return levels;
    }

private:
    const Scene& scene_;
    std::map<std::pair<uint32_t, bool>, SampledTexture::Levels> levels_;
};

std::shared_ptr<const SampledTexture> textureOf(const Scene& scene, LevelCache& cache, const TextureUse& use,
                                                bool srgb) {
    if (use.texture == kNone) return nullptr;
    const Texture& texture = scene.textures[use.texture];
    return std::make_shared<SampledTexture>(cache.levelsOf(texture.texels, srgb), texture.sampler, srgb);
}

/// Unit length, or `fallback` for vectors that have no direction.
dvec3 directionOf(dvec3 v, dvec3 fallback) {
    const double norm = length(v);
    return norm > 0 ? v / norm : fallback;
}

/// Weights where a ray meets the plane "far away", as one does that runs within it: the level of detail is the last.
constexpr double kFar = 1e30;

dvec3 weightsOn(const Ray& ray, const std::array<dvec3, 3>& triangle) {
    const PlaneHit hit = intersectPlane(ray.origin, ray.direction, triangle);
    const auto bounded = [](double w) { return std::isfinite(w) ? std::clamp(w, -kFar, kFar) : kFar; };
    return {bounded(1 - hit.u - hit.v), bounded(hit.u), bounded(hit.v)};
}

}  // namespace

Footprint footprintOf(const CameraRays& rays, uint32_t x, uint32_t y, const Hit& hit,
                      const std::array<dvec3, 3>& triangleWorld) {
    const auto weights = [&](uint32_t column, uint32_t row) {
        return weightsOn(rays.through(column, row), triangleWorld);
    };
    return {.weights = dvec3(1 - hit.u - hit.v, hit.u, hit.v),
            .dx = weights(x | 1u, y) - weights(x & ~1u, y),
            .dy = weights(x, y | 1u) - weights(x, y & ~1u)};
}

/// One point and all that its attributes are interpolated from.
struct Surfaces::Place {
    const Material& material;
    const PreparedMaterial& prepared;
    const PreparedObject& object;
    std::array<const Vertex*, 3> vertices;
    const Footprint& footprint;
    bool frontFace;

    /// Sum of a vertex attribute over the vertices, with weights from the footprint.
    template <typename Attribute>
    auto sum(dvec3 weights, Attribute attribute) const {
        return weights.x * attribute(*vertices[0]) + weights.y * attribute(*vertices[1]) +
               weights.z * attribute(*vertices[2]);
    }
    template <typename Attribute>
    auto interpolated(Attribute attribute) const {
        return sum(footprint.weights, attribute);
    }
};

Surfaces::Surfaces(const Scene& scene, const FunctionTables& tables) : scene_(scene) {
    LevelCache cache(scene);
    const auto mapped = [&](const TextureUse& use, bool srgb) {
        return MappedTexture{use, textureOf(scene, cache, use, srgb)};
    };
    const auto table = [&](const Material& material, uint32_t function) {
        return material.equation == LightEquation::shaped ? &tables.ofCosine(function) : nullptr;
    };
    for (const Material& material : scene.materials) {
        materials_.push_back({.baseColor = mapped(material.baseColorTexture, true),
                              .metallicRoughness = mapped(material.metallicRoughnessTexture, false),
                              .normal = mapped(material.normalTexture, false),
                              .occlusion = mapped(material.occlusionTexture, false),
                              .emissive = mapped(material.emissiveTexture, true),
                              .Fa = table(material, material.shaped.diffuseFunction),
                              .Fb = table(material, material.shaped.specularFunction)});
    }
    for (const Object& object : scene.objects) {
        const dmat4 worldFromObject(object.worldFromObject);
        const dmat3 linear(worldFromObject);
        objects_.push_back({.worldFromObject = worldFromObject,
                            .normalWorldFromObject = transpose(inverse(linear)),
                            .handedness = determinant(linear) < 0 ? -1.0 : 1.0});
    }
}

Surfaces::Place Surfaces::placeOf(const Hit& hit, const Footprint& footprint) const {
    const Object& object = scene_.objects[hit.object];
    const Mesh& mesh = scene_.meshes[object.mesh];
    const uint32_t* corner = &mesh.indices[3 * size_t(hit.triangle)];
    return {.material = scene_.materials[object.material],
            .prepared = materials_[object.material],
            .object = objects_[hit.object],
            .vertices = {&mesh.vertices[corner[0]], &mesh.vertices[corner[1]], &mesh.vertices[corner[2]]},
            .footprint = footprint,
            .frontFace = hit.frontFace};
}

dvec4 Surfaces::read(const MappedTexture& mapped, const Place& place) {
    if (!mapped.texture) return dvec4(1);
    const auto uv = [&](const Vertex& vertex) { return dvec2(mapped.use.uvSet == 0 ? vertex.uv0 : vertex.uv1); };
    const dvec3 rowU(mapped.use.uvTransform[0]), rowV(mapped.use.uvTransform[1]);
    const auto transformed = [&](dvec3 weights, double one) {
        const dvec3 homogeneous(place.sum(weights, uv), one);
        return dvec2(dot(rowU, homogeneous), dot(rowV, homogeneous));
    };
    const Footprint& footprint = place.footprint;
    return mapped.texture->sample(transformed(footprint.weights, 1), transformed(footprint.dx, 0),
                                  transformed(footprint.dy, 0));
}

dvec4 Surfaces::baseColorAt(const Place& place) {
    const dvec4 vertexColor = place.interpolated([](const Vertex& vertex) { return dvec4(vertex.color); });
    return dvec4(place.material.baseColor) * read(place.prepared.baseColor, place) * vertexColor;
}

dvec3 Surfaces::patternedColorAt(const Place& place, dvec3 baseColor) {
    const double scale = place.material.proceduralScale;
    const dvec3 other(place.material.proceduralColor);
    const auto cells = [&](const Vertex& vertex) { return dvec3(vertex.position) * scale; };
    const Footprint& footprint = place.footprint;
    switch (place.material.surface) {
        case SurfaceShader::textured:
            return baseColor;
        case SurfaceShader::checker:
            return mix(
                other, baseColor,
                checker(place.interpolated(cells), place.sum(footprint.dx, cells), place.sum(footprint.dy, cells)));
        case SurfaceShader::marble:
            return mix(baseColor, other, marble(place.interpolated(cells)));
    }
    return baseColor;
}

// glTF 2.0, 3.9.3 "Additional Textures", normalTexture; docs/conventions.md, "Normal mapping".
dvec3 Surfaces::normalAt(const Place& place) {
    const dvec3 normal = place.interpolated([](const Vertex& vertex) { return dvec3(vertex.normal); });
    const dvec3 n = directionOf(place.object.normalWorldFromObject * normal, dvec3(0, 1, 0));
    const double side = place.frontFace ? 1 : -1;
    if (!place.prepared.normal.texture) return side * n;

    const dvec4 tangent = place.interpolated([](const Vertex& vertex) { return dvec4(vertex.tangent); });
    const dvec3 t = directionOf(dmat3(place.object.worldFromObject) * dvec3(tangent), dvec3(0));
    const dvec3 b = cross(n, t) * tangent.w * place.object.handedness;
    const double scale = place.material.normalScale;
    const dvec3 xyz = (dvec3(read(place.prepared.normal, place)) * 2.0 - 1.0) * dvec3(scale, scale, 1);
    return side * directionOf(t * xyz.x + b * xyz.y + n * xyz.z, n);
}

bool Surfaces::isThere(const Hit& hit, const Footprint& footprint) const {
    const Place place = placeOf(hit, footprint);
    return place.material.alphaMode != AlphaMode::mask || baseColorAt(place).a >= place.material.alphaCutoff;
}

SurfacePoint Surfaces::pointAt(const Hit& hit, const Footprint& footprint) const {
    const Place place = placeOf(hit, footprint);
    const Material& material = place.material;
    const dvec3 position = place.interpolated([](const Vertex& vertex) { return dvec3(vertex.position); });
    const dvec4 baseColor = baseColorAt(place);
    SurfacePoint point{.equation = material.equation,
                       .P = dvec3(place.object.worldFromObject * dvec4(position, 1)),
                       .N = normalAt(place),
                       .Cs0 = patternedColorAt(place, dvec3(baseColor)),
                       .alpha = std::clamp(baseColor.a, 0.0, 1.0)};
    if (material.equation == LightEquation::shaped) {
        const ShapedParameters& shaped = material.shaped;
        point.Cs0 *= double(shaped.kd);
        point.Cs1 = dvec3(shaped.specularColor) * double(shaped.ks);
        point.Kamb = dvec3(shaped.kAmbient);
        point.Kemm = shaped.kEmissive;
        point.specularBlend = shaped.specularBlend;
        point.Fa = place.prepared.Fa;
        point.Fb = place.prepared.Fb;
    } else if (material.equation == LightEquation::metallicRoughness) {
        const dvec3 emissive(material.emissive);
        const dvec4 metallicRoughness = read(place.prepared.metallicRoughness, place);
        point.Kemm = std::max({emissive.r, emissive.g, emissive.b});
        if (point.Kemm > 0) point.Cs1 = emissive * dvec3(read(place.prepared.emissive, place)) / point.Kemm;
        point.metallic = material.metallic * metallicRoughness.b;
        point.roughness = material.roughness * metallicRoughness.g;
        point.occlusion = 1 + material.occlusionStrength * (read(place.prepared.occlusion, place).r - 1);
    } else {
        point.Cs1 = point.Cs0;  // shown by the layer "cs1": an unlit surface glows in its base colour
    }
    return point;
}

}  // namespace luciole::reference
