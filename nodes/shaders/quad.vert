// A rectangle over the whole viewport.
#if defined(FLATS) && FLATS > 0
// The vertices hand on what is the same for all pixels: where shaders run on the processor (Mesa 22.3's llvmpipe), each pixel
// fetches each number of a uniform for itself, and that was more than half of a map's program.
uniform vec4 constants[CONSTANTS];
flat out vec4 constant[FLATS];
#endif

void main() {
    gl_Position = gl_Vertex;
#if defined(FLATS) && FLATS > 0
    for (int i = 0; i < FLATS; ++i) constant[i] = constants[i];
#endif
}
