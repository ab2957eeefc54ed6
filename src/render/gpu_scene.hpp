#pragma once
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include <luciole/renderer.hpp>

#include "frame/pass_context.hpp"
#include "gpu/pipelines.hpp"
#include "gpu/resources.hpp"
#include "render/scene_textures.hpp"
#include "render/shadow/shadow_maps.hpp"
#include "render/shadow/shadow_volumes.hpp"
#include "render/tables.hpp"

namespace luciole::render {

/// Objects that one draw call can draw: same mesh, material and winding, consecutive in the table of objects.
struct Batch {
    uint32_t mesh;
    uint32_t material;
    bool mirrored;
    uint32_t firstObject;
    uint32_t objectCount;
};

/// An object that hides what is behind it.
struct OpaqueObject {
    uint32_t objectId;
    Bounds boundsWorld;  ///< larger by what floats may round where its vertices are moved into world space
};

/// An object whose material lets through what is behind it, at its place in the table of objects.
struct BlendedObject {
    Batch batch;
    vec3 centerWorld;
};

/// How the surfaces of a pass are shaded: a fragment shader that includes surface_shading.glsl.
struct SurfaceShading {
    std::string fragment;
    std::vector<uint32_t> frame;  ///< specialization constants kConstant*
    std::vector<uint32_t> own = {};  ///< those that come after the material's (surface_input.glsl)
    gpu::Blend blend = gpu::Blend::replace;
    bool oneEquation = false;  ///< each material's pipeline knows its own equation only
    shared::LightSlice slice = {};  ///< pushed to the shader
};

/// The light whose bounce is shown, as the camera that it is, and where the lights that stand in for the bounce lie in the table.
struct Bounce {
    uint32_t sceneIndex;  ///< in Scene::lights
    uint32_t grid;
    Camera camera;
    uint32_t light = 0;  ///< its place in the light table
    uint32_t first = 0;  ///< placed lights are [first, first + grid * grid)
};

/// A scene on the device: vertices, textures, and the tables that shaders read (types.shared.h).
class GpuScene {
public:
    GpuScene(const gpu::Context& context, const gpu::Pipelines& pipelines, const Scene& scene);

    /// Puts other lights in place of the scene's, valid ones. \return whether a frame graph made with the old ones won't do: it knows how many
    /// there are of each shape, what they use, where the table lies, and the meshes that bound any
    /// \throws Error(limit) for more lights than a table holds; then the old ones stay
    bool setLights(std::span<const Light> lights);
    /// Moves objects. \throws Error(scene), and none has moved, then
    void moveObjects(std::span<const MovedObject> moved);
    /// Another number after each of these, for whoever looked at single lights or objects.
    uint32_t version() const { return version_; }

    /// Makes room for the lights of the bounce that the settings ask for, if they aren't those of the last call. \return whether so
    /// \throws Error(usage) for a light that can't bounce, Error(limit) for more lights than a table holds
    bool setBounce(const RenderSettings& settings);
    const std::optional<Bounce>& bounce() const { return bounce_; }
    vk::DescriptorSet bounceSet() const { return bounceSet_; }  ///< as frameSet, but seen from the light that bounces

    /// Plans the shadow maps of a frame (shadow_plan.hpp). \return whether a frame graph made before won't do: it knows the atlas
    /// \throws as ShadowPlan::update
    bool setShadows(const View& view, const RenderSettings& settings);
    const ShadowVolumes& shadowVolumes() const { return shadowVolumes_; }
    ShadowVolumes::Meshes volumeMeshes() const;
    ShadowMaps& shadows() { return shadows_; }
    const ShadowMaps& shadows() const { return shadows_; }

    /// Writes what depends on the view, whatever the number of lights.
    void setView(const View& view, const RenderSettings& settings, GBufferLayout layout);
    const shared::ViewConstants& view() const { return viewConstants_; }

    vk::DescriptorSet frameSet() const { return frameSet_; }

    /// What the lighting shaders can leave out for this scene (types.shared.h, kConstant*).
    uint32_t equations() const { return equations_; }
    uint32_t lightFeatures() const { return lightFeatures_; }
    uint32_t lightCount() const { return uint32_t(lights_.sources.size()); }
    /// The table of lights and their kinds.
    const SortedLights& lights() const { return lights_; }
    const VolumeTables& volumes() const { return volumes_; }
    const ObjectClasses& objectClasses() const { return objectClasses_; }
    const shared::VolumeConstants& volumeOf(const shared::LightConstants& light) const { return volumes_.volumes[light.volume]; }
    vk::Buffer volumeIndices() const { return *volumeIndices_.handle; }  ///< of the meshes of all levels of detail
    vk::Buffer lightTable() const { return *lightTable_.handle; }
    vk::ImageView functionImage() const { return *functions_.view; }
    uint64_t lightTableBytes() const { return lightCount() * sizeof(shared::PackedLight); }
    /// Lights [first, first + count), cut so that a draw that loops over a slice, and over the triangles of its lights' volumes,
    /// stays below kLightsPerDraw rounds.
    std::vector<shared::LightSlice> slices(uint32_t first, uint32_t count) const;
    uint64_t triangles() const { return triangles_; }

    /// Draws the surfaces that hide what is behind them: their depth, or shaded.
    void drawDepth(frame::PassContext& pass) const;
    /// Draws some of them, as a light sees them. \param casters places in the table of objects, rising
    void drawCasters(frame::PassContext& pass, const shared::ShadowPush& push, std::span<const uint32_t> casters, ShadowCasters faces) const;
    void drawSurfaces(frame::PassContext& pass, const SurfaceShading& shading) const;
    /// Calls `draw` for each batch of them with its material bound, for whoever draws parts of it, or draws it more than once.
    void drawSurfaces(frame::PassContext& pass, const SurfaceShading& shading, const std::function<void(const Batch&)>& draw) const;
    void drawBatch(frame::PassContext& pass, const Batch& batch) const;
    /// Those objects, at their places in the table of objects.
    const std::vector<OpaqueObject>& opaqueObjects() const { return opaque_; }
    /// Whether a link group, or kNoIndex, contains an object ID.
    bool linked(uint32_t group, uint32_t objectId) const {
        return group == shared::kNoIndex || (linkTable_[group * linkWords_ + objectId / 32] >> objectId % 32 & 1) != 0;
    }
    /// Draws the surfaces that let through what is behind them, the farthest object first, of each its back faces first.
    bool hasBlended() const { return !blended_.empty(); }
    /// \param shadings one after the other for each object
    void drawBlended(frame::PassContext& pass, const std::vector<SurfaceShading>& shadings) const;

private:
    using MeshRange = ShadowVolumes::Meshes::Range;
    struct DrawMaterial {
        uint32_t surfaceShader, inputs;  ///< kSurfaceShader and kInputs (surface_input.glsl)
        uint32_t equation;
        bool masked, doubleSided;
        vk::DescriptorSet set = {};
    };
    void uploadMeshes(const Scene& scene);
    void uploadObjects(const Scene& scene);
    void uploadMaterials(const Scene& scene);
    size_t drawnMaterialStride() const;  ///< bytes between those of two materials
    void createMaterialSets(const Scene& scene, const gpu::Pipelines& pipelines);
    void uploadFunctions(const Scene& scene);
    void uploadLights(std::span<const Light> lights, std::optional<Bounce> bounce);
    void writeFrameSets();
    void writeFrameSet(vk::DescriptorSet set, vk::Buffer view);
    void bindMeshes(frame::PassContext& pass) const;
    void bindMaterial(frame::PassContext& pass, uint32_t material, const SurfaceShading& shading) const;

    const gpu::Context& context_;
    gpu::Buffer vertices_, indices_;
    std::vector<MeshRange> meshes_;
    gpu::Buffer objects_, materials_, drawnMaterials_, links_;
    gpu::Buffer lightTable_, lightKinds_, volumeTable_, volumeVertices_, volumeIndices_;
    gpu::MappedBuffer view_, bounceView_, staging_;
    gpu::Image functions_, lightTree_;
    std::vector<Batch> batches_;
    std::vector<OpaqueObject> opaque_;
    std::vector<ShadowCaster> casters_;               ///< the same objects
    std::vector<Bounds> meshBounds_;                  ///< object space
    std::vector<uint32_t> placeOfObject_;             ///< in the table, by index in Scene::objects; kNone: not drawn
    std::vector<shared::ObjectConstants> objectTable_;
    std::vector<uint32_t> meshOfPlace_;
    std::vector<std::vector<bool>> castingObjects_;   ///< LinkGroup::castingObjects
    std::vector<BlendedObject> blended_;  ///< setView sorts them
    std::vector<DrawMaterial> drawMaterials_;
    SceneTextures textures_;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::DescriptorSet frameSet_, bounceSet_;
    std::vector<Light> sceneLights_;
    uint32_t version_ = 0;
    uint32_t functionCount_ = 0;
    SortedLights lights_;
    std::optional<Bounce> bounce_;
    VolumeTables volumes_;
    ObjectClasses objectClasses_;
    shared::ViewConstants viewConstants_{};
    Ambience ambience_;
    float exposureEv_ = 0;
    Bounds boundsWorld_;  ///< of all objects
    ShadowMaps shadows_;
    ShadowVolumes shadowVolumes_;
    gpu::Table shadowedLights_;          ///< of each light, what keeps it off
    Shadows shadowKind_ = Shadows::off;  ///< which of the two the frame's set names
    uint32_t equations_ = 0;
    uint32_t lightFeatures_ = 0;
    std::vector<uint32_t> linkTable_;
    uint32_t linkWords_ = 0;
    uint64_t triangles_ = 0;
};

}  // namespace luciole::render
