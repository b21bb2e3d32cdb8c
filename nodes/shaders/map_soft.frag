// What share of the light passes about a place of a map, for SOFT edges. PENUMBRA, if that goes by how far off what blocks the
// light is. Behind map_filter.frag.
//
// discs(i): radii of the disc that is averaged, texels: at depth 0: x, y; at depth 1: x, y.
// penumbra(i): half of it, texels, for each unit of depth between what blocks the light and the surface.

// Places spread evenly over a disc: the golden angle from one to the next. Source: H. Vogel, "A better way to construct
// the sunflower head", Mathematical Biosciences 44, 1979.
const mat2 golden = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);

float litDisc(int i, vec2 p, float depth, vec2 slope, vec2 radius) {
    const float fewest = 8.0, most = 32.0, aTexel = 4.0; // taps, as many as keep holes between them small
    float taps = floor(clamp(aTexel * max(radius.x, radius.y), fewest, most));
    vec2 way = vec2(1.0, 0.0);
    float sum = 0.0;
    for (float tap = 0.5; tap < taps; tap += 1.0) {
        vec2 at = withinTile(p + sqrt(tap / taps) * radius * way, i);
        sum += texture(maps, vec3(at * texel, depth + dot(slope, at - p)));
        way = golden * way;
    }
    return sum / taps;
}

#ifdef PENUMBRA
uniform sampler2D depths;     // of the maps
uniform sampler2D blocks;     // the least of them: see DepthMap

const float finest = 8.0, coarsest = 256.0; // sides of blocks, texels
const float widest = coarsest / 2.0;        // radius that is averaged

// No more than the least depth within a radius, up to `widest`, of p.
float leastAbout(vec2 p, float radius) {
    float level = clamp(ceil(log2(2.0 * radius / finest)), 0.0, log2(coarsest / finest)); // two blocks hold a diameter
    ivec2 last = textureSize(blocks, int(level)) - 1, low = ivec2(floor((p - radius) / (finest * exp2(level))));
    ivec2 high = clamp(low + 1, ivec2(0), last);
    low = clamp(low, ivec2(0), last);
    return min(min(texelFetch(blocks, low, int(level)).r, texelFetch(blocks, ivec2(high.x, low.y), int(level)).r),
               min(texelFetch(blocks, ivec2(low.x, high.y), int(level)).r, texelFetch(blocks, high, int(level)).r));
}

// How far off what blocks part of the light can be, in depth; not more than 0 if there is nothing.
float mostBetween(int i, vec2 p, float depth) {
    float wider = max(penumbra(i).x, penumbra(i).y), far = min(depth, widest / wider);
    for (int step = 0; step < 2; ++step) far = min(far, depth - leastAbout(p, wider * far));
    return far;
}

// Mean depth between the surface and what blocks part of the light there; 0 if nothing does, or nothing that makes edges
// wider than the filter.
float between(int i, vec2 p, float depth, vec2 slope) {
    const float most = 16.0;
    float far = mostBetween(i, p, depth), reach = far * max(penumbra(i).x, penumbra(i).y);
    float taps = reach > 1.0 ? most : 0.0; // else the filter is as wide, whatever there is
    float aTexel = 1.0 / min(penumbra(i).x, penumbra(i).y), sum = 0.0, found = 0.0;
    vec2 way = vec2(1.0, 0.0);
    for (float tap = 0.5; tap < taps; tap += 1.0) {
        float off = far * sqrt(tap / most);
        vec2 at = withinTile(p + off * penumbra(i) * way, i);
        float stands = texture(depths, at * texel).r;
        float here = float(stands < depth + dot(slope, at - p) && off <= depth - stands + aTexel);
        found += here;
        sum += here * (depth - stands);
        way = golden * way;
    }
    return sum / max(found, 1.0);
}
#endif

// Radius, texels, of the disc that is averaged about a place of map i, whatever blocks the light.
vec2 discAt(int i, float depth) { return mix(discs(i).xy, discs(i).zw, depth); }

// The same at most, of a disc or a penumbra.
vec2 mostSpread(int i, float depth) {
    vec2 radius = discAt(i, depth);
#ifdef PENUMBRA
    radius = max(radius, penumbra(i) * depth);
#endif
    return radius;
}

float litSoftly(int i, vec2 p, float depth, vec2 slope) {
    vec2 radius = discAt(i, depth);
#ifdef PENUMBRA
    radius = max(radius, penumbra(i) * max(between(i, p, depth, slope), 0.0));
#endif
    bool wide = max(radius.x, radius.y) > 1.0; // than the filter
    float share = lit(p, depth, slope, !wide);
    return wide ? litDisc(i, p, depth, slope, radius) : share;
}
