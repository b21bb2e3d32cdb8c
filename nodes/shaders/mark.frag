// Marks are made in the stencil buffer; colour writes are off.
#ifdef CUTOUT
uniform sampler2D cutout;
uniform vec2 alphaTest; // which alphas pass, as bits: 1 less than, 2 equal to, 4 greater than the second
in vec3 coordinates;    // s, t and q of unit 0
#endif
#ifdef BITMAP // BitmapAtlas::bits
uniform usampler2D sheet; // of bytes, four to a block of 8 by 4 texels; of texel (x, y) of one byte y, bit x
flat in vec4 texels;      // the last one, for the border is empty; bytes in a row of blocks, the first byte in the sheet
in vec2 texel;
#endif

#ifdef EXTRUDE
uniform vec4 wire; // colour, where it is written
#endif

void main() {
#ifdef BITMAP
    ivec2 at = ivec2(clamp(texel, vec2(0.0), texels.xy));
    int place = (at.y >> 2) * int(texels.z) + int(texels.w) + (at.x >> 3 << 2 | at.y & 3);
    const int width = 1 << BITMAP;
    // By texture(): llvmpipe looks up a level's size for each pixel of texelFetch().
    uint bits = texture(sheet, (vec2(place & width - 1, place >> BITMAP) + 0.5) / float(width)).r;
    if (((bits >> uint(at.x & 7)) & 1u) == 0u) discard;
#endif
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
