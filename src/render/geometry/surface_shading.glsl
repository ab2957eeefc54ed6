// The surface at this fragment, of every surface shader (Calver 2003, "Geometry phase"); no light is evaluated.
#ifndef LUCIOLE_SURFACE_SHADING_GLSL
#define LUCIOLE_SURFACE_SHADING_GLSL
#include "render/geometry/procedural.glsl"
#include "render/geometry/surface_input.glsl"
#include "render/shaders/surface.glsl"

const uint kSurfaceChecker = 1u;  // enum SurfaceShader
const uint kSurfaceMarble = 2u;

vec3 shadingNormal(SurfaceConstants surface) {
    vec3 n = normalize(HERE(normalView));
    if (hasTexture(kTextureNormal)) {
        const vec4 tangent = HERE(tangentView);
        const vec3 t = normalize(tangent.xyz);
        const vec3 b = cross(n, t) * tangent.w;
        vec3 m = sampleTexture(textureNormal, surface, kTextureNormal).xyz * 2.0 - 1.0;
        m.xy *= surface.normalScale;
        n = normalize(t * m.x + b * m.y + n * m.z);
    }
    return gl_FrontFacing ? n : -n;
}

// Cs0 and Cs1 come divided by the scales of MaterialConstants. Discards what the alpha mask cuts out. \param alpha in [0, 1]
Surface surfaceHere(out float alpha) {
    const SurfaceConstants surface = material.surface;
    const vec3 p = HERE(positionObject) * surface.proceduralScale;
    const vec3 width = max(abs(dFdx(positionObject)), abs(dFdy(positionObject))) * surface.proceduralScale;
    vec4 base = baseColor(surface);
    if (kSurfaceShader == kSurfaceChecker) base.rgb = mix(surface.proceduralColor, base.rgb, checker(p, width));
    if (kSurfaceShader == kSurfaceMarble) base.rgb = mix(base.rgb, surface.proceduralColor, marble(p));

    Surface s;
    s.P = HERE(positionView);
    s.N = shadingNormal(surface);
    s.Cs0 = base.rgb * surface.cs0Factor;
    s.Cs1 = surface.cs1;
    s.specularBlend = surface.metallic;
    s.roughness = surface.roughness;
    s.occlusion = 1.0;
    s.seen = true;
    s.material = materialAndObject.x;
    s.objectId = materialAndObject.y;
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
    alpha = clamp(base.a, 0.0, 1.0);
    return s;
}
#endif
