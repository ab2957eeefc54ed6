#include "render/gpu_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <luciole/error.hpp>
#include <numeric>
#include <ranges>
#include <tuple>

#include "gpu/bindings.shared.h"
#include "output/request.hpp"
#include "render/geometry/gbuffer.hpp"
#include "render/lighting/bounce.shared.h"
#include "render/lighting/light_tree.shared.h"
#include "render/tables.hpp"

namespace luciole::render {
namespace {

using namespace shared;
using Usage = vk::BufferUsageFlagBits;

/// What shaders read the table of lights through, if all fit: no buffer of a table is smaller.
constexpr vk::DeviceSize kUniformLightBytes = kUniformLights * sizeof(PackedLight);
constexpr vk::DeviceSize kUniformLightKindBytes = kUniformLightKinds * sizeof(LightKind);
constexpr vk::DeviceSize kUniformShadowedLightBytes = kUniformLights * sizeof(uint32_t);

/// What shadow volumes are made from.
constexpr auto kReadByVolumes = Usage::eStorageBuffer | Usage::eTransferSrc;

/// For textures of which single texels are read.
constexpr Sampler kTexels{.wrapU = Wrap::clampToEdge, .wrapV = Wrap::clampToEdge, .magFilter = Filter::nearest, .minFilter = Filter::nearest, .mipFilter = MipFilter::none};

bool mirrored(const Object& object) { return determinant(dmat3(object.worldFromObject)) < 0; }

/// Contains points wherever floats put them in world space.
template <typename Points>
Bounds boundsOf(const Points& points, const mat4& m) {
    vec3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest()), farthest(0);
    for (const vec3 point : points) {
        const vec3 p(m * vec4(point, 1));
        low = min(low, p);
        high = max(high, p);
        farthest = max(farthest, abs(point));
    }
    constexpr float kRounding = 1e-6f;  // of a sum of four products, both here and there: 16 units of roundoff
    const vec3 terms = abs(vec3(m[0])) * farthest.x + abs(vec3(m[1])) * farthest.y + abs(vec3(m[2])) * farthest.z + abs(vec3(m[3]));
    return {low - kRounding * terms, high + kRounding * terms};
}

/// The colours of the vertices that a material is drawn with.
struct VertexColors {
    float bound = 1;    ///< no channel is larger
    bool white = true;  ///< opaque as well
};
std::vector<VertexColors> vertexColorsByMaterial(const Scene& scene) {
    std::vector<VertexColors> meshes;
    for (const Mesh& mesh : scene.meshes) {
        VertexColors& colors = meshes.emplace_back();
        for (const Vertex& vertex : mesh.vertices) {
            colors.bound = std::max({colors.bound, vertex.color.x, vertex.color.y, vertex.color.z});
            colors.white &= vertex.color == vec4(1);
        }
    }
    std::vector<VertexColors> materials(scene.materials.size());
    for (const Object& object : scene.objects) {
        VertexColors& colors = materials[object.material];
        colors.bound = std::max(colors.bound, meshes[object.mesh].bound);
        colors.white &= meshes[object.mesh].white;
    }
    return materials;
}

/// What the light sees: a square around its cone (docs/conventions.md, "Bounce").
Camera bounceCamera(const Light& light) {
    mat4 worldFromView = lookAt(vec3(0), vec3(normalize(dvec3(light.directionWorld))));
    worldFromView[3] = vec4(light.positionWorld, 1);
    return {.worldFromView = worldFromView, .yFov = 2 * light.outerConeAngle, .zNear = kBounceNear};
}

}  // namespace

GpuScene::GpuScene(const gpu::Context& context, const gpu::Pipelines& pipelines, const Scene& scene)
    : context_(context), textures_(context, scene), sceneLights_(scene.lights), functionCount_(uint32_t(scene.functions.size())), volumes_(volumeTables(scene)),
      objectClasses_(render::objectClasses(scene)), ambience_(scene.ambience),
      exposureEv_(scene.exposureEv), boundsWorld_(luciole::boundsOf(scene)), shadows_(context), shadowVolumes_(context) {
    for (const LinkGroup& group : scene.linkGroups) castingObjects_.push_back(group.castingObjects);
    uploadMeshes(scene);
    uploadObjects(scene);
    uploadMaterials(scene);
    createMaterialSets(scene, pipelines);
    uploadFunctions(scene);
    linkTable_ = linkTable(scene, linkWords_);
    links_ = gpu::uploadBuffer(context_, "link table", linkTable_, Usage::eStorageBuffer);
    shadowedLights_.update(context_, "shadowed lights", {}, kUniformShadowedLightBytes);
    view_ = gpu::MappedBuffer(context_, "view", sizeof(ViewConstants), Usage::eUniformBuffer);
    bounceView_ = gpu::MappedBuffer(context_, "bounce view", sizeof(ViewConstants), Usage::eUniformBuffer);
    uploadLights(sceneLights_, {});
    staging_ = {};  // few scenes have other lights later
    volumeTable_ = gpu::uploadBuffer(context_, "light volumes", volumes_.volumes, Usage::eStorageBuffer);
    volumeVertices_ = gpu::uploadBuffer(context_, "light volume vertices", volumes_.vertices, Usage::eStorageBuffer);
    volumeIndices_ = gpu::uploadBuffer(context_, "light volume indices", render::volumeIndices(), Usage::eIndexBuffer);
    const auto frameSets = gpu::allocateSets(context_, pool_, pipelines.frameSetLayout(), 2);
    frameSet_ = frameSets[0];
    bounceSet_ = frameSets[1];
    writeFrameSets();
    triangles_ = triangleCount(scene);
}

void GpuScene::uploadMeshes(const Scene& scene) {
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
    vertices.reserve(std::transform_reduce(scene.meshes.begin(), scene.meshes.end(), size_t(0), std::plus{},
                                           [](const Mesh& mesh) { return mesh.vertices.size(); }));
    for (const Mesh& mesh : scene.meshes) {
        if (vertices.size() + mesh.vertices.size() > INT32_MAX || indices.size() + mesh.indices.size() > UINT32_MAX)
            throw Error(ErrorKind::limit, fmt::format("meshes: expected at most {} vertices and {} indices in all, got more at \"{}\"",
                                                      INT32_MAX, UINT32_MAX, mesh.name));
        meshes_.push_back({uint32_t(indices.size()), uint32_t(mesh.indices.size()), uint32_t(vertices.size())});
        vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
    }
    vertices_ = gpu::uploadBuffer(context_, "vertices", vertices, Usage::eVertexBuffer | kReadByVolumes);
    indices_ = gpu::uploadBuffer(context_, "indices", indices, Usage::eIndexBuffer | kReadByVolumes);
}

void GpuScene::uploadObjects(const Scene& scene) {
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < scene.objects.size(); ++i)
        if (isDrawn(scene.objects[i])) order.push_back(i);
    const auto blends = [&](uint32_t i) { return scene.materials[scene.objects[i].material].alphaMode == AlphaMode::blend; };
    const auto batchOf = [&](uint32_t i) {
        const Object& object = scene.objects[i];
        return std::tuple(blends(i), object.material, object.mesh, mirrored(object));
    };
    std::ranges::stable_sort(order, {}, batchOf);
    std::vector<ObjectConstants>& table = objectTable_;
    placeOfObject_.assign(scene.objects.size(), kNone);
    for (const Mesh& mesh : scene.meshes) meshBounds_.push_back(boundsOf(mesh.vertices | std::views::transform(&Vertex::position), mat4(1)));
    for (const uint32_t i : order) {
        const auto [blended, material, mesh, flipped] = batchOf(i);
        const Batch alone{mesh, material, flipped, uint32_t(table.size()), 1};
        const bool joins = !table.empty() && batchOf(order[table.size() - 1]) == batchOf(i);
        const Bounds bounds = boundsOf(scene.meshes[mesh].vertices | std::views::transform(&Vertex::position), scene.objects[i].worldFromObject);
        placeOfObject_[i] = uint32_t(table.size());
        meshOfPlace_.push_back(mesh);
        if (!blended) {
            opaque_.push_back({scene.objects[i].objectId, bounds});
            casters_.push_back({bounds, scene.objects[i].objectId, scene.materials[material].castsShadows});
        }
        if (blended)
            blended_.push_back({alone, 0.5f * (bounds.low + bounds.high)});
        else if (joins)
            ++batches_.back().objectCount;
        else
            batches_.push_back(alone);
        table.push_back(objectConstants(scene.objects[i]));
    }
    objects_ = gpu::uploadBuffer(context_, "objects", table, Usage::eVertexBuffer | kReadByVolumes);
}

void GpuScene::moveObjects(std::span<const MovedObject> moved) {
    for (const MovedObject& object : moved) {
        const auto refuse = [&](std::string_view expected) {
            throw Error(ErrorKind::scene, fmt::format("objects[{}]: worldFromObject: expected {}", object.object, expected));
        };
        if (object.object >= placeOfObject_.size())
            throw Error(ErrorKind::scene, fmt::format("moved objects: expected indices below {}, got {}", placeOfObject_.size(), object.object));
        for (int i = 0; i < 16; ++i)
            if (!std::isfinite(object.worldFromObject[i / 4][i % 4])) refuse("finite numbers");
        const uint32_t place = placeOfObject_[object.object];
        if (place == kNone) refuse("an object that was drawn; it had a singular matrix when the scene was set");
        const double volume = determinant(dmat3(object.worldFromObject));
        if (!isDrawn({.worldFromObject = object.worldFromObject})) refuse("a matrix that is not singular");
        if ((volume < 0) != (objectTable_[place].tangentSign < 0)) refuse("a determinant of the same sign as before");
    }
    for (const MovedObject& object : moved) {
        const uint32_t place = placeOfObject_[object.object];
        ObjectConstants& constants = objectTable_[place];
        constants = objectConstants({.material = constants.material - 1, .worldFromObject = object.worldFromObject, .objectId = constants.objectId});
        const Bounds& mesh = meshBounds_[meshOfPlace_[place]];
        std::array<vec3, 8> corners;
        for (uint32_t i = 0; i < 8; ++i) corners[i] = {i & 1 ? mesh.high.x : mesh.low.x, i & 2 ? mesh.high.y : mesh.low.y, i & 4 ? mesh.high.z : mesh.low.z};
        const Bounds bounds = boundsOf(corners, object.worldFromObject);
        boundsWorld_ = {min(boundsWorld_.low, bounds.low), max(boundsWorld_.high, bounds.high)};
        if (place < opaque_.size()) {
            opaque_[place].boundsWorld = casters_[place].boundsWorld = bounds;
            ++casters_[place].version;
        } else {
            std::ranges::find(blended_, place, [](const BlendedObject& blended) { return blended.batch.firstObject; })->centerWorld = 0.5f * (bounds.low + bounds.high);
        }
    }
    ++version_;
    gpu::updateBuffer(context_, objects_, std::as_bytes(std::span(objectTable_)), staging_);
}

size_t GpuScene::drawnMaterialStride() const {
    const size_t alignment = context_.limits().minUniformBufferOffsetAlignment;
    return (sizeof(DrawnMaterial) + alignment - 1) / alignment * alignment;
}

void GpuScene::uploadMaterials(const Scene& scene) {
    const std::vector<VertexColors> colors = vertexColorsByMaterial(scene);
    const size_t drawnStride = drawnMaterialStride();
    std::vector<std::byte> drawnMaterials(scene.materials.size() * drawnStride);
    // Row 0 is "no surface": no equation, no light.
    std::vector<MaterialConstants> materials(1);
    materials[0].equation = kNoIndex;
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        const MaterialTables tables = materialTables(scene.materials[i], colors[i].bound);
        materials.push_back(tables.material);
        equations_ |= 1u << tables.material.equation;
        if (tables.material.cs0Scale != 1 || tables.material.cs1Scale != 1) equations_ |= kMaterialsScale;
        if (tables.material.kEmissive != 0) equations_ |= kMaterialsEmit;
        const DrawnMaterial drawn{tables.surface, tables.material};
        std::memcpy(&drawnMaterials[i * drawnStride], &drawn, sizeof drawn);
        drawMaterials_.push_back({.surfaceShader = uint32_t(scene.materials[i].surface),
                                  .inputs = uint32_t(!colors[i].white) << kVertexColors,
                                  .equation = uint32_t(scene.materials[i].equation),
                                  .masked = scene.materials[i].alphaMode == AlphaMode::mask,
                                  .doubleSided = scene.materials[i].doubleSided});
    }
    drawnMaterials_ = gpu::uploadBuffer(context_, "drawn materials", drawnMaterials, Usage::eUniformBuffer);
    if (materials.size() <= kUniformMaterials && kUniformMaterials * sizeof(MaterialConstants) <= context_.limits().maxUniformBufferRange) equations_ |= kMaterialsFit;
    materials.resize(std::max<size_t>(materials.size(), kUniformMaterials));  // never smaller than the uniform block
    materials_ = gpu::uploadBuffer(context_, "materials", materials, Usage::eStorageBuffer | Usage::eUniformBuffer);
}

void GpuScene::createMaterialSets(const Scene& scene, const gpu::Pipelines& pipelines) {
    const auto count = uint32_t(scene.materials.size());
    const vk::DescriptorPoolSize sizes[] = {{vk::DescriptorType::eCombinedImageSampler, count * kMaterialTextures + 2 * kFrameSampledCount},
                                            {vk::DescriptorType::eStorageBuffer, 2 * kFrameStorageCount},
                                            {vk::DescriptorType::eUniformBuffer, count + 2 * 5}};
    pool_ = vk::raii::DescriptorPool(context_.device(), {.maxSets = count + 2,
                                                         .poolSizeCount = uint32_t(std::size(sizes)),
                                                         .pPoolSizes = sizes});
    if (count == 0) return;
    const auto sets = gpu::allocateSets(context_, pool_, pipelines.materialSetLayout(), count);
    for (uint32_t i = 0; i < count; ++i) {
        const Material& material = scene.materials[i];
        const auto infos = textures_.of(material);
        context_.device().updateDescriptorSets(
            vk::WriteDescriptorSet{.dstSet = sets[i],
                                   .dstBinding = 0,
                                   .descriptorCount = kTextureSlots,
                                   .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                   .pImageInfo = infos.data()},
            nullptr);
        const vk::DescriptorBufferInfo constants{*drawnMaterials_.handle, i * drawnMaterialStride(), sizeof(DrawnMaterial)};
        context_.device().updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = sets[i],
                                                                      .dstBinding = kMaterialTextures,
                                                                      .descriptorCount = 1,
                                                                      .descriptorType = vk::DescriptorType::eUniformBuffer,
                                                                      .pBufferInfo = &constants},
                                               nullptr);
        drawMaterials_[i].inputs |= SceneTextures::presentIn(material);
        drawMaterials_[i].set = sets[i];
    }
}

void GpuScene::uploadFunctions(const Scene& scene) {
    std::vector<vec2> table = functionTable(scene.functions);
    if (table.empty()) table.resize(kFunctionSamples);  // there are no empty images
    const std::span<const std::byte> level = std::as_bytes(std::span(table));
    functions_ = gpu::uploadImage(context_, "function table", vk::Format::eR32G32Sfloat,
                                  {kFunctionSamples, uint32_t(table.size() / kFunctionSamples)}, std::span(&level, 1));
}

void GpuScene::uploadLights(std::span<const Light> lights, std::optional<Bounce> bounce) {
    constexpr uint32_t kMostLights = 64 * 65535;  // a dispatch of so many, in groups of 64, is the most that every device takes
    const uint32_t placed = bounce ? bounce->grid * bounce->grid : 0;
    if (lights.size() + placed > kMostLights)
        throw Error(ErrorKind::limit, fmt::format("lights: expected at most {}, got {}", kMostLights, lights.size() + placed));
    SortedLights sorted = sortLights(lights, functionCount_);
    uint32_t features = render::lightFeatures(lights);
    if (bounce) {
        bounce->light = uint32_t(std::ranges::find(sorted.sources, bounce->sceneIndex, &PackedLight::sceneIndex) - sorted.sources.begin());
        bounce->first = addPlacedLights(sorted, lights[bounce->sceneIndex].linkGroup, uint32_t(lights.size()), placed);
        features |= kUsesLocal | kUsesSpot | kUsesContributions | kUsesLambertian;
    }
    if (sorted.sources.size() <= kUniformLights && kUniformLightBytes <= context_.limits().maxUniformBufferRange) features |= kUsesUniformLights;
    if (sorted.kinds.size() <= kUniformLightKinds && kUniformLightKindBytes <= context_.limits().maxUniformBufferRange) features |= kUsesUniformLightKinds;
    const auto rows = std::as_bytes(std::span(sorted.sources)), kindRows = std::as_bytes(std::span(sorted.kinds));
    // All memory first: what there is not enough of leaves the lights as they were.
    const auto larger = [&](const gpu::Buffer& table, const char* name, uint64_t bytes) {
        return bytes > table.bytes ? gpu::makeBuffer(context_, name, bytes, Usage::eStorageBuffer | Usage::eUniformBuffer | Usage::eTransferDst) : gpu::Buffer{};
    };
    gpu::Buffer table = larger(lightTable_, "light table", std::max(rows.size(), kUniformLightBytes));
    gpu::Buffer kinds = larger(lightKinds_, "light kinds", std::max(kindRows.size(), kUniformLightKindBytes));
    std::vector<vec4> tree = lightTree(sorted, volumes_);
    const auto treeRows = uint32_t(std::max<size_t>(1, (tree.size() + kTreeWidth - 1) / kTreeWidth));
    tree.resize(size_t(treeRows) * kTreeWidth);
    const std::span<const std::byte> texels = std::as_bytes(std::span(tree));
    gpu::Image treeImage = gpu::uploadImage(context_, "light tree", vk::Format::eR32G32B32A32Sfloat, {kTreeWidth, treeRows}, std::span(&texels, 1));
    if (table.bytes > 0) lightTable_ = std::move(table);
    if (kinds.bytes > 0) lightKinds_ = std::move(kinds);
    lightTree_ = std::move(treeImage);
    gpu::updateBuffer(context_, lightTable_, rows, staging_);
    gpu::updateBuffer(context_, lightKinds_, kindRows, staging_);
    lights_ = std::move(sorted);
    lightFeatures_ = features;
    bounce_ = std::move(bounce);
    if (!bounce_) return;
    ViewConstants seen = render::viewConstants({bounce_->camera, uvec2(bounce_->grid)}, ambience_);
    seen.lightCount = lightCount();
    seen.linkWords = linkWords_;
    bounceView_.write(std::span<const ViewConstants>(&seen, 1));
}

bool GpuScene::setLights(std::span<const Light> lights) {
    // The bounce of a light that still can: render would only ask for the same again.
    std::optional<Bounce> bounce;
    if (bounce_ && bounce_->sceneIndex < lights.size() && whyNoBounce(lights[bounce_->sceneIndex]).empty())
        bounce = {.sceneIndex = bounce_->sceneIndex, .grid = bounce_->grid, .camera = bounceCamera(lights[bounce_->sceneIndex])};
    const auto structure = [&] {
        return std::tuple(lights_.unbounded, lights_.shaped, lights_.meshes, lightFeatures_, bounce_.has_value(), *lightTable_.handle, *lightKinds_.handle);
    };
    const auto before = structure();
    uploadLights(lights, bounce);
    sceneLights_.assign(lights.begin(), lights.end());
    ++version_;
    const bool changed = structure() != before;
    writeFrameSets();  // the tree is a new image
    return changed || lights_.meshes > 0;
}

bool GpuScene::setBounce(const RenderSettings& settings) {
    const std::optional<uint32_t> wanted = bouncingLight(sceneLights_, settings);
    if (wanted ? bounce_ && bounce_->sceneIndex == *wanted && bounce_->grid == settings.bounceGrid : !bounce_) return false;
    std::optional<Bounce> bounce;
    if (wanted) bounce = {.sceneIndex = *wanted, .grid = settings.bounceGrid, .camera = bounceCamera(sceneLights_[*wanted])};
    uploadLights(sceneLights_, bounce);
    writeFrameSets();
    return true;
}

void GpuScene::writeFrameSets() {
    writeFrameSet(frameSet_, view_.handle());
    writeFrameSet(bounceSet_, bounceView_.handle());
}

void GpuScene::writeFrameSet(vk::DescriptorSet set, vk::Buffer view) {
    struct Binding {
        uint32_t slot;
        vk::Buffer buffer;
        vk::DescriptorType type;
        vk::DeviceSize range;
    };
    const auto storage = vk::DescriptorType::eStorageBuffer, uniform = vk::DescriptorType::eUniformBuffer;
    const vk::DeviceSize most = context_.limits().maxUniformBufferRange;
    const bool stencilled = shadowKind_ == Shadows::volumes;
    const Binding bindings[] = {{kFrameView, view, uniform, VK_WHOLE_SIZE},
                                {kFrameMaterials, *materials_.handle, storage, VK_WHOLE_SIZE},
                                {kFrameUniformMaterials, *materials_.handle, uniform, std::min<vk::DeviceSize>(kUniformMaterials * sizeof(MaterialConstants), most)},
                                {kFrameLights, *lightTable_.handle, storage, VK_WHOLE_SIZE},
                                {kFrameLinks, *links_.handle, storage, VK_WHOLE_SIZE},
                                {kFrameUniformLights, *lightTable_.handle, uniform, std::min(kUniformLightBytes, most)},
                                {kFrameLightKinds, *lightKinds_.handle, storage, VK_WHOLE_SIZE},
                                {kFrameUniformLightKinds, *lightKinds_.handle, uniform, std::min(kUniformLightKindBytes, most)},
                                {kFrameVolumes, *volumeTable_.handle, storage, VK_WHOLE_SIZE},
                                {kFrameVolumeVertices, *volumeVertices_.handle, storage, VK_WHOLE_SIZE},
                                {kFrameShadowedLights, shadowedLights_.handle(), storage, VK_WHOLE_SIZE},
                                {kFrameUniformShadowedLights, shadowedLights_.handle(), uniform, kUniformShadowedLightBytes},
                                {kFrameShadowMaps, stencilled ? shadowVolumes_.mask() : shadows_.maps(), storage, VK_WHOLE_SIZE}};
    for (const Binding& binding : bindings) {
        const vk::DescriptorBufferInfo info{.buffer = binding.buffer, .range = binding.range};
        context_.device().updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = set,
                                                                      .dstBinding = binding.slot,
                                                                      .descriptorCount = 1,
                                                                      .descriptorType = binding.type,
                                                                      .pBufferInfo = &info},
                                               nullptr);
    }
    struct Texture {
        uint32_t slot;
        vk::ImageView view;
        vk::Sampler sampler;
        vk::ImageLayout layout;
    };
    const auto readOnly = vk::ImageLayout::eShaderReadOnlyOptimal;
    const Texture textures[] = {{kFrameFunctions, *functions_.view, textures_.samplerOf({}), readOnly},
                                {kFrameLightTree, *lightTree_.view, textures_.samplerOf({}), readOnly},
                                {kFrameShadowAtlas, shadows_.atlas(), textures_.samplerOf(kTexels), vk::ImageLayout::eDepthReadOnlyOptimal}};
    for (const Texture& texture : textures) {
        const vk::DescriptorImageInfo info{.sampler = texture.sampler, .imageView = texture.view, .imageLayout = texture.layout};
        context_.device().updateDescriptorSets(
            vk::WriteDescriptorSet{.dstSet = set,
                                   .dstBinding = texture.slot,
                                   .descriptorCount = 1,
                                   .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                   .pImageInfo = &info},
            nullptr);
    }
}

bool GpuScene::setShadows(const View& view, const RenderSettings& settings) {
    if (settings.shadows == Shadows::off) return false;
    const auto castsFor = [&](uint32_t group, uint32_t objectId) {
        return group == kNone || (objectId < castingObjects_[group].size() && castingObjects_[group][objectId]);
    };
    const ShadowPlan::Inputs in{.view = view,
                                .settings = settings,
                                .lights = sceneLights_,
                                .casters = casters_,
                                .boundsWorld = boundsWorld_,
                                .castsFor = castsFor,
                                .largestSide = std::min({context_.limits().maxImageDimension2D, context_.limits().maxFramebufferWidth, context_.limits().maxFramebufferHeight}),
                                .version = version_};
    const auto images = shadows_.images();
    const bool volumes = settings.shadows == Shadows::volumes;
    std::vector<uint32_t> shadowed(lightCount());
    const bool changed = volumes ? shadowVolumes_.update(in, volumeMeshes(), shadowed) : shadows_.update(in, shadowed);
    const bool larger = shadowedLights_.update(context_, "shadowed lights", std::as_bytes(std::span(shadowed)), kUniformShadowedLightBytes);
    if (changed || larger || shadowKind_ != settings.shadows) {
        shadowKind_ = settings.shadows;
        writeFrameSets();
    }
    return (volumes && changed) || shadows_.images() != images;
}

ShadowVolumes::Meshes GpuScene::volumeMeshes() const {
    return {.ranges = meshes_, .vertices = vertices_, .indices = indices_, .objects = objects_, .meshOfObject = meshOfPlace_};
}

void GpuScene::setView(const View& view, const RenderSettings& settings, GBufferLayout layout) {
    viewConstants_ = render::viewConstants(view, ambience_);
    viewConstants_.lightCount = lightCount();
    viewConstants_.shadowMaskWords = shadowVolumes_.maskWords();
    viewConstants_.linkWords = linkWords_;
    viewConstants_.exposure = std::exp2(exposureEv_ + settings.exposureEv);
    viewConstants_.cullLights = settings.cullLights;
    viewConstants_.slack = viewSlack(view, layout, settings.msaa != Msaa::x1);
    view_.write(std::span<const ViewConstants>(&viewConstants_, 1));
    const vec3 backwards(view.camera.worldFromView[2]);
    std::ranges::stable_sort(blended_, {}, [&](const BlendedObject& object) { return dot(object.centerWorld, backwards); });
}

std::vector<LightSlice> GpuScene::slices(uint32_t first, uint32_t count) const {
    std::vector<LightSlice> slices;
    uint32_t rounds = kLightsPerDraw;
    for (uint32_t i = first; i < first + count; ++i) {
        const bool mesh = i >= lights_.unbounded + lights_.shaped;
        const uint32_t more = 1 + (mesh ? volumeOf(lights_.at(i)).vertexCount / 3 : 0);
        if (rounds + more > kLightsPerDraw) {
            slices.push_back({i, 0});
            rounds = 0;
        }
        ++slices.back().count;
        rounds += more;
    }
    return slices;
}

void GpuScene::bindMeshes(frame::PassContext& pass) const {
    pass.commands.bindVertexBuffers(0, {*vertices_.handle, *objects_.handle}, {0, 0});
    pass.commands.bindIndexBuffer(*indices_.handle, 0, vk::IndexType::eUint32);
}

void GpuScene::bindMaterial(frame::PassContext& pass, uint32_t index, const SurfaceShading& shading) const {
    const DrawMaterial& material = drawMaterials_[index];
    std::vector<uint32_t> constants = shading.frame;
    if (shading.oneEquation) constants[kConstantEquations] = 1u << material.equation | (equations_ & ~kEquationBits);
    constants.insert(constants.end(), {material.surfaceShader, material.masked, material.inputs});
    constants.insert(constants.end(), shading.own.begin(), shading.own.end());
    pass.bind({.vertex = "render/geometry/surface.vert",
               .fragment = shading.fragment,
               .meshVertices = true,
               .blend = shading.blend,
               .constants = std::move(constants)});
    pass.bindSet(kMaterialSet, material.set);
    pass.push(shading.slice);
    pass.commands.setCullMode(material.doubleSided ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
}

void GpuScene::drawBatch(frame::PassContext& pass, const Batch& batch) const {
    // Vulkan tells the winding in its own space, Y down, as our clip space is: what is counter-clockwise to the eye is
    // counter-clockwise to the rasterizer.
    pass.commands.setFrontFace(batch.mirrored ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise);
    const MeshRange& mesh = meshes_[batch.mesh];
    pass.drawIndexed(mesh.indexCount, batch.objectCount, mesh.firstIndex, mesh.firstVertex, batch.firstObject);
}

void GpuScene::drawDepth(frame::PassContext& pass) const {
    if (batches_.empty()) return;
    bindMeshes(pass);
    for (const Batch& batch : batches_) {
        const DrawMaterial& material = drawMaterials_[batch.material];
        bindMaterial(pass, batch.material, {material.masked ? "render/geometry/depth_masked.frag" : "", {0, ~0u, ~0u}});
        drawBatch(pass, batch);
    }
}

void GpuScene::drawCasters(frame::PassContext& pass, const ShadowPush& push, std::span<const uint32_t> casters, ShadowCasters faces) const {
    if (casters.empty()) return;
    bindMeshes(pass);
    auto caster = casters.begin();
    for (const Batch& batch : batches_) {
        const uint32_t end = batch.firstObject + batch.objectCount;
        if (caster == casters.end()) return;
        if (*caster >= end) continue;
        const DrawMaterial& material = drawMaterials_[batch.material];
        if (material.masked) {
            pass.bind({.vertex = "render/shadow/shadow.vert+MASKED", .fragment = "render/geometry/depth_masked.frag", .meshVertices = true,
                       .constants = {0, ~0u, ~0u, material.surfaceShader, material.masked, material.inputs}});
            pass.bindSet(kMaterialSet, material.set);
        } else {
            pass.bind({.vertex = "render/shadow/shadow.vert", .meshVertices = true});
        }
        pass.push(push);
        pass.commands.setCullMode(faces == ShadowCasters::frontFaces  ? vk::CullModeFlagBits::eBack
                                  : faces == ShadowCasters::backFaces ? vk::CullModeFlagBits::eFront
                                                                      : vk::CullModeFlagBits::eNone);
        while (caster != casters.end() && *caster < end) {
            Batch run = batch;
            run.firstObject = *caster;
            run.objectCount = 0;
            for (; caster != casters.end() && *caster == run.firstObject + run.objectCount && *caster < end; ++caster) ++run.objectCount;
            drawBatch(pass, run);
        }
    }
}

void GpuScene::drawSurfaces(frame::PassContext& pass, const SurfaceShading& shading) const {
    drawSurfaces(pass, shading, [&](const Batch& batch) { drawBatch(pass, batch); });
}

void GpuScene::drawSurfaces(frame::PassContext& pass, const SurfaceShading& shading, const std::function<void(const Batch&)>& draw) const {
    if (batches_.empty()) return;
    bindMeshes(pass);
    uint32_t bound = kNone;
    for (const Batch& batch : batches_) {
        if (bound != batch.material) bindMaterial(pass, bound = batch.material, shading);
        draw(batch);
    }
}

void GpuScene::drawBlended(frame::PassContext& pass, const std::vector<SurfaceShading>& shadings) const {
    bindMeshes(pass);
    for (const BlendedObject& object : blended_)
        for (const auto culled : {vk::CullModeFlagBits::eFront, vk::CullModeFlagBits::eBack}) {
            if (culled == vk::CullModeFlagBits::eFront && !drawMaterials_[object.batch.material].doubleSided) continue;
            for (const SurfaceShading& shading : shadings) {
                bindMaterial(pass, object.batch.material, shading);
                pass.commands.setCullMode(culled);
                drawBatch(pass, object.batch);
            }
        }
}

}  // namespace luciole::render
