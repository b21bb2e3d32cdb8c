// What share of a light reaches what is seen in a pixel, by its depth and the light's maps: see ShadowMapTechnique. HALVES: it only
// matters whether that is more than half; SMOOTH: its mean over the pixel; SOFT: disc or penumbra; FINE: texels may be smaller than
// pixels; CONE: of a spot; INTERLACED, CASCADES, MAPS: see map_lie.frag and map_place.frag. MapPrograms.cpp defines them.
//
// The last of the texts that it joins: map_place.frag, cone.frag, map_filter.frag, map_soft.frag if SOFT, map_lie.frag, this.

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

#ifdef SMOOTH
const float fewest = 4.0 / 3.0; // texels that the mean over a pixel is of, each way
mat2 sides = mat2(1.0);         // of the pixel, in texels of its map

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

#ifdef BICUBIC
vec2 notLess(vec2 side) { return side * max(1.0, fewest * inversesqrt(max(dot(side, side), 1e-12))); }

// Mean over a pixel, whose sides are so many texels long, or over a few texels where that is more: SAMPLES comparisons of 2 x 2,
// 4 or 16, one in each of as many columns and rows. The square of the rows from one column to the next is -1 modulo SAMPLES + 1, so
// that a quarter turn leaves them where they are.
//
// Each is made on the plane of either face that is nearer to the light there, see Compared: faces that meet beside the pixel are both
// behind that, by less than a pixel, whichever of them it is on. On one plane the other face would be in its own shadow.
float litOverPixel(int i, vec2 p, float depth, vec2 slope, vec2 bent, mat2 sides) {
    mat2 grid = mat2(notLess(sides[0]), notLess(sides[1]));
    const float up = SAMPLES == 4.0 ? 2.0 : 4.0, middle = (SAMPLES + 1.0) / 2.0;
    float sum = 0.0;
    for (float column = 1.0; column <= SAMPLES; column += 1.0) {
        vec2 way = (vec2(column, mod(up * column, SAMPLES + 1.0)) - middle) / SAMPLES;
        vec2 at = withinTile(p + grid * way, i);
        sum += texture(maps, vec3(at * texel, depth + min(dot(slope, at - p), dot(bent, at - p))));
    }
    return sum / SAMPLES;
}
#endif
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

// By how much the depth may be wrong: a pixel is taken to be so much nearer to the eye, for between that and what it sees is nothing.
float depthOff(Lie lie) { return depthError.x + depthError.y * (abs(lie.change.x) + abs(lie.change.y)); }

// How a map compares a pixel on a surface whose plane is given: see visibility().
struct Compared {
    vec2 place, slope; // in texels of the texture; change of depth a texel
    vec2 bent;         // `slope` of the steeper of two faces that meet beside the pixel, see Lie::steeper
    float depth;       // that is compared
    vec3 inner;        // where the body of what is turned away is, if it has one: nearer to the light than this
};

// held, drawn: see holds(), visibility(). What is edge-on is compared beside it, where nothing of its own is.
Compared compared(int i, vec4 held, vec4 error, Axes axes, Lie lie, float drawn) {
    vec3 inMap = held.xyz / held.w, change = nearerAlong(axes, lie.change), onOther = nearerAlong(axes, lie.steeper);
    float deeper = change.z, size = place(i).z;
    float least = (abs(change.x) + abs(change.y)) / (error.z * size); // of what is not edge-on, or pixels of two surfaces
    float along = max(max(abs(deeper), least), 1e-37); // all 0 where no plane is known
    vec2 own = abs(change.xy) / (along * size), others = abs(onOther.xy) / (abs(onOther.z) * size);
    float steepness = own.x + own.y, allowed = allowance(own), otherwise = others.x + others.y;
    bool isBent = otherwise <= error.z;
    if (isBent) {
        steepness = max(steepness, otherwise);
        allowed = max(allowed, allowance(others));
    }
    float back = deeper > 0.0 ? 2.0 * depthOff(lie) : 0.0; // nearer to the eye, it is farther from the light
    float off = (drawn + back) / (along * held.w);
    float within = allowed + error.y * steepness + error.x + off, depth = min(inMap.z, 1.0);
    bool isEdgeOn = abs(deeper) < least;
    vec2 slope = isEdgeOn ? vec2(0.0) : -change.xy / (deeper * size);
    vec2 bent = isBent && !isEdgeOn ? -onOther.xy / (onOther.z * size) : slope;
    vec2 outwards = isEdgeOn && lie.facing ? change.xy / max(length(change.xy), 1e-37) : vec2(0.0);
    vec2 beside = outwards * (abs(outwards.x) + abs(outwards.y));
    // At the depth of the pixel itself: of a body with offsets, the surface there is farther from the light, see mark.vert.
    const float inwards = 2.0;
    vec2 at = place(i).xy + inMap.xy * place(i).z;
    vec3 inner = vec3(at - inwards * change.xy / max(length(change.xy), 1e-37), depth - error.x - off);
    return Compared(at + beside, slope, bent, depth - within, inner);
}

vec4 errorAt(int i, float depth) { return mix(nearestError(i), farthestError(i), clamp(depth, 0.0, 1.0)); }

// Whether what is turned away from the light is in a shadow: of what is nearer to the light, or of its own body, which may be thin
// here. A single sheet, seen from behind, has none, and is lit from there.
bool shadowsItself(bool turned, Compared c) {
    float outside = texture(maps, vec3(c.place * texel, c.depth));
#ifdef HALVES
    const float least = 0.5; // of four texels, as allowance() has it: own ones may fail
#else
    const float least = 1.0;
#endif
    return turned && (outside < least || texture(maps, vec3(c.inner.xy * texel, c.inner.z)) < 1.0);
}

// How far off the plane of a surface may be drawn, in e.
float drawnOff(float e, Lie lie) {
    float slopes = abs(lie.change.x) + abs(lie.change.y);
    return max(drawnError.x + e * drawnError.y, 0.0) * (1.0 + drawnError.z * slopes);
}

// Share of the light; outside all maps it is 1. A pixel's place is left as it is by what the plane may be off, or edges would move; it
// is compared as if it were as much nearer to the light as that is, measured along the light.
#ifndef SOFT
float visibility(float e, ivec2 here, vec2 at) {
    vec4 inMap;
    int found = mapOf(vec4(at, e, 1.0), inMap), i = min(found, MAPS - 1);
    vec4 error = errorAt(i, inMap.z / inMap.w);
    Axes axes = axesOf(i, vec3(at, e));
    Lie lie = lieOf(e, here, axes, error.z * place(i).z);
    inMap += depthOff(lie) * mapFromPixelZ(i);
    Compared c = compared(i, inMap, error, axes, lie, drawnOff(e, lie));
#ifdef SMOOTH
    sides = sidesIn(i, inMap, lie.change);
#endif
#if defined(SMOOTH) && defined(BICUBIC)
    float share = litOverPixel(i, c.place, c.depth, c.slope, c.bent, lie.isAtRim ? mat2(0.0) : sides);
#else
    float share = lit(c.place, c.depth, c.slope, found < MAPS);
#endif
    return found == MAPS ? 1.0 : shadowsItself(lie.turned, c) ? 0.0 : share;
}
#else
#if MAPS > 2
uniform int mapCount; // MAPS, which a compiler must not know: llvmpipe unrolls the loop, and looks a pixel up in all of them
#else
const int mapCount = MAPS;
#endif

// Cascades are blended where one ends: `left` is the weight of those that are still to come.
float visibility(float e, ivec2 here, vec2 at) {
    vec4 inMap;
    int first = min(mapOf(vec4(at, e, 1.0), inMap), MAPS - 1);
    Lie lie = lieOf(e, here, axesOf(first, vec3(at, e)), errorAt(first, inMap.z / inMap.w).z * place(first).z);
    vec4 pixel = vec4(at, e + depthOff(lie), 1.0);
    float share = 0.0, left = 1.0;
    for (int i = 0; i < mapCount; ++i) {
        if (!holds(i, pixel, inMap)) continue;
        Compared c = compared(i, inMap, errorAt(i, inMap.z / inMap.w), axesOf(i, vec3(at, e)), lie, drawnOff(e, lie));
        const float fade = 0.1, least = 0.001; // of a side; of a place that no map holds well
        float weight = left;
#if MAPS > 1
        vec2 in_ = inMap.xy / inMap.w, inside = min(in_, 1.0 - in_) - border - mostSpread(i, c.depth) / place(i).z;
        weight *= clamp(min(inside.x, inside.y) / fade, least, 1.0);
#endif
        share += shadowsItself(lie.turned, c) ? 0.0 : weight * litSoftly(i, c.place, c.depth, c.slope);
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

// wanted: pixels that less than this share reaches; colour of a pixel that nothing reaches; 1, if other pixels are between that
//         and white. All others get an alpha of 1.
void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    float e = 1.0 - seenDepth(here);
    vec2 at = gl_FragCoord.xy + depthError.zw;
    float arrives = visibility(e, here, at);
#ifdef SMOOTH
    arrives = ofPixel(arrives);
#endif
    bool unwanted = e <= 0.0 || arrives >= wanted.x; // e is 0 where nothing is seen
#ifdef CONE
    unwanted = unwanted || !isInCone(vec4(at, e, 1.0)); // a SpotMark's, or nobody's
#endif
    gl_FragColor = vec4(vec3(mix(wanted.y, 1.0, arrives * wanted.z)), unwanted ? 1.0 : arrives);
}
