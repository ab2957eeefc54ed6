#pragma once
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <luciole/renderer.hpp>

#include "render/shadow/page_allocator.hpp"
#include "render/shadow/shadow.shared.h"

/// Which shadow maps a frame needs, how large, where in the atlas, and which of them have to be drawn. Knows no Vulkan.
namespace luciole::render {

/// An object as light meets it.
struct ShadowCaster {
    Bounds boundsWorld;
    uint32_t objectId;
    bool casts;            ///< its material keeps light off
    uint32_t version = 0;  ///< another one whenever it has moved; 0: it never did, and is taken for one that stands still
};

/// What a shadow map sees, world space.
struct ShadowFrustum {
    dvec3 origin{0};             ///< the light; orthographic: the middle of the nearest side
    dvec3 right{0}, down{0}, forward{0};  ///< unit; down is that of the atlas
    double tangent = 1;          ///< of half the angle; orthographic: half the width, metres
    double depth = 0;            ///< how far it reaches, metres
    bool orthographic = false;
};

/// A shadow map that the frame needs.
struct PlannedMap {
    uint32_t light;       ///< index in Scene::lights
    uint32_t face;        ///< of the cube, or number of the cascade
    ShadowFrustum frustum;
    double pixels;        ///< how large it is in the picture
    uint32_t side;        ///< texels wanted
    Page page;            ///< side 0: nothing casts into it
    bool drawn = false;   ///< holds something: now, or once it is drawn in this frame
    // Of maps that are drawn, as places in the table of objects:
    std::vector<uint32_t> casters = {};       ///< what is drawn into the page, over a copy of the still page if there is one
    bool overStill = false;                   ///< there is: what stands still is drawn apart from what moves, and seldom
    bool stillDirty = false;                  ///< it has to be drawn first
    std::vector<uint32_t> stillCasters = {};  ///< into it
};

class ShadowPlan {
public:
    struct Inputs {
        const View& view;
        const RenderSettings& settings;
        std::span<const Light> lights;
        std::span<const ShadowCaster> casters;
        Bounds boundsWorld;  ///< of all objects
        std::function<bool(uint32_t linkGroup, uint32_t objectId)> castsFor;
        uint32_t largestSide;  ///< of an image on the device
        uint64_t version;      ///< another one whenever lights or casters are others
    };

    /// Plans a frame. Maps stay where they are, and as they are, while nothing asks for another.
    /// \throws Error(limit) with on-overflow fail, for lights that go without a shadow, or wait for it
    void update(const Inputs& in);
    /// What was drawn is lost: the atlas is another image.
    void forget();

    /// Texels that the atlas has to have. It never shrinks but by settings.
    uvec2 extent() const { return pages_.extent(); }
    /// Whether there has to be another atlas, for what stands still, with the same pages.
    bool needsStill() const { return anyMoves_; }
    /// The maps of a light follow each other, by face.
    const std::vector<PlannedMap>& maps() const { return maps_; }
    /// Indices into maps(): those to draw in this frame, the most visible first.
    const std::vector<uint32_t>& dirty() const { return dirty_; }
    const ShadowStats& stats() const { return stats_; }

    /// How many maps a light has: one, the faces of a cube, or all cascades. Those that a frame does without are left out of maps().
    static uint32_t mapsOf(const Light& light);
    /// What shaders know of a map. \param eyeWorld origin of shading space; only directional lights' maps look at it
    static shared::ShadowMap constants(const PlannedMap& map, float softness, dvec3 eyeWorld);
    /// How it is drawn.
    static shared::ShadowPush push(const PlannedMap& map);

private:
    struct Kept {
        Page page;
        uint64_t drawn = 0;    ///< signature of what the page holds; 0: nothing
        uint64_t still = 0;    ///< likewise of the still page
        uint64_t casting = 0;  ///< signature of the light and the casters in its frustum, as of `version`
        uint64_t standing = 0; ///< likewise without those that move
        uint64_t version = 0;
        bool anyCaster = false, anyMoves = false;
        ShadowFrustum frustum = {};  ///< that the page was drawn from
        uint64_t lightSignature = 0;
        uint32_t waited = 0;   ///< frames, since it was drawn
        bool wanted = false;   ///< in this frame
    };
    using Key = std::pair<uint32_t, uint32_t>;  ///< light, face

    struct Asked {
        View view;
        RenderSettings settings;
        uint64_t version;
        uint32_t largestSide;
        bool operator==(const Asked&) const;
    };

    void collect(const Inputs& in);
    void collectLocal(const Inputs& in, uint32_t light);
    void collectDirectional(const Inputs& in, uint32_t light);
    void add(const Inputs& in, PlannedMap map);
    static uint64_t signatureOfPage(const Inputs& in, const Page& page, uint64_t casting);
    static bool castsInto(const Inputs& in, const PlannedMap& map, uint32_t caster);
    void fit(const Inputs& in);
    bool fits(const PlannedMap& map, const Kept& kept) const;
    std::vector<uint32_t> due(const Inputs& in) const;
    void placePages(const Inputs& in);
    void chooseDirty(const Inputs& in);

    std::map<Key, Kept> kept_;
    PageAllocator pages_;
    std::vector<PlannedMap> maps_;
    std::vector<uint32_t> dirty_;
    ShadowStats stats_;
    bool anyMoves_ = false;  ///< some caster did
    std::optional<Asked> last_;  ///< what the plan is for
};

}  // namespace luciole::render
