#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// What is known of a view before it is rendered, and which lighting technique that speaks for (docs/techniques/auto.md).
namespace luciole {

/// What a view of a scene asks of lighting techniques: sums over all of the picture's pixels, estimated from a smaller picture.
/// A light's shape is what range and cone enclose, or the ball around the mesh that bounds it; links are not looked at.
struct SceneCounts {
    double pixels = 0;         ///< of the picture
    double covered = 0;        ///< pixels that show an opaque surface
    double fragments = 0;      ///< of opaque surfaces that pass the depth test in the order in which they are drawn, >= covered
    double meanDistance = 0;   ///< metres along the view axis to what is seen
    double blended = 0;        ///< fragments of surfaces that blend
    double triangles = 0;      ///< of the scene
    double lights = 0;
    double unbounded = 0;      ///< lights that reach everything
    double meshBounded = 0;    ///< lights that a mesh bounds
    double visible = 0;        ///< lights with a shape that covers a pixel
    double shapeTriangles = 0; ///< of the meshes drawn for these
    uint32_t mostReaching = 0; ///< lights that reach the surface at one pixel
    uint32_t mostBefore = 0;   ///< lights whose shape begins before the surface at one pixel

    // Pairs of a light with a shape and a pixel. Where no opaque surface is, all lies in front.
    double inRectangle = 0;    ///< the pixel lies in the rectangle around the shape
    double behindNearest = 0;  ///< and what it shows lies behind the shape's nearest point
    double onShape = 0;        ///< the shape covers the pixel
    double behindFront = 0;    ///< and its front lies before the surface
    double beforeBack = 0;     ///< or its back lies behind the surface
    double behindFace = 0;     ///< or the one of both that techniques draw: the back where the near plane may cut the front
    double surfaceBehindFront = 0;  ///< as behindFront, opaque surfaces only
    double blendedBehindFront = 0;  ///< as behindFront, for each fragment that blends there
    double reaching = 0;       ///< the surface lies in the shape
    double inTile = 0;         ///< the shape meets the box around what the pixel's tile of 16 x 16 pixels shows
    double inCluster = 0;      ///< the shape meets the box around what it shows of a quarter of an octave of depth
};

/// What is known about one technique for one view and settings.
struct TechniqueAdvice {
    std::string technique;
    std::optional<double> predictedMs;  ///< of a frame, as FrameStats::wallMs; none if it can't be chosen
    std::string whyNot;                 ///< why it can't be chosen; empty if it can
};

/// A choice between all techniques.
struct LightingAdvice {
    std::vector<TechniqueAdvice> techniques;  ///< those that can be chosen first, by time
    std::string technique;                    ///< the one chosen
    std::string reason;                       ///< one line: what was chosen and why
    SceneCounts counts;
    uint32_t countingFrames = 0;     ///< rendered to take the counts; 0: those taken before still hold
    uint32_t calibrationFrames = 0;  ///< rendered to measure the device; 0: it was known
    double calibrationMs = 0;        ///< that took
};

}  // namespace luciole
