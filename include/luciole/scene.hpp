#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <luciole/math.hpp>

/// A scene as plain data, no Vulkan. Whoever fills one by hand calls `validate`; the readers already have.
/// World space is right-handed, metres, +Y up (glTF's). Colours are linear Rec. 709.
namespace luciole {

inline constexpr uint32_t kNone = ~0u;  ///< "no index"

/// One vertex in object space. `normal` and `tangent.xyz` are unit length; `tangent.w` is the sign of the bitangent
/// (bitangent = cross(normal, tangent.xyz) * tangent.w, glTF 2.0 section 3.7.2.1). `color` is linear RGBA.
struct Vertex {
    vec3 position{0};
    vec3 normal{0, 0, 1};
    vec4 tangent{1, 0, 0, 1};
    vec2 uv0{0};
    vec2 uv1{0};
    vec4 color{1};
};

/// Triangle list, counter-clockwise front. `indices.size()` is a multiple of 3, every index < `vertices.size()`.
struct Mesh {
    std::string name;
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
};

/// One mesh with one material at one place. A negative determinant of `worldFromObject` flips the winding.
struct Object {
    std::string name;  ///< the glTF node's name; rig patterns match it
    uint32_t mesh = 0;
    uint32_t material = 0;
    mat4 worldFromObject{1};
    uint32_t objectId = 0;  ///< [0, kMaxObjectId]; light links refer to it; several objects may share one
};

/// 8-bit RGBA, [height][width][4], row 0 at the top. Whether it is sRGB-encoded depends on who uses it (glTF: base
/// colour and emissive are, the others are not).
struct Texels {
    std::string name;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;
};

enum class Wrap : uint8_t { repeat, mirroredRepeat, clampToEdge };
enum class Filter : uint8_t { nearest, linear };
enum class MipFilter : uint8_t { none, nearest, linear };  ///< none: only level 0 is sampled

struct Sampler {
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    Filter magFilter = Filter::linear;
    Filter minFilter = Filter::linear;
    MipFilter mipFilter = MipFilter::linear;
    bool operator==(const Sampler&) const = default;
};

struct Texture {
    uint32_t texels = 0;
    Sampler sampler;
};

/// How a material reads a texture: uv' = uvTransform * (u, v, 1), from UV set 0 or 1 (KHR_texture_transform).
struct TextureUse {
    uint32_t texture = kNone;
    uint32_t uvSet = 0;
    std::array<vec3, 2> uvTransform{vec3{1, 0, 0}, vec3{0, 1, 0}};  ///< rows of the affine 2x3 matrix
};

/// A function of one variable that the lighting reads from a table (Calver 2003, "Light Model" and "Shaped Lights").
/// Dot-product functions take x in [-1, 1]; attenuation takes distance / range in [0, 1]; angular falloff takes the
/// cosine between the spot's axis and the direction to the surface in [-1, 1].
/// Channel 0 is the shape, channel 1 the cascade multiplier (used of an Fa only).
struct Function {
    enum class Kind : uint8_t {
        lambert,     ///< max(x, 0); cascade 1 where x > 0
        wrap,        ///< parameter w in [0, 1]: max((x + w) / (1 + w), 0); cascade 1 where the shape > 0
        orenNayar,   ///< parameter roughness sigma >= 0, radians: directional albedo of Oren and Nayar 1994 (see
                     ///< docs/conventions.md); cascade 1 where x > 0
        blinnPhong,  ///< parameter exponent >= 0: max(x, 0)^exponent; cascade 1 where x > 0
        constant,    ///< parameter value: the value everywhere; cascade max(x, 0)
        toon,        ///< parameter number of steps n >= 1: ceil(n * max(x, 0)) / n; cascade 1 where x > 0
        sampled,     ///< `samples`, evenly spaced over the domain from its low to its high end, linear in between
    };
    std::string name;
    Kind kind = Kind::lambert;
    float parameter = 0;
    std::vector<vec2> samples;  ///< `sampled` only: at least 2
};

enum class LightEquation : uint8_t {
    metallicRoughness,  ///< glTF 2.0 Appendix B
    shaped,             ///< Calver 2003, "Light Model": shaped Blinn-Phong
    unlit,              ///< KHR_materials_unlit: shows its base colour, no light touches it
};

enum class SurfaceShader : uint8_t {
    textured,  ///< colour and normal from textures
    checker,   ///< 3-D checkerboard over object-space position
    marble,    ///< veined turbulence over object-space position
};

/// glTF 2.0, section 3.9.4 "Alpha Coverage". alpha = factor * texture * vertex colour.
enum class AlphaMode : uint8_t {
    opaque,
    mask,   ///< there where alpha >= alphaCutoff
    blend,  ///< glTF's BLEND: what is behind shows through by 1 - clamp(alpha, 0, 1); drawn after the others, sorted
};

/// Per-material constants of the shaped equation (Calver 2003, "Light Model"). Fa is read at N.L, Fb at N.H.
struct ShapedParameters {
    uint32_t diffuseFunction = 0;   ///< Fa, index into Scene::functions
    uint32_t specularFunction = 0;  ///< Fb, index into Scene::functions
    vec3 specularColor{1};          ///< Cs1 before Ks
    float kd = 1;                   ///< >= 0, folded into Cs0
    float ks = 1;                   ///< >= 0, folded into Cs1 (so it scales the emissive term too, as in the article)
    float specularBlend = 0;        ///< [0, 1]: 0 plastic (highlight takes the light's colour), 1 metal (only Cs1)
    vec3 kAmbient{0};               ///< Kamb per channel, >= 0
    float kEmissive = 0;            ///< Kemm, >= 0, of Cs1
};

struct Material {
    std::string name;
    LightEquation equation = LightEquation::metallicRoughness;
    SurfaceShader surface = SurfaceShader::textured;
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;  ///< `mask` only
    bool doubleSided = false;
    bool castsShadows = true;  ///< whether what it is on keeps light off; false for a lamp's own body

    vec4 baseColor{1};  ///< also Cs0 of the shaped equation
    float metallic = 1;
    float roughness = 1;
    vec3 emissive{0};  ///< radiance; factor times KHR_materials_emissive_strength
    float normalScale = 1;
    float occlusionStrength = 1;
    TextureUse baseColorTexture;          ///< sRGB
    TextureUse metallicRoughnessTexture;  ///< G roughness, B metallic
    TextureUse normalTexture;             ///< tangent space, RGB * 2 - 1
    TextureUse occlusionTexture;          ///< R
    TextureUse emissiveTexture;           ///< sRGB

    ShapedParameters shaped;       ///< equation `shaped` only
    vec3 proceduralColor{0};       ///< checker, marble: the second colour; the first is `baseColor`
    float proceduralScale = 1;     ///< checker, marble: cells (or veins) per metre of object space, > 0
};

enum class LightType : uint8_t { directional, point, spot };
enum class LightContribution : uint8_t { diffuseAndSpecular, diffuseOnly, specularOnly };

/// A light. `color` is Cl times the intensity: lux for a directional light, candela for the others (KHR_lights_punctual).
struct Light {
    std::string name;
    LightType type = LightType::point;
    vec3 positionWorld{0};          ///< metres; point and spot
    vec3 directionWorld{0, 0, -1};  ///< unit; where the light shines to; directional and spot
    vec3 color{1};                  ///< linear Rec. 709, >= 0
    float range = std::numeric_limits<float>::infinity();  ///< metres, > 0; exactly no effect at or beyond it
    float innerConeAngle = 0;          ///< radians, [0, outerConeAngle); spot
    float outerConeAngle = 0.785398f;  ///< radians, (innerConeAngle, pi]; spot. glTF's own limit is pi / 2
    uint32_t attenuation = kNone;  ///< kNone: glTF's inverse square with its range window. Else a function over
                                   ///< distance / range (needs a finite range) that scales `color` directly
    uint32_t falloff = kNone;      ///< kNone: glTF's cone. Else a function over the cosine
    LightContribution contribution = LightContribution::diffuseAndSpecular;
    bool infiniteViewer = false;  ///< shaped equation, directional: I = (0, 0, 1) in view space instead of -P / |P|
    uint32_t linkGroup = kNone;   ///< index into Scene::linkGroups; kNone: the light touches every object
    uint32_t volume = kNone;      ///< index into Scene::lightVolumes; kNone: range and cone alone bound the light
    bool castsShadows = true;     ///< with RenderSettings::shadows: whether objects keep it off what lies behind them
    float shadowSoftness = 1;     ///< [0, 4]: scales the width over which a filtered shadow's edge blurs; 0: hard
    float shadowResolution = 1;   ///< [1/16, 16]: scales the side of its shadow maps against those of others
};

inline constexpr float kShadowNear = 0.01f;  ///< metres along x, y and z; what is nearer to a light casts no shadow in it

/// A closed surface that bounds a light of any type, range and cone apart (Calver 2003, "Concave Light Volume"). Inside
/// are the points about which the surface winds: whose winding number is not 0, whichever way it is oriented. Each edge is run
/// through by its triangles as often one way as the other, counting vertices at equal positions as one.
struct LightVolume {
    std::string name;
    std::vector<vec3> positionsWorld;  ///< metres
    std::vector<uint32_t> indices;     ///< triangle list, 1 to kMaxVolumeTriangles triangles
};

/// Which objects a light touches, and which cast shadows in it (Calver 2003, "More Control over Lighting"). Indexed by
/// object ID; IDs beyond the end are not touched and cast no shadow.
struct LinkGroup {
    std::string name;
    std::vector<bool> litObjects;
    std::vector<bool> castingObjects;
};

/// The light that initialises the light buffer: `sky` from above, `ground` from below, blended by 0.5 + 0.5 N.up
/// (Calver 2003, "Full screen lights"). Equal colours give the article's plain ambient light. Radiance.
struct Ambience {
    vec3 sky{0};
    vec3 ground{0};
    vec3 upWorld{0, 1, 0};  ///< unit
};

inline constexpr float kLeastNear = 1e-18f;  ///< of perspective: depth is near / distance, and has to stay a number

struct Camera {
    std::string name;
    mat4 worldFromView{1};      ///< rigid, at most 1e17 m from the origin; looks down -Z
    bool orthographic = false;
    float yFov = 0.9f;          ///< radians, [1e-4, pi); perspective
    float halfHeight = 1;       ///< metres, > 0; orthographic. The width follows from the picture's aspect
    float zNear = 0.1f;         ///< metres, >= kLeastNear (orthographic: >= 0). Perspective has no far plane
    float zFar = 1000;          ///< metres, > zNear; orthographic only
    bool operator==(const Camera&) const = default;
};

inline constexpr uint32_t kMaxObjectId = 65535;    ///< object IDs are stored in 16 bits
inline constexpr uint32_t kMaxMaterials = 65535;   ///< material index 0 of the G-buffer means "no surface"
inline constexpr uint32_t kMaxLinkGroups = 4096;
inline constexpr uint32_t kMaxFunctions = 1024;
inline constexpr uint32_t kMaxVolumeTriangles = 16384;  ///< of one light volume

struct Scene {
    std::string name;
    std::vector<Mesh> meshes;
    std::vector<Object> objects;
    std::vector<Material> materials;  ///< at least one if there are objects
    std::vector<Texels> texels;
    std::vector<Texture> textures;
    std::vector<Function> functions;
    std::vector<Light> lights;
    std::vector<LinkGroup> linkGroups;
    std::vector<LightVolume> lightVolumes;
    std::vector<Camera> cameras;
    Ambience ambience;
    float exposureEv = 0;  ///< stops; the picture is radiance * 2^exposureEv before tone mapping

    std::vector<std::string> warnings;  ///< what the reader skipped or substituted, one line each
};

/// Axis-aligned bounds in world space of everything that is drawn; both zero for an empty scene.
struct Bounds {
    vec3 low{0};
    vec3 high{0};
};
Bounds boundsOf(const Scene& scene);

uint64_t triangleCount(const Scene& scene);

/// False for a singular `worldFromObject`: it leaves no inside and no normals, so the object is not drawn.
bool isDrawn(const Object& object);

/// Checks every rule stated in this header.
/// \throws Error(scene) naming the element, the rule and what was found; Error(limit) for the kMax* constants
void validate(const Scene& scene);
void validate(const Camera& camera);
/// Of lights only, as if they stood in `scene`: of it the functions and the numbers of link groups and light volumes are looked at.
void validate(std::span<const Light> lights, const Scene& scene);

/// Value (shape, cascade) of a dot-product, attenuation or falloff function, in double precision.
/// \param x anywhere; clamped to the domain [low, 1], with low = -1 for dot products and cosines, 0 for attenuation
dvec2 evaluate(const Function& function, double x, double low = -1);

/// A camera that shows the whole scene from its front, slightly above.
Camera autoCamera(const Scene& scene);

/// Rigid worldFromView of a camera at `eye` that looks at `target`, +Y up (or +Z where the view is vertical).
mat4 lookAt(vec3 eye, vec3 target);

}  // namespace luciole
