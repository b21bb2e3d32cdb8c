// Depths that were copied, each pixel's in its place. See SavedFrame.
uniform sampler2D seen; // window depths
uniform vec2 rows;      // pixels of row y are in row rows.x + y rows.y

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    gl_FragDepth = texelFetch(seen, ivec2(at.x, int(rows.x + rows.y * float(at.y))), 0).r;
}
