// What share of the light passes a place of a map: see ShadowMapTechnique. BICUBIC: 4 x 4 texels instead of one or 2 x 2; HALVES, if it only matters whether that is more than half; SMOOTH, if pixels ask for their
// mean; SOFT, if what is wider than the filter counts; PENUMBRA, if that goes by how far away what blocks the light is.

uniform sampler2DShadow maps;

// At p, in texels of the texture; `slope` is the change of depth a texel on the surface that is compared.
#ifdef BICUBIC
// The cubic B-spline over 4 x 4 comparisons as four of 2 x 2. Source: C. Sigg and M. Hadwiger, "Fast Third-Order Texture
// Filtering", GPU Gems 2, 2005.
struct Spline {
    vec2 a, b;      // from p to the comparisons: to the lower and to the upper
    vec2 low, high; // weights
};

Spline splineAt(vec2 p) {
    vec2 f = fract(p - 0.5), g = 1.0 - f;
    vec2 w0 = g * g * g / 6.0, w3 = f * f * f / 6.0;
    vec2 w1 = 2.0 / 3.0 - 0.5 * f * f * (2.0 - f);
    vec2 low = w0 + w1, high = 1.0 - low;
    return Spline(w1 / low - 1.0 - f, w3 / high + 1.0 - f, low, high);
}

// Anything where it is not asked for. A loop ends early where no pixel asks, if it looks at its end; of a condition both sides
// may be run.
float lit(vec2 p, float depth, vec2 slope, bool asked) {
    Spline spline = splineAt(p);
    float share = 0.0, tap = 0.0;
#ifdef HALVES
    // The inner 2 x 2 have more than half of the B-spline's weight everywhere, 0.69 at least: where they agree, they decide.
    float inner = 0.0;
    tap = -1.0;
#endif
    do {
        bool right = tap == 1.0 || tap == 3.0, upper = tap > 1.5;
        vec2 to = vec2(right ? spline.b.x : spline.a.x, upper ? spline.b.y : spline.a.y);
        float weight = (right ? spline.high.x : spline.low.x) * (upper ? spline.high.y : spline.low.y);
#ifdef HALVES
        if (tap < 0.0) to = vec2(0.0);
#endif
        float passes = texture(maps, vec3((p + to) * texel, depth + dot(slope, to)));
#ifdef HALVES
        if (tap < 0.0) {
            inner = passes;
            weight = 0.0;
            asked = asked && inner > 0.0 && inner < 1.0;
        }
#endif
        share += weight * passes;
        tap += 1.0;
    } while (asked && tap < 4.0);
#ifdef HALVES
    return asked ? share : inner;
#else
    return share;
#endif
}
#else
float lit(vec2 p, float depth, vec2 slope, bool asked) { return texture(maps, vec3(p * texel, depth)); }
#endif

#if defined(SMOOTH) || defined(SOFT)
vec2 withinTile(vec2 p, int i) { return clamp(p, place(i).xy + 0.5, place(i).xy + place(i).z - 0.5); }
#endif

#ifdef SMOOTH
const float fewest = 4.0 / 3.0; // texels that the mean is of, each way
#endif

#if defined(SMOOTH) && defined(BICUBIC)
vec2 notLess(vec2 side) { return side * max(1.0, fewest * inversesqrt(max(dot(side, side), 1e-12))); }

// Mean over a pixel, whose sides are so many texels long, or over a few texels where that is more: SAMPLES comparisons of 2 x 2,
// 4 or 16, one in each of as many columns and rows. The square of the rows from one column to the next is -1 modulo SAMPLES + 1, so
// that a quarter turn leaves them where they are.
float litOverPixel(int i, vec2 p, float depth, vec2 slope, mat2 sides) {
    mat2 grid = mat2(notLess(sides[0]), notLess(sides[1]));
    const float up = SAMPLES == 4.0 ? 2.0 : 4.0, middle = (SAMPLES + 1.0) / 2.0;
    float sum = 0.0;
    for (float column = 1.0; column <= SAMPLES; column += 1.0) {
        vec2 way = (vec2(column, mod(up * column, SAMPLES + 1.0)) - middle) / SAMPLES;
        vec2 at = withinTile(p + grid * way, i);
        sum += texture(maps, vec3(at * texel, depth + dot(slope, at - p)));
    }
    return sum / SAMPLES;
}
#endif

#ifdef SOFT
// discs: radii of the disc that is averaged, texels: at depth 0: x, y; at depth 1: x, y.

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
// penumbra: half of it, texels, for each unit of depth between what blocks the light and the surface.

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
#endif
