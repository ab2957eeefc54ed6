#version 460
// One triangle over the whole target, infinitely far away: tested LESS against reversed depth it touches just the pixels
// that hold a surface.
void main() {
    const vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 4.0 - 1.0;
    gl_Position = vec4(corner, 0, 1);
}
