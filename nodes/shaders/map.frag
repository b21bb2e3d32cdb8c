// What share of a light reaches what is seen in a pixel, by its depth and the light's maps: see ShadowMapTechnique.
//
// In what follows a pixel's place is (x, y, e, 1), x and y in window coordinates, e = 1 - depth: of what is far, where
// floats are fine. FILTER is NEAREST, BILINEAR or BICUBIC; MAPS is how many there are, beside one another in one texture;
// CASCADES, if the finer of them hold part of what is seen only.

uniform sampler2D seen;       // depths of the frame
uniform sampler2DShadow maps;
uniform vec2 texel;           // of the texture, whose sides are 1
uniform vec4 depthError;      // of the frame: in depth, in pixels; of the sample's place in its pixel: x, y

uniform mat4 mapFromPixel[MAPS];
uniform vec4 pixelFromMapX[MAPS], pixelFromMapY[MAPS], pixelFromMapZ[MAPS]; // columns of its inverse
uniform vec4 place[MAPS];     // in the texture: corner, and texels on a side; share of it that is border
uniform vec4 nearestError[MAPS], farthestError[MAPS]; // see MapErrors

#ifdef ODD
uniform vec4 seenPixels;      // first and last pixel that `seen` holds: x, y; x, y

// Change of e a pixel along an axis, as dFdx() and dFdy() have it, by the other pixel of its quad; by the one on the other
// side where that is beside the view, of which nothing is known.
float change(float e, ivec2 here, ivec2 axis) {
    ivec2 first = ivec2(seenPixels.xy), last = ivec2(seenPixels.zw), at = here * axis;
    ivec2 to = ((at.x + at.y) & 1) == 0 ? here + axis : here - axis;
    if (any(lessThan(to, first)) || any(greaterThan(to, last))) to = 2 * here - to;
    to = clamp(to, first, last);
    ivec2 way = to - here;
    return (1.0 - texelFetch(seen, to, 0).r - e) * float(way.x + way.y);
}
#endif

// At p, in texels of the texture; `slope` is the change of depth a texel on the surface that is compared.
float lit(vec2 p, float depth, vec2 slope) {
#ifdef BICUBIC
    // The cubic B-spline over 4 x 4 comparisons as four of 2 x 2. Source: C. Sigg and M. Hadwiger, "Fast Third-Order
    // Texture Filtering", GPU Gems 2, 2005.
    vec2 corner = floor(p - 0.5) + 0.5, f = p - corner, g = 1.0 - f;
    vec2 w0 = g * g * g / 6.0, w3 = f * f * f / 6.0;
    vec2 w1 = 2.0 / 3.0 - 0.5 * f * f * (2.0 - f);
    vec2 low = w0 + w1, high = 1.0 - low;
    vec2 a = corner - 1.0 + w1 / low, b = corner + 1.0 + w3 / high;
    vec2 atA = slope * (a - p), atB = slope * (b - p);
    a *= texel;
    b *= texel;
    return low.y * (low.x * texture(maps, vec3(a, depth + atA.x + atA.y))
                    + high.x * texture(maps, vec3(b.x, a.y, depth + atB.x + atA.y)))
         + high.y * (low.x * texture(maps, vec3(a.x, b.y, depth + atA.x + atB.y))
                     + high.x * texture(maps, vec3(b, depth + atB.x + atB.y)));
#else
    return texture(maps, vec3(p * texel, depth));
#endif
}

// Share of the light; outside all maps it is 1.
float visibility(vec4 pixel, vec4 plane) {
    for (int i = 0; i < MAPS; ++i) {
        vec4 at = mapFromPixel[i] * pixel;
        if (!(at.w > 0.0)) continue;
        at /= at.w;
        if (any(lessThan(at.xy, place[i].ww)) || any(greaterThan(at.xy, 1.0 - place[i].ww))) continue;
#ifdef CASCADES
        if (!(at.z >= 0.0 && at.z <= 1.0)) continue;
#endif
        vec2 across = vec2(dot(plane, pixelFromMapX[i]), dot(plane, pixelFromMapY[i]));
        vec2 slope = -across / (dot(plane, pixelFromMapZ[i]) * place[i].z);
        float steepness = abs(slope.x) + abs(slope.y);
        vec4 error = mix(nearestError[i], farthestError[i], clamp(at.z, 0.0, 1.0));
        if (!(steepness <= error.z)) { // edge-on, or pixels of two surfaces
            slope = vec2(0.0);
            steepness = error.z;
        }
        float depth = min(at.z, 1.0) - (KERNEL + error.y) * steepness - error.x;
        return lit(place[i].xy + at.xy * place[i].z, depth, slope);
    }
    return 1.0;
}

void main() {
    float e = 1.0 - texelFetch(seen, ivec2(gl_FragCoord.xy), 0).r;
#ifdef ODD
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec2 slope = vec2(change(e, here, ivec2(1, 0)), change(e, here, ivec2(0, 1)));
#else
    vec2 slope = vec2(dFdx(e), dFdy(e));
#endif
    if (e <= 0.0) discard; // nothing is seen
    // As much nearer to the eye as the depth may be wrong: between the eye and what it sees is nothing.
    float nearer = e + depthError.x + depthError.y * (abs(slope.x) + abs(slope.y));
    vec2 at = gl_FragCoord.xy + depthError.zw;
#ifdef CONE
    if (!isInCone(vec4(at, e, 1.0))) discard; // a ConeMark's, or nobody's
#endif
    float arrives = visibility(vec4(at, nearer, 1.0), vec4(-slope, 1.0, dot(slope, at) - nearer));
    if (arrives >= THRESHOLD) discard;
    gl_FragColor = vec4(0.0);
}
