#version 460
#extension GL_GOOGLE_include_directive : require
// The geometry phase's surface shaders: fill the G-buffer, evaluate no light (Calver 2003, "Geometry phase").
#include "render/geometry/surface_input.glsl"
#include "render/geometry/gbuffer.glsl"
#include "render/geometry/procedural.glsl"

layout(location = 0) out vec4 outA;
layout(location = 1) out vec4 outB;
layout(location = 2) out vec4 outC;
layout(location = 3) out vec4 outD;

const uint kSurfaceChecker = 1u;  // enum SurfaceShader
const uint kSurfaceMarble = 2u;

vec3 shadingNormal(SurfaceConstants surface) {
    vec3 n = normalize(normalView);
    if (hasTexture(kTextureNormal)) {
        const vec3 t = normalize(tangentView.xyz);
        const vec3 b = cross(n, t) * tangentView.w;
        vec3 m = sampleTexture(textureNormal, surface, kTextureNormal).xyz * 2.0 - 1.0;
        m.xy *= surface.normalScale;
        n = normalize(t * m.x + b * m.y + n * m.z);
    }
    return gl_FrontFacing ? n : -n;
}

void main() {
    const ObjectConstants object = objects[objectIndex];
    const SurfaceConstants surface = surfaces[object.material];
    const vec3 p = positionObject * surface.proceduralScale;
    const vec3 width = max(abs(dFdx(positionObject)), abs(dFdy(positionObject))) * surface.proceduralScale;
    vec4 base = baseColor(surface);
    if (kSurfaceShader == kSurfaceChecker) base.rgb = mix(surface.proceduralColor, base.rgb, checker(p, width));
    if (kSurfaceShader == kSurfaceMarble) base.rgb = mix(base.rgb, surface.proceduralColor, marble(p));

    Surface s;
    s.P = positionView;
    s.N = shadingNormal(surface);
    s.Cs0 = base.rgb * surface.cs0Factor;
    s.Cs1 = surface.cs1;
    s.specularBlend = surface.metallic;
    s.roughness = surface.roughness;
    s.occlusion = 1.0;
    s.material = object.material;
    s.objectId = object.objectId;
    if (hasTexture(kTextureMetallicRoughness)) {
        const vec2 roughnessMetallic = sampleTexture(textureMetallicRoughness, surface, kTextureMetallicRoughness).gb;
        s.roughness *= roughnessMetallic.x;
        s.specularBlend *= roughnessMetallic.y;
    }
    if (hasTexture(kTextureOcclusion))
        s.occlusion += surface.occlusionStrength * (sampleTexture(textureOcclusion, surface, kTextureOcclusion).r - 1.0);
    if (hasTexture(kTextureEmissive)) s.Cs1 *= sampleTexture(textureEmissive, surface, kTextureEmissive).rgb;
    if (surface.equation == kEquationUnlit) s.Cs1 = base.rgb;
    s.Cs1 *= surface.cs1Factor;

    if (kMasked != 0u && base.a < surface.alphaCutoff) discard;
    const Texels texels = packSurface(s, gl_FragCoord);
    outA = texels.a;
    outB = texels.b;
    outC = texels.c;
    outD = texels.d;
}
