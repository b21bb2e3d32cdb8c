// What share of a light reaches what is seen in a pixel, by its depth and the light's maps: see ShadowMapTechnique.
//
// For pixels' places see map_place.frag.

// What a comparison allows for of a slope, the change of depth a texel along either axis: the map has half of the larger one. Of
// 2 x 2 texels that are compared at once, which reach a texel, all must pass where a part of the light counts; half of them where
// edges are hard. Where texels are smaller than pixels a slope is known less well.
float allowance(vec2 slope) {
    float both = slope.x + slope.y;
#ifdef HALVES
    return 0.5 * both;
#elif defined(FINE)
    return 0.75 * both;
#else
    return both - 0.5 * max(slope.x, slope.y);
#endif
}

// wanted: pixels that less than this share reaches; 1, if alpha is to be what does not arrive, else 0; colour of a pixel that
//         nothing reaches; 1, if other pixels are between that and white. All others get an alpha of 1.

// INTERLACED: every other pixel along one axis, or both, is of another picture and has nothing to say here.
#ifdef INTERLACED
#define ODD
const int reach = 2; // to the next pixel
#else
const int reach = 1;
#endif

// From `here` to its neighbour in a direction, or, of that nothing is known, to the one on the other side.
ivec2 known(ivec2 here, ivec2 step) {
    ivec2 to = here + step;
    if (any(lessThan(to, ivec2(seenPixels.xy))) || any(greaterThan(to, ivec2(seenPixels.zw)))) to = here - step;
    return clamp(to, ivec2(seenPixels.xy), ivec2(seenPixels.zw));
}

float changeTo(ivec2 to, float e, ivec2 here) {
    ivec2 way = to - here;
    return (1.0 - seenDepth(to) - e) / float(way.x + way.y);
}

// Change of e a pixel along an axis, to the other pixel of the quad or, `beyond`, to that on its other side.
float changeIn(float e, ivec2 here, ivec2 axis, bool beyond) {
    ivec2 at = here * axis, way = reach * axis;
    return changeTo(known(here, (((at.x + at.y) & 1) == 0) != beyond ? way : -way), e, here);
}

float smaller(float a, float b) { return abs(a) < abs(b) ? a : b; }
float larger(float a, float b) { return abs(a) < abs(b) ? b : a; }

// Change of e a pixel on the steeper of two faces, where they meet in an edge towards the eye; elsewhere as changeOf().
vec2 steeper;

#ifdef SMOOTH
bool isAtRim = false; // of a surface: beside the pixel there is another, or this one bends
#endif

// Change of e a pixel, to both sides, as dFdx() and dFdy() have it where quads are whole. It is the smaller one: the other may
// lead to another surface. On an edge towards the eye the pixel may be on either face.
vec2 changeOf(float e, ivec2 here) {
#ifdef ODD
    vec2 change = vec2(changeIn(e, here, ivec2(1, 0), false), changeIn(e, here, ivec2(0, 1), false));
#else
    vec2 change = vec2(dFdx(e), dFdy(e));
#endif
    vec2 other = vec2(changeIn(e, here, ivec2(1, 0), true), changeIn(e, here, ivec2(0, 1), true));
#ifdef SMOOTH
    isAtRim = any(greaterThan(abs(change - other), 0.75 * max(abs(change), abs(other)) + 4.0 * depthError.x));
#endif
    bvec2 isSecond = equal(here & 1, ivec2(1)); // of its quad: the change to the other is that from the pixel before
    bvec2 isEdge = lessThan(mix(change - other, other - change, isSecond), vec2(0.0));
    vec2 most = vec2(larger(change.x, other.x), larger(change.y, other.y));
    change = vec2(smaller(change.x, other.x), smaller(change.y, other.y));
    steeper = mix(change, most, isEdge);
    return change;
}

#ifdef SMOOTH
mat2 sides = mat2(1.0); // of the pixel, in texels of its map

// The same of map i, on a surface on which e changes so; where they are more than four times those on one that faces the eye,
// no longer than these: there other pixels of the quad are often of another surface.
mat2 sidesIn(int i, vec4 at, vec2 change) {
    mat4 toMap = mapFromPixelOf(i);
    vec2 inMap = at.xy / at.w;
    vec2 x = toMap[0].xy - inMap * toMap[0].w, y = toMap[1].xy - inMap * toMap[1].w;
    vec2 deeper = toMap[2].xy - inMap * toMap[2].w;
    mat2 along = mat2(x + change.x * deeper, y + change.y * deeper);
    float facing = max(dot(x, x), dot(y, y)), longest = max(dot(along[0], along[0]), dot(along[1], along[1]));
    float part = longest > 16.0 * facing ? sqrt(facing / longest) : 1.0;
    return along * (part * place(i).z / at.w);
}
#endif

// The first that holds the pixel; MAPS, if none does. Found by itself, for llvmpipe runs the rest of a loop's body, and both
// sides of a condition, for pixels that have no part in them, too.
int mapOf(vec4 pixel, out vec4 inMap) {
    int found = holds(MAPS - 1, pixel, inMap) ? MAPS - 1 : MAPS;
    for (int i = MAPS - 2; i >= 0; --i) {
        vec4 at;
        if (!holds(i, pixel, at)) continue;
        found = i;
        inMap = at;
    }
    return found;
}

// How a map compares a pixel on a surface whose plane is given: see visibility().
struct Compared {
    vec2 place, slope; // in texels of the texture; change of depth a texel
    float depth;
};

// Gradient of a plane's function along a map's axes and its depth.
vec3 inMapOf(int i, vec4 plane) {
    return vec3(dot(plane, pixelFromMapX(i)), dot(plane, pixelFromMapY(i)), dot(plane, pixelFromMapZ(i)));
}

// at: see holds(). other: the plane of another face that the pixel may be on.
Compared compared(int i, vec4 at, vec4 plane, vec4 other, float drawn, float nearer) {
    vec3 inMap = at.xyz / at.w, change = inMapOf(i, plane), onOther = inMapOf(i, other);
    vec4 error = mix(nearestError(i), farthestError(i), clamp(inMap.z, 0.0, 1.0));
    float deeper = change.z, size = place(i).z;
    float least = (abs(change.x) + abs(change.y)) / (error.z * size); // of what is not edge-on, or pixels of two surfaces
    float along = max(abs(deeper), least);
    vec2 own = abs(change.xy) / (along * size), others = abs(onOther.xy) / (abs(onOther.z) * size);
    float steepness = own.x + own.y, allowed = allowance(own), otherwise = others.x + others.y;
    if (otherwise <= error.z) {
        steepness = max(steepness, otherwise);
        allowed = max(allowed, allowance(others));
    }
    float off = (drawn + (deeper > 0.0 ? 2.0 * nearer : 0.0)) / (along * at.w);
    float depth = min(inMap.z, 1.0) - allowed - error.y * steepness - error.x - off;
    vec2 slope = abs(deeper) >= least ? -change.xy / (deeper * size) : vec2(0.0);
    return Compared(place(i).xy + inMap.xy * place(i).z, slope, depth);
}

// Share of the light; outside all maps it is 1.
//
// drawn: how far off the plane may be, in e. Its place is left as it is, or edges would move; it is compared as if it were
// as much nearer to the light as that is, measured along the light.
// nearer: how much of e has been added. Of what faces away from the light that is farther from it, and taken back twice: a
// single sheet, seen from behind, does not shadow itself.
#ifndef SOFT
float visibility(vec4 pixel, vec4 plane, vec4 other, float drawn, float nearer) {
    vec4 at;
    int found = mapOf(pixel, at), i = min(found, MAPS - 1);
    Compared c = compared(i, at, plane, other, drawn, nearer);
#ifdef SMOOTH
    sides = sidesIn(i, at, -plane.xy);
#endif
#if defined(SMOOTH) && defined(BICUBIC)
    float share = litOverPixel(i, c.place, c.depth, c.slope, isAtRim ? mat2(0.0) : sides);
#else
    float share = lit(c.place, c.depth, c.slope, found < MAPS);
#endif
    return found < MAPS ? share : 1.0;
}
#else
#if MAPS > 2
uniform int mapCount; // MAPS, which a compiler must not know: llvmpipe unrolls the loop, and looks a pixel up in all of them
#else
const int mapCount = MAPS;
#endif

// Cascades are blended where one ends: `left` is the weight of those that are still to come.
float visibility(vec4 pixel, vec4 plane, vec4 other, float drawn, float nearer) {
    float share = 0.0, left = 1.0;
    for (int i = 0; i < mapCount; ++i) {
        vec4 at;
        if (!holds(i, pixel, at)) continue;
        Compared c = compared(i, at, plane, other, drawn, nearer);
        const float fade = 0.1, least = 0.001; // of a side; of a place that no map holds well
        float weight = left;
#if MAPS > 1
        vec2 inMap = at.xy / at.w, inside = min(inMap, 1.0 - inMap) - border - mostSpread(i, c.depth) / place(i).z;
        weight *= clamp(min(inside.x, inside.y) / fade, least, 1.0);
#endif
        share += weight * litSoftly(i, c.place, c.depth, c.slope);
        left -= weight;
        if (left <= least) return share / (1.0 - left);
    }
    return left < 1.0 ? share / (1.0 - left) : 1.0;
}
#endif

#ifdef SMOOTH
// Texels from one side of a pixel to the other, across an edge: `change` is that of what arrives, a pixel. Where nothing
// changes it is of a square pixel of the same area.
float texelsAcross(vec2 change) {
    vec2 inMap = vec2(sides[1].y * change.x - sides[0].y * change.y, sides[0].x * change.y - sides[1].x * change.x);
    float area = abs(sides[0].x * sides[1].y - sides[1].x * sides[0].y), turned = length(inMap);
    return turned > 0.0 ? area * length(change) / turned : sqrt(area);
}

// Share of a pixel that is on the lit side of an edge, which is where half of the light arrives, by the filter: where that makes
// it wider than a pixel it is made as wide.
float ofPixel(float arrives) {
    const float least = 1.0 / 64.0; // of a pixel that is no texels wide, too
#ifdef INTERLACED
    vec2 change = vec2(0.0);
#else
    vec2 change = vec2(dFdx(arrives), dFdy(arrives));
#endif
    float width = clamp(texelsAcross(change) / fewest, least, 1.0);
    return clamp(0.5 + (arrives - 0.5) / width, 0.0, 1.0);
}
#endif

// A function that is 0 on the plane through a place, on which e changes so; elsewhere e less the plane's.
vec4 planeAt(vec2 at, float e, vec2 slope) { return vec4(-slope, 1.0, dot(slope, at) - e); }

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    float e = 1.0 - seenDepth(here);
    vec2 slope = changeOf(e, here);
    // As much nearer to the eye as the depth may be wrong: between the eye and what it sees is nothing.
    float slopes = abs(slope.x) + abs(slope.y), drawn = max(drawnError.x + e * drawnError.y, 0.0);
    float off = depthError.x + depthError.y * slopes, nearer = e + off;
    vec2 at = gl_FragCoord.xy + depthError.zw;
    float arrives = visibility(vec4(at, nearer, 1.0), planeAt(at, nearer, slope), planeAt(at, nearer, steeper),
                               drawn * (1.0 + drawnError.z * slopes), off);
#ifdef SMOOTH
    arrives = ofPixel(arrives);
#endif
    bool unwanted = e <= 0.0 || arrives >= wanted.x; // e is 0 where nothing is seen
#ifdef CONE
    unwanted = unwanted || !isInCone(vec4(at, e, 1.0)); // a SpotMark's, or nobody's
#endif
    gl_FragColor = vec4(vec3(mix(wanted.z, 1.0, arrives * wanted.w)), unwanted ? 1.0 : mix(arrives, 1.0 - arrives, wanted.y));
}
