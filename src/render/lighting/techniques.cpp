#include "render/lighting/techniques.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <luciole/error.hpp>

namespace luciole::render {

const std::vector<LightingTechnique>& techniques() {
    using Stencil = LightingTechnique::Stencil;
    static const std::vector<LightingTechnique> table = {
        {.info = {"brute-force", "one pass, every light at every pixel, summed in registers: the yardstick", "baseline"}, .add = addBruteForce},
        {.info = {"fullscreen", "one full-screen pass per light, blended into the light buffer",
                  "Calver 2003, Photo-realistic Deferred Lighting, \"Full screen lights\""},
         .add = addFullScreen,
         .blendsLights = true},
        {.info = {"quad", "a screen-aligned quad per light around its projection, at the depth of its closest point",
                  "Calver 2003, \"Shaped Lights\""},
         .add = addQuad,
         .blendsLights = true},
        {.info = {"volume", "a convex mesh per light: front faces where they lie before the surface, back faces where the near plane cuts",
                  "Calver 2003, \"Convex Light Volumes\""},
         .add = addVolume,
         .stencil = Stencil::forMeshes,
         .onHost = true,
         .blendsLights = true},
        {.info = {"volume-stencil", "a convex mesh per light, drawn twice: only the pixels inside are lit",
                  "O'Donnell 2009, after the note on volume deferred shading"},
         .add = addVolumeStencil,
         .stencil = Stencil::always,
         .onHost = true,
         .blendsLights = true},
        {.info = {"volume-stencil-reference", "the same with a mark of its own for each light, so that marks may stay",
                  "O'Donnell 2009, after the note on volume deferred shading"},
         .add = addVolumeStencilReference,
         .stencil = Stencil::always,
         .onHost = true,
         .blendsLights = true},
        {.info = {"volume-instanced", "convex meshes, all that are drawn alike in one instanced draw; lists of them made on the device",
                  "the note on volume deferred shading"},
         .add = addVolumeInstanced,
         .stencil = Stencil::forMeshes,
         .blendsLights = true},
        {.info = {"tiled", "a list of lights for each tile of the picture, found in a hierarchy over the lights, and a loop over it at each pixel",
                  "Andersson 2009, Parallel Graphics in Frostbite; Harada 2012, A 2.5D Culling for Forward+", true},
         .add = addTiled,
         .whole = true},
        {.info = {"tiled-points", "the same lists; a point as large as the tile brings its lights along, so that pixels load none", "docs/techniques/tiled.md", true},
         .add = addTiledPoints,
         .whole = true,
         .points = true,
         .blendsLights = true},
        {.info = {"clustered", "a list of lights for each slice of a tile's depth that holds a surface",
                  "Olsson et al. 2012, Clustered Deferred and Forward Shading", true},
         .add = addClustered,
         .whole = true},
        {.info = {"clustered-forward", "the same lists for surfaces that are lit while they are drawn, those that blend as well",
                  "Olsson et al. 2012, Clustered Deferred and Forward Shading; Persson 2013, Practical Clustered Shading", true},
         .add = addClusteredForward,
         .forward = true,
         .samples = true},
        {.info = {"forward-loop", "surfaces lit while they are drawn, all lights in one loop: the yardstick of forward techniques", "baseline"},
         .add = addForwardLoop,
         .forward = true,
         .samples = true},
        {.info = {"light-indexed", "light volumes write light indices, surfaces look them up while they are drawn",
                  "Trebilco 2009, Light-Indexed Deferred Rendering"},
         .add = addLightIndexed,
         .forward = true,
         .stencil = Stencil::always,
         .samples = true},
        {.info = {"forward-multipass", "surfaces drawn once more for each light, those that it can touch only, and added up",
                  "Trebilco 2009, Light-Indexed Deferred Rendering: what it compares with (figure 2.9.1)"},
         .add = addForwardMultipass,
         .forward = true,
         .samples = true,
         .onHost = true,
         .blendsLights = true,
         .whyInexact = "adds up surfaces that coincide"},
        {.info = {"light-prepass", "light volumes add up light terms from normals alone, surfaces are drawn once more and give them colour",
                  "Engel 2008, Designing a Renderer for Multiple Lights: The Light Pre-Pass Renderer"},
         .add = addLightPrepass,
         .forward = true,
         .stencil = Stencil::forMeshes,
         .blendsLights = true,
         .whyInexact = "rounds normals to 16 bits"},
    };
    return table;
}

const LightingTechnique& idealTechnique() {
    static const LightingTechnique ideal{{"ideal", "each pixel's lights from a list of exactly those that reach it", "baseline"},
                                         addIdeal,
                                         false,
                                         LightingTechnique::Stencil::never,
                                         false,
                                         true};
    return ideal;
}

std::string yardstickOf(const LightingTechnique& technique) { return technique.forward ? "forward-loop" : "brute-force"; }

const LightingTechnique& techniqueNamed(const std::string& name) {
    if (name == idealTechnique().info.name) return idealTechnique();
    std::vector<std::string_view> names{kAutoLighting};
    for (const LightingTechnique& technique : techniques()) {
        if (technique.info.name == name) return technique;
        names.push_back(technique.info.name);
    }
    throw Error(ErrorKind::usage, fmt::format("lighting: expected one of {}, got \"{}\"", fmt::join(names, ", "), name));
}

}  // namespace luciole::render

namespace luciole {

const std::vector<LightingTechniqueInfo>& lightingTechniques() {
    static const std::vector<LightingTechniqueInfo> infos = [] {
        std::vector<LightingTechniqueInfo> rows{{render::kAutoLighting, "one of those below: exact for the scene, and the fastest of these as the device's calibration predicts",
                                                 "docs/techniques/auto.md", true}};
        for (const auto& technique : render::techniques()) rows.push_back(technique.info);
        rows.push_back({"reference", "on the CPU in double precision, no Vulkan: what every technique is held to",
                        "docs/conventions.md"});
        return rows;
    }();
    return infos;
}

}  // namespace luciole
