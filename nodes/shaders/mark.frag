// Marks are made in the stencil buffer; colour writes are off.
#ifdef CUTOUT
uniform sampler2D cutout;
uniform vec2 alphaTest; // which alphas pass, as bits: 1 less than, 2 equal to, 4 greater than the second
in vec3 coordinates;    // s, t and q of unit 0
#endif
#ifdef BITMAP
uniform usampler2D sheet; // of words; of a texel (x, y) of the 8 by 4 that one holds bit 8 y + x
flat in vec4 texels;      // the last one, for the border is empty; words in a row of them, the first word in the sheet
in vec2 texel;
#endif

void main() {
#ifdef BITMAP
    ivec2 at = ivec2(clamp(texel, vec2(0.0), texels.xy));
    int place = (at.y >> 2) * int(texels.z) + (at.x >> 3) + int(texels.w);
    uint word = texelFetch(sheet, ivec2(place & 1023, place >> 10), 0).r; // TerrainSheet::width
    if (((word >> uint((at.y & 3) << 3 | at.x & 7)) & 1u) == 0u) discard;
#endif
#ifdef CUTOUT
    float alpha = textureProj(cutout, coordinates).a;
    int side = alpha < alphaTest.y ? 1 : alpha > alphaTest.y ? 4 : 2;
    if ((int(alphaTest.x) & side) == 0) discard;
#endif
    gl_FragColor = vec4(0.0);
}
