// A light as the table of lights stores it, and as shaders and the host look at it. Read by both compilers.
#ifndef LUCIOLE_LIGHT_SHARED_H
#define LUCIOLE_LIGHT_SHARED_H
#include "shared.h"
SHARED_BEGIN

const uint kNoIndex = 0xffffffffu;

// Types as enum LightType.
const uint kLightDirectional = 0u;
const uint kLightPoint = 1u;
const uint kLightSpot = 2u;
const uint kLightDiffuse = 1u;         // flags
const uint kLightSpecular = 2u;
const uint kLightInfiniteViewer = 4u;
const uint kLightLambertian = 8u;      // a patch of a surface that shines: docs/conventions.md, "Bounce"

// Of a light without a range: the largest number that GLSL divides by with a bounded error.
const float kNoRange = 8.507059e37f;   // 2^126

// A light that is not a spot has a cone that lets everything through, so that shading need not ask for the type.
const float kFullCone = -2.0f;         // its cosOuter
const float kFullConeScale = 2.0f;

// What many lights share. Set 0, kFrameLightKinds.
struct LightKind {
    uint attenuation;   // row of the function table, or kNoIndex
    uint falloff;       // likewise
    uint linkGroup;     // row of the link table, or kNoIndex
    uint volume;        // index into the volumes, or kNoIndex
};

// One light, world space, 56 bytes. Set 0, kFrameLights.
struct PackedLight {
    vec3 position;
    float range;
    vec3 direction;
    float coneScale;
    vec3 color;
    float cosOuter;
    uint sceneIndex;
    uint kindFlagsType; // from the highest bit on: 26 bits, index of its kind; 4 bits; 2 bits
};

// The same with what its kind says. Of most members no shader makes use in most scenes, and then none is loaded.
struct LightConstants {
    vec3 position;
    float range;        // metres; kNoRange where the light has none
    vec3 direction;     // where it shines to
    float coneScale;    // glTF's cone: clamp((cos - cosOuter) * coneScale)^2; of a Lambertian patch: s^2
    vec3 color;         // lux or candela
    float cosOuter;
    uint type;
    uint flags;
    uint attenuation;   // as LightKind
    uint falloff;
    uint linkGroup;
    uint volume;
    uint sceneIndex;    // in Scene::lights; the table is sorted
};

SHARED_FN uint kindOf(PackedLight light) { return light.kindFlagsType >> 6u; }

SHARED_FN PackedLight packLight(LightConstants light, uint kind) {
    PackedLight packed = {light.position, light.range, light.direction, light.coneScale, light.color, light.cosOuter, light.sceneIndex,
                          kind << 6u | light.flags << 2u | light.type};
    return packed;
}

SHARED_FN LightConstants unpackLight(PackedLight light, LightKind kind) {
    LightConstants unpacked = {light.position, light.range, light.direction, light.coneScale, light.color, light.cosOuter, light.kindFlagsType & 3u,
                               light.kindFlagsType >> 2u & 15u, kind.attenuation, kind.falloff, kind.linkGroup, kind.volume, light.sceneIndex};
    return unpacked;
}

// The difference to the eye first: it is exact, or nearly, for what is near the eye, however far both are from the origin.
SHARED_FN LightConstants inView(LightConstants lightWorld, mat4 viewFromWorld, vec3 eyeWorld) {
    LightConstants light = lightWorld;
    light.position = mat3(viewFromWorld) * (lightWorld.position - eyeWorld);
    light.direction = mat3(viewFromWorld) * lightWorld.direction;
    return light;
}

SHARED_END
#endif
