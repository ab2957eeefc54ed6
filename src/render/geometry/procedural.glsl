// Procedural surface shaders. Formulas: docs/conventions.md, "Surface".
#ifndef LUCIOLE_PROCEDURAL_GLSL
#define LUCIOLE_PROCEDURAL_GLSL

// Value in [0, 1] of a lattice point.
float latticeValue(ivec3 cell) {
    const uvec3 c = uvec3(cell);
    uint h = c.x * 73856093u ^ c.y * 19349663u ^ c.z * 83492791u;
    h = h * 747796405u + 2891336453u;
    h = ((h >> ((h >> 28u) + 4u)) ^ h) * 277803737u;
    h = (h >> 22u) ^ h;
    return float(h) / 4294967296.0;
}

// Value noise in [0, 1].
float noise(vec3 p) {
    const ivec3 cell = ivec3(floor(p));
    const vec3 f = p - floor(p);
    const vec3 w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    float sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const ivec3 o = ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        const vec3 side = mix(1.0 - w, w, vec3(o));
        sum += latticeValue(cell + o) * side.x * side.y * side.z;
    }
    return sum;
}

// Share of the second colour.
float marble(vec3 p) {
    float turbulence = 0.0;
    float frequency = 1.0;
    for (int octave = 0; octave < 5; ++octave) {
        turbulence += abs(2.0 * noise(p * frequency) - 1.0) / frequency;
        frequency *= 2.0;
    }
    const float vein = 0.5 + 0.5 * sin(6.28318530718 * (p.x + 0.5 * p.y + 0.7 * turbulence));
    return vein * vein * vein;
}

// Share of the first colour: a 3-D checkerboard, box-filtered over the pixel. `width` is |dp| across the pixel.
float checker(vec3 p, vec3 width) {
    const vec3 q = p + 0.381966;
    const vec3 w = max(width, vec3(1e-4));
    const vec3 low = abs(fract((q - 0.5 * w) * 0.5) - 0.5);
    const vec3 high = abs(fract((q + 0.5 * w) * 0.5) - 0.5);
    const vec3 i = clamp(2.0 * (low - high) / w, -1.0, 1.0);  // the difference loses digits far from the origin
    return 0.5 - 0.5 * i.x * i.y * i.z;
}
#endif
