// What share of the light passes a place of a map, by the filter alone: see ShadowMapOptions::Filter. BICUBIC: 4 x 4 texels;
// HALVES, if it only matters whether more than half passes. Behind map_place.frag, or the defines of visibilityFunction(): `texel`.

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
