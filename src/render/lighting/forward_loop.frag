#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/lighting/forward.glsl"

layout(push_constant, scalar) uniform Push { LightSlice slice; };

// Every light at every fragment, summed in registers.
void main() {
    beginSurface();
    const LightSlice all = slice;  // read once, as eyeWorld is
    for (uint i = 0u; i < all.count; ++i) addLight(lightAt(all.first + i));
    endSurface();
}
