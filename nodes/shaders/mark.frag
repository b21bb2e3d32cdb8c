// Marks are made in the stencil buffer; colour writes are off.
#ifdef CUTOUT
uniform sampler2D cutout;
uniform vec2 alphaTest; // which alphas pass, as bits: 1 less than, 2 equal to, 4 greater than the second
in vec3 coordinates;    // s, t and q of unit 0
#endif

#ifdef EXTRUDE
uniform vec4 wire; // colour, where it is written
#endif

void main() {
#ifdef CUTOUT
    float alpha = textureProj(cutout, coordinates).a;
    int side = alpha < alphaTest.y ? 1 : alpha > alphaTest.y ? 4 : 2;
    if ((int(alphaTest.x) & side) == 0) discard;
#endif
#ifdef EXTRUDE
    gl_FragColor = wire;
#else
    gl_FragColor = vec4(0.0);
#endif
}
