#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/light_volume.shared.h"
#include "render/shaders/frame.glsl"

// Lists of lights to draw alike, in the order of the lights. A light's class is how its mesh is drawn. List c lies at
// c * lightCount and its length is the number of instances in its draw's arguments. Three dispatches, one per stage.
layout(constant_id = 3) const uint kStage = 0u;
layout(local_size_x = kVolumeGroup) in;
layout(push_constant, scalar) uniform Push { LightSlice shaped; };
layout(set = 1, binding = kPassStorage, scalar) buffer Classes { uint classes[]; };
layout(set = 1, binding = kPassStorage + 1, scalar) buffer GroupCounts { uint groupCounts[]; };  // [group][class]
layout(set = 1, binding = kPassStorage + 2, scalar) buffer Lists { uint lists[]; };
layout(set = 1, binding = kPassStorage + 3, scalar) buffer Arguments { IndexedDraw arguments[]; };

shared uint groupClasses[kVolumeGroup];

const uint kCulled = kVolumeClasses;

// Counts the lights of each class that stand before this one in its group.
uint rank(uint class_) {
    uint before = 0u;
    for (uint i = 0u; i < gl_LocalInvocationIndex; ++i) before += uint(groupClasses[i] == class_);
    return before;
}

void main() {
    const uint local = gl_LocalInvocationIndex;
    const uint group = gl_WorkGroupID.x;
    if (kStage == 1u) {  // counts become places, one invocation per class
        if (local >= kVolumeClasses) return;
        const uint groups = (shaped.count + kVolumeGroup - 1u) / kVolumeGroup;
        uint sum = 0u;
        for (uint i = 0u; i < groups; ++i) {
            const uint count = groupCounts[i * kVolumeClasses + local];
            groupCounts[i * kVolumeClasses + local] = sum;
            sum += count;
        }
        const uint lod = local >> 1u;
        IndexedDraw draw = {volumeIndexCount(lod), sum, volumeFirstIndex(lod), 0, 0u};
        arguments[local] = draw;
        return;
    }
    const uint place = gl_GlobalInvocationID.x;
    uint class_ = kCulled;
    if (place < shaped.count) {
        if (kStage == 0u) {
            const VolumeDraw draw = volumeDraw(view, lightInView(shaped.first + place));
            if (draw.visible) class_ = draw.lod * 2u + uint(draw.frontFaces);
            classes[place] = class_;
        } else {
            class_ = classes[place];
        }
    }
    groupClasses[local] = class_;
    barrier();
    if (kStage == 0u) {
        if (local < kVolumeClasses) {
            uint count = 0u;
            for (uint i = 0u; i < kVolumeGroup; ++i) count += uint(groupClasses[i] == local);
            groupCounts[group * kVolumeClasses + local] = count;
        }
    } else if (class_ != kCulled) {
        lists[class_ * shaped.count + groupCounts[group * kVolumeClasses + class_] + rank(class_)] = shaped.first + place;
    }
}
