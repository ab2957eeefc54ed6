#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/forward.glsl"

layout(push_constant, scalar) uniform Push { LightSlice slice; };

// Every light at every fragment, summed in registers.
void main() {
    beginSurface();
    for (uint i = 0u; i < slice.count; ++i) addLight(lightAt(slice.first + i));
    endSurface();
}
