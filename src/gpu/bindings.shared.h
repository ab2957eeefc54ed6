// Descriptor sets and bindings, and what meshes are drawn with, as Pipelines lays them out. Read by both compilers.
#ifndef LUCIOLE_BINDINGS_SHARED_H
#define LUCIOLE_BINDINGS_SHARED_H
#include "shared.h"
SHARED_BEGIN
const uint kFrameSet = 0u;
const uint kFrameView = 0u;       // uniform buffer: ViewConstants
const uint kFrameMaterials = 2u;  // storage buffer
const uint kFrameUniformMaterials = 3u;  // uniform buffer: the first materials once more
const uint kFrameLights = 4u;     // storage buffers from here ...
const uint kFrameLinks = 5u;
const uint kFrameFunctions = 6u;  // sampled image: the function table
const uint kFrameUniformLights = 7u;  // uniform buffer: the first lights once more
const uint kFrameLightKinds = 8u;     // storage buffers from here ...
const uint kFrameVolumes = 9u;
const uint kFrameVolumeVertices = 10u;
const uint kFrameUniformLightKinds = 11u;  // uniform buffer: the first kinds once more
const uint kFrameLightTree = 12u;     // sampled image: light_tree.shared.h
const uint kFrameShadowedLights = 13u;  // storage buffers: shadow.shared.h
const uint kFrameShadowMaps = 14u;
const uint kFrameShadowAtlas = 15u;   // sampled image, depth
const uint kFrameUniformShadowedLights = 16u;  // uniform buffer: the first shadowed lights once more
const uint kFrameStorageCount = 8u;  // of these
const uint kFrameSampledCount = 3u;

const uint kPassSet = 1u;
const uint kPassSampled = 0u;       // sampled images, by the slot that the pass names
const uint kPassSampledCount = 16u;
const uint kPassStorage = 16u;      // storage buffers, likewise
const uint kPassStorageCount = 6u;

const uint kMaterialSet = 2u;     // 5 sampled images, then a uniform buffer: DrawnMaterial
const uint kMaterialTextures = 5u;

const uint kPushBytes = 128u;

// One object: what vertex buffer 1 holds for each instance. Buffer 0 holds a luciole::Vertex for each vertex.
struct ObjectConstants {
    mat4 worldFromObject;
    mat3 worldNormalFromObject;
    float tangentSign;
    uint material;  // index into the materials; 0 means "no surface"
    uint objectId;
};
SHARED_END
#endif
