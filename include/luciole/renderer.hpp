#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <luciole/advice.hpp>
#include <luciole/image.hpp>
#include <luciole/scene.hpp>
#include <luciole/settings.hpp>

namespace luciole {

/// What is seen: a camera and the picture's size in pixels, [1, 16384] each and at most the device's limit.
struct View {
    Camera camera;
    uvec2 extent{1024, 768};
};

struct DeviceInfo {
    std::string name;    ///< as the driver says
    std::string driver;  ///< name and version of the driver
    std::string apiVersion;
    bool software = false;
    bool usable = false;     ///< has what Luciole needs
    std::string whyUnusable;
};

/// All Vulkan devices of this machine, in the loader's order. Empty without a Vulkan loader or driver.
std::vector<DeviceInfo> listDevices();

struct RendererOptions {
    std::string device;       ///< index or part of a name; empty: the first discrete GPU, else any GPU, else software
    bool validation = false;  ///< core and synchronization validation; messages go to `onMessage`
    std::function<void(std::string_view)> onMessage;  ///< validation messages; may be empty
    std::string cacheFolder;  ///< where what was measured on a device is kept from one start to the next; empty: nowhere
};

struct PassStats {
    std::string name;
    std::optional<double> ms;  ///< GPU time, only with RenderSettings::measure: without a full barrier after each
                               ///< timestamp, per-pass times were seen to be wrong by any factor
    uint64_t bytes = 0;        ///< size of everything the pass declares to read and write
    uint32_t draws = 0;        ///< draw calls recorded
    uint32_t stencilDraws = 0; ///< those of them that only mark the stencil
};

/// What light-indexed rendering did, and what became of lights that found no room. Pairs are those of a light and a pixel that it
/// hits, whatever it is linked to; with msaa and lidr-cover surface a pixel's samples count one by one,
/// and lists count all lights on the way to the surface.
struct LightIndexStats {
    std::string packing;       ///< what held the indices: "bit-shift 4x255", or "list"
    bool fellBack = false;     ///< lists stood in for the packing, which could not hold all lights
    uint64_t pixelsOver = 0;   ///< pixels hit by more lights than the packing has room for
    uint64_t pairsOver = 0;    ///< the pairs beyond: lost, or, if `fellBack`, saved from being lost
    struct Lost {
        uint32_t light;        ///< index into Scene::lights
        uint64_t pairs;
        double radiance;       ///< summed over the pairs: what a white surface that faces the light would have sent
    };
    std::vector<Lost> lost;    ///< on-overflow priority: the lights of which something is lost, in the scene's order
    uint32_t rounds = 1;       ///< fillings of the index images, each followed by a pass over the surfaces
    uint64_t imageBytes = 0;   ///< of the index images
    uint64_t tableBytes = 0;   ///< of the light data that surfaces read by index
    uint64_t listEntries = 0;
    uint32_t mostAtOnce = 0;   ///< lights at one pixel, if lists were made
    double selfTestMs = 0;     ///< what it took to try the packing on the device; 0: it was tried before
    uint32_t wrongValues = 0;  ///< values that the device does not blend exactly; lists stand in for such a packing
    uint32_t withoutIndex = 0; ///< lights that every fragment looks at (lidr-types)
};

/// What lighting `auto` did.
struct LightingChoice {
    std::string technique;           ///< that made the frame
    std::string reason;              ///< one line: what was chosen and why
    uint32_t countingFrames = 0;     ///< LightingAdvice, of this frame
    uint32_t calibrationFrames = 0;
    double calibrationMs = 0;
};

/// The lists of lights that tiled and clustered techniques made.
struct LightListStats {
    uint32_t tileSize = 0;  ///< pixels
    uint32_t lists = 0;     ///< tiles, or clusters that hold a surface
    uint64_t entries = 0;   ///< of all lists
    uint32_t longest = 0;   ///< entries of the longest list; of several pages, of one of them
    uint32_t pages = 1;     ///< parts of the lights, each with lists of its own: one, unless a buffer or a loop would get too long
    uint64_t bytes = 0;     ///< of the lists and what leads to them
};

/// What became of shadow maps in a frame.
struct ShadowStats {
    uint32_t lights = 0;        ///< that have maps: they are in view, and something casts into them
    uint32_t maps = 0;          ///< of them all: one a spot, a face of a cube, or a cascade
    uint32_t drawn = 0;         ///< of these in this frame; the others were kept
    uint32_t casterDraws = 0;   ///< draw calls that took
    uint32_t coarser = 0;       ///< times that the sides of all maps were halved, so that they fit (shadow-memory)
    uint64_t texels = 0;        ///< of all maps
    uint64_t bytes = 0;         ///< of the atlas
    struct Without {
        uint32_t light;         ///< index into Scene::lights
        std::string reason;
    };
    std::vector<Without> waiting;  ///< lights of which a map is old, or was never drawn (shadow-redraws): its turn comes in a frame to follow
    std::vector<Without> lost;     ///< lights without a shadow
};

struct FrameStats {
    std::vector<PassStats> passes;
    double wallMs = 0;          ///< recording, submission and execution, without upload and read-back
    double recordMs = 0;        ///< of it, what the host takes to record the frame's commands
    uint64_t peakBytes = 0;     ///< device memory allocated for scene and frame together
    uint64_t triangles = 0;
    uint32_t lights = 0;
    std::optional<LightIndexStats> lightIndex;
    std::optional<LightListStats> lightLists;
    std::optional<ShadowStats> shadows;    ///< setting `shadows` only
    std::optional<LightingChoice> choice;  ///< lighting `auto` only
    std::string deviceName, driver;
};

/// An object elsewhere than it was.
struct MovedObject {
    uint32_t object;       ///< index into Scene::objects
    mat4 worldFromObject;  ///< in place of the one that it had
};

/// One rendered picture. All images have the view's size.
struct Frame {
    Image radiance;  ///< linear Rec. 709, 3 channels
    Image display;   ///< exposed, tone-mapped, sRGB-encoded, [0, 1], 3 channels
    std::map<std::string, Image> aovs;  ///< what was asked for, by name (see aovNames)
    FrameStats stats;
    std::string graph;  ///< the frame graph in Graphviz's language
};

/// Names of the additional layers: depth (metres along the view axis, 0 where nothing is), normal (world space),
/// cs0, cs1, material and id (indices; -1 where nothing is), light-count (lights that reach the pixel's surface: in
/// range, cone and volume, and linked to the object), and what the technique did, light by light, to find them:
/// evaluations (lights that its shader evaluated at the pixel), useful-evaluations (those of them that reach the surface),
/// light-fingerprint (a sum of one number per useful evaluation that depends on the light alone: equal fingerprints, equal
/// lights; exact up to 4,096 of them). Techniques that make lists of lights (LightingTechniqueInfo::lists) have two more: list-length (lights
/// in the list of the pixel's tile, or of its surface's cluster) and list-slice (the slice of depth that the list is for, 0 at the near plane,
/// 4 to an octave of distance, of an orthographic view 31 in all; 0 everywhere if lists are by tile; -1 where nothing is); with msaa those
/// of the pixel's first sample. Of several pages' lists the lengths are added up. Surfaces that blend are left out.
const std::vector<std::string>& aovNames();

struct LightingTechniqueInfo {
    std::string_view name;
    std::string_view help;
    std::string_view source;  ///< author, year, section
    bool lists = false;       ///< makes lists of lights by tile or cluster
};
const std::vector<LightingTechniqueInfo>& lightingTechniques();  ///< "auto" and "reference" included

/// A Vulkan device and what is kept on it between frames. Not thread-safe; use one per thread.
class Renderer {
public:
    /// \throws Error(device) if no device is usable, with the reason for each
    explicit Renderer(const RendererOptions& options = {});
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    const DeviceInfo& device() const;

    /// Brings a valid scene (see `validate`) onto the device, in place of the one before. `scene` may die afterwards.
    /// \throws Error(limit) for what the device can't hold, Error(deviceLost) if its memory is full
    void setScene(const Scene& scene);

    /// Brings other lights onto the device, as many as before or not, in place of those of the scene set last. They refer to its
    /// functions, link groups and light volumes, and may move every frame: lights that come in the same numbers, and use nothing new, cost
    /// no more than to sort and copy them. `lights` may die afterwards.
    /// \throws Error(scene) for lights that break a rule of scene.hpp (see `validate`), Error(limit) for more than the device can hold,
    ///         Error(deviceLost); the lights that were there stay, then
    void setLights(std::span<const Light> lights);

    /// Moves objects of the scene set last. Shadow maps that none of them casts into are kept, and of the others what never moved is not
    /// drawn again.
    /// \throws Error(scene) for an index beyond the scene's objects, a matrix that is not finite, is singular or mirrors where the one before
    ///         did not, or the other way round, and for objects whose first matrix was singular; Error(deviceLost). No object has moved, then
    void moveObjects(std::span<const MovedObject> moved);

    /// Renders one picture of the scene set last (an empty one at first) and waits for it.
    /// \throws Error(usage) for settings, Error(limit) for sizes beyond the device, Error(deviceLost)
    Frame render(const View& view, const RenderSettings& settings, const std::vector<std::string>& aovs = {});

    /// What each pass adds to the frame: the wall clock of the frame cut off behind it, less that of the frame cut off before it. Timestamps keep
    /// passes apart to time them; this leaves them to overlap as they do. Passes behind the cut are left out as well, because they would
    /// read what nobody wrote.
    /// \return a row for each pass, in order, with `ms` for that; noise may make it negative
    /// \throws as render
    std::vector<PassStats> ablate(const View& view, const RenderSettings& settings);

    /// What lighting `auto` would choose for such a frame, and what is known of every technique; settings.lighting does not matter.
    /// Renders a small picture of the scene, and, where the device is not known yet, others (docs/techniques/auto.md).
    /// \throws as render
    LightingAdvice advise(const View& view, const RenderSettings& settings);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace luciole
