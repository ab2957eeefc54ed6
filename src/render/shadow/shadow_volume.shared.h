// What shadow_volume.vert and its caller agree on. Read by both compilers.
#ifndef LUCIOLE_SHADOW_VOLUME_SHARED_H
#define LUCIOLE_SHADOW_VOLUME_SHARED_H
#include "shared.h"
SHARED_BEGIN
const uint kVolumeVertices = 0u;  // storage buffers of the pass, by slot
const uint kVolumeIndices = 1u;
const uint kVolumeEdges = 2u;     // edgesOf each mesh
const uint kVolumeObjects = 3u;   // ObjectConstants
const uint kVolumeMask = 4u;      // of each pixel a bit for each light that shadow volumes hide from it

const uint kVertexFloats = 18u;   // of a luciole::Vertex, the first three its position

// Pushed for each object that casts into a light's shadow.
struct ShadowVolumePush {
    vec4 lightWorld;    // (position, 1) or (direction in which it shines, 0)
    uint object;        // place in the table of objects
    uint firstIndex;
    uint firstVertex;
    uint triangles;
    uint firstEdge;
    float reach;        // metres; 0: volumes reach to infinity
    uint maskWords;     // of a pixel
    uint light;         // bit of the mask
};

// The vertices of a volume: near caps, far caps, then two quads for the side of each edge.
SHARED_FN uint shadowVolumeVertices(uint triangles, uint edges) { return 6u * triangles + 12u * edges; }
SHARED_END
#endif
