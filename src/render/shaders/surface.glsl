// A surface point as the lighting phase sees it, whatever the G-buffer's layout.
#ifndef LUCIOLE_SURFACE_GLSL
#define LUCIOLE_SURFACE_GLSL

struct Surface {
    vec3 P;               // metres; shading space, but view space while the geometry phase makes it
    vec3 N;               // likewise, unit
    vec3 Cs0;
    vec3 Cs1;
    float specularBlend;  // metallic-roughness: metallic
    float roughness;
    float occlusion;
    bool seen;            // false: there is no surface, and the rest may be any numbers
    uint material;        // 0 where there is no surface
    uint objectId;
};
#endif
