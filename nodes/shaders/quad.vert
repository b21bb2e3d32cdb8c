// A rectangle over the whole viewport.
#ifdef FLAT
// The vertices hand on what is the same for all pixels: where shaders run on the processor (Mesa 22.3's llvmpipe), each pixel
// fetches each number of a uniform for itself, and that was more than half of a map's program.
uniform vec4 constants[CONSTANTS];
flat out vec4 constant[CONSTANTS];
#endif

void main() {
    gl_Position = gl_Vertex;
#ifdef FLAT
    constant = constants;
#endif
}
