// The least depth in a block of texels, of a map or of finer blocks: see DepthMap.
uniform sampler2D finer;
uniform int side; // of the block, texels

void main() {
    ivec2 corner = ivec2(gl_FragCoord.xy) * side, last = textureSize(finer, 0) - 1;
    float least = 1.0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            least = min(least, texelFetch(finer, min(corner + ivec2(x, y), last), 0).r);
    gl_FragColor = vec4(least);
}
