// Luciole's light indices for shaders of your own: include this one file. It needs GLSL 4.50 and no extension. Define before it
//   LUCIOLE_SET, LUCIOLE_BINDING   the set and the first of the six bindings that hold LightIndexDescriptors
//   LUCIOLE_PACKING                a uvec4, LightIndexer::packing(); from specialization constants it costs least
// and then, in a fragment shader, with the surface's position and normal in view space:
//     LucioleLights here = lucioleLights(ivec2(gl_FragCoord.xy));
//     for (uint index = lucioleNext(here); index != 0u; index = lucioleNext(here)) {
//         const LucioleArrival arrival = lucioleArrival(lucioleLight(index), positionView);
//         radiance += color / pi * arrival.E * max(dot(normalView, arrival.L), 0.0);
//     }
#ifndef LUCIOLE_LIGHT_INDEX_GLSL
#define LUCIOLE_LIGHT_INDEX_GLSL

const uint kLucioleDirectional = 0u;
const uint kLuciolePoint = 1u;
const uint kLucioleSpot = 2u;
const uint kLucioleDiffuse = 1u;        // flags: the parts of a surface's equation that a light adds
const uint kLucioleSpecular = 2u;
const uint kLucioleNone = 0xffffffffu;  // "no index"
const uint kLucioleSamples = 4097u;     // of a function

// A light as it lies in the table: no member is aligned to more than 4 bytes, so that std430 leaves no gaps. (C++ reads this struct, too:
// a test holds it to the one that fills the table.)
struct LucioleStoredLight {
    float position[3];
    float range;
    float direction[3];
    float coneScale;
    float color[3];
    float cosOuter;
    uint type;
    uint flags;
    uint attenuation;
    uint falloff;
    uint linkGroup;
    uint volume;
    uint sceneIndex;
};

#ifndef __cplusplus

// Index `n` of a pixel, the last light of the table first; 0: none, and none after it. The channels of the images, as whole numbers, hold
// a digit of each index, that of the newest highest (Trebilco 2009, "Light Index Packing: Bit Shifting").
uint lucioleDigits(uvec4 images[4], uint indexBits, uint entryBits, uint n) {
    const uint shift = 8u - entryBits * (n + 1u);
    const uint mask = (1u << entryBits) - 1u;
    uint index = 0u;
    for (uint channel = 0u; channel < indexBits / entryBits; ++channel)
        index |= ((images[channel >> 2u][channel & 3u] >> shift) & mask) << (channel * entryBits);
    return index;
}

// KHR_lights_punctual, "Range Property" and "Inner and Outer Cone Angles".
float lucioleInverseSquare(float dist, float range) {
    const float x = dist / range;
    const float x2 = x * x;
    const float d = max(dist, 0.01);
    return clamp(1.0 - x2 * x2, 0.0, 1.0) / (d * d);
}
float lucioleCone(float cosAngle, float cosOuter, float scale) {
    const float cone = clamp((cosAngle - cosOuter) * scale, 0.0, 1.0);
    return cone * cone;
}

// A function in its row of the table, linear between samples. `t` in [0, 1] spans its domain.
vec2 lucioleLookUp(sampler2D table, uint row, float t) {
    const float x = clamp(t, 0.0, 1.0) * float(kLucioleSamples - 1u);
    const int i = min(int(x), int(kLucioleSamples) - 2);
    const vec2 a = texelFetch(table, ivec2(i, row), 0).xy;
    const vec2 b = texelFetch(table, ivec2(i + 1, row), 0).xy;
    return mix(a, b, x - float(i));
}

#ifdef LUCIOLE_SET
layout(set = LUCIOLE_SET, binding = LUCIOLE_BINDING) uniform sampler2D lucioleIndices0;
layout(set = LUCIOLE_SET, binding = LUCIOLE_BINDING + 1) uniform sampler2D lucioleIndices1;
layout(set = LUCIOLE_SET, binding = LUCIOLE_BINDING + 2) uniform sampler2D lucioleIndices2;
layout(set = LUCIOLE_SET, binding = LUCIOLE_BINDING + 3) uniform sampler2D lucioleIndices3;
layout(set = LUCIOLE_SET, binding = LUCIOLE_BINDING + 4) uniform sampler2D lucioleFunctions;
layout(set = LUCIOLE_SET, binding = LUCIOLE_BINDING + 5, std430) readonly buffer LucioleTable { LucioleStoredLight lucioleTable[]; };

// The lights of one pixel, one after the other.
struct LucioleLights {
    uvec4 images[4];
    uint next;
};

LucioleLights lucioleLights(ivec2 pixel) {
    LucioleLights lights;
    lights.next = 0u;
    lights.images[0] = uvec4(texelFetch(lucioleIndices0, pixel, 0) * 255.0 + 0.5);
    lights.images[1] = LUCIOLE_PACKING.w > 1u ? uvec4(texelFetch(lucioleIndices1, pixel, 0) * 255.0 + 0.5) : uvec4(0);
    lights.images[2] = LUCIOLE_PACKING.w > 2u ? uvec4(texelFetch(lucioleIndices2, pixel, 0) * 255.0 + 0.5) : uvec4(0);
    lights.images[3] = LUCIOLE_PACKING.w > 2u ? uvec4(texelFetch(lucioleIndices3, pixel, 0) * 255.0 + 0.5) : uvec4(0);
    return lights;
}

// The index of the next light; 0: there are no more.
uint lucioleNext(inout LucioleLights lights) {
    return lights.next < LUCIOLE_PACKING.z ? lucioleDigits(lights.images, LUCIOLE_PACKING.x, LUCIOLE_PACKING.y, lights.next++) : 0u;
}

struct LucioleLight {
    uint type;           // kLucioleDirectional, kLuciolePoint, kLucioleSpot
    uint flags;          // kLucioleDiffuse, kLucioleSpecular
    vec3 position;       // view space, metres
    vec3 direction;      // view space, where it shines to
    vec3 color;          // candela; directional: lux
    float range;         // metres; very large where it has none
    float cosOuter, coneScale;
    uint attenuation, falloff;  // rows of the table of functions, or kLucioleNone
    uint linkGroup;      // as luciole::Light has it, or kLucioleNone: what belongs to it the host knows
    uint sceneIndex;     // in the lights that the host gave, for whatever else it keeps of them
};

// \param index from 1 to LightIndexer::lightCount()
LucioleLight lucioleLight(uint index) {
    const LucioleStoredLight s = lucioleTable[index - 1u];
    return LucioleLight(s.type, s.flags, vec3(s.position[0], s.position[1], s.position[2]), vec3(s.direction[0], s.direction[1], s.direction[2]),
                        vec3(s.color[0], s.color[1], s.color[2]), s.range, s.cosOuter, s.coneScale,
                        s.attenuation, s.falloff, s.linkGroup, s.sceneIndex);
}

// What arrives at a point: L to the light, E the irradiance on a plane that faces it. Zero beyond range and cone. Whether the point is
// in the light's volume only the index images tell.
struct LucioleArrival {
    vec3 L;
    vec3 E;
};

LucioleArrival lucioleArrival(LucioleLight light, vec3 positionView) {
    if (light.type == kLucioleDirectional) return LucioleArrival(-light.direction, light.color);
    const vec3 toLight = light.position - positionView;
    const float dist = length(toLight);
    const vec3 L = toLight / max(dist, 1e-6);
    if (dist >= light.range) return LucioleArrival(L, vec3(0));
    float strength = light.attenuation == kLucioleNone ? lucioleInverseSquare(dist, light.range)
                                                       : lucioleLookUp(lucioleFunctions, light.attenuation, dist / light.range).x;
    if (light.type == kLucioleSpot) {
        const float cosAngle = -dot(L, light.direction);
        if (light.falloff == kLucioleNone) strength *= lucioleCone(cosAngle, light.cosOuter, light.coneScale);
        else strength *= cosAngle > light.cosOuter ? lucioleLookUp(lucioleFunctions, light.falloff, 0.5 * cosAngle + 0.5).x : 0.0;
    }
    return LucioleArrival(L, light.color * strength);
}
#endif
#endif
#endif
