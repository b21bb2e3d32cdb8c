// Marks are made in the stencil buffer; colour writes are off.
#ifdef CUTOUT
uniform sampler2D cutout;
uniform vec2 alphaTest; // which alphas pass, as bits: 1 less than, 2 equal to, 4 greater than the second
in vec3 coordinates;    // s, t and q of unit 0
#endif
#ifdef BITMAP
uniform usampler2D bitmap; // of a texel (x, y) of the 8 by 4 that a word holds bit 8 y + x
uniform vec2 lastTexel;    // the border is empty
in vec2 texel;
#endif

void main() {
#ifdef BITMAP
    ivec2 at = ivec2(clamp(texel, vec2(0.0), lastTexel));
    uint word = texelFetch(bitmap, ivec2(at.x >> 3, at.y >> 2), 0).r;
    if (((word >> uint((at.y & 3) << 3 | at.x & 7)) & 1u) == 0u) discard;
#endif
#ifdef CUTOUT
    float alpha = textureProj(cutout, coordinates).a;
    int side = alpha < alphaTest.y ? 1 : alpha > alphaTest.y ? 4 : 2;
    if ((int(alphaTest.x) & side) == 0) discard;
#endif
    gl_FragColor = vec4(0.0);
}
