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

// The way to a pixel so many on; where that is not in view, to one twice as many back, or else as many: as many back may be all that
// is known of the other side.
int wayInView(int at, int way, int low, int high) {
    int on = at + way, back = at - 2 * way;
    return on >= low && on <= high ? way : back >= low && back <= high ? -2 * way : -way;
}

// Change of e a pixel along both axes, to pixels so many away.
vec2 changeOver(inout ivec2 way, float e, ivec2 here) {
    ivec2 low = ivec2(seenPixels.xy), high = ivec2(seenPixels.zw);
    way = ivec2(wayInView(here.x, way.x, low.x, high.x), wayInView(here.y, way.y, low.y, high.y));
    ivec2 to = clamp(here + way, low, high);
    return (1.0 - e - vec2(seenDepth(ivec2(to.x, here.y)), seenDepth(ivec2(here.x, to.y)))) / vec2(way);
}

// The same at a pixel from one pixel to the next, across the axis x, or y.
float changeAcross(ivec2 at, bool isX) {
    ivec2 low = ivec2(seenPixels.xy), next = reach * (isX ? ivec2(0, at.y > low.y ? -1 : 1) : ivec2(at.x > low.x ? -1 : 1, 0));
    return (seenDepth(at) - seenDepth(at + next)) / float(next.x + next.y);
}

// Where a map's axes lead, about a pixel: along both axes of the picture, and in e.
struct Axes {
    vec3 x, y, z;
};

Axes axesOf(int i, vec3 at) {
    return Axes(pixelFromMapX(i).xyz - at * pixelFromMapX(i).w, pixelFromMapY(i).xyz - at * pixelFromMapY(i).w,
                pixelFromMapZ(i).xyz - at * pixelFromMapZ(i).w);
}

// How much nearer to the eye than a surface each of them leads, on which e changes so. Along z it leads away from the light: more
// than 0 if the surface is turned away from that.
vec3 nearerAlong(Axes axes, vec2 change) {
    return vec3(axes.x.z - dot(change, axes.x.xy), axes.y.z - dot(change, axes.y.xy), axes.z.z - dot(change, axes.z.xy));
}

// How the surface lies that is seen in a pixel.
struct Lie {
    vec2 change;  // of e a pixel; of two that differ the smaller, for the other may lead to another surface
    vec2 steeper; // the same on the steeper of two faces, where they meet in an edge towards the eye; elsewhere as `change`
    bool turned;  // away from the light
    bool facing;  // it, or along it: one of the two, unless that is not known
    bool isAtRim; // of a surface: beside the pixel there is another, or this one bends
};

// Whether two surfaces that lead so much nearer to the eye, see nearerAlong(), lie as one does about the light: to half a right angle.
// The second may be off by what `doubt` is along the map's axes.
bool areAlike(vec2 one, vec2 other, vec2 doubt) {
    float across = abs(one.x * other.y - one.y * other.x), off = dot(abs(one), doubt.yx) + dot(abs(one), doubt);
    return across <= dot(one, other) + off;
}

// It is turned away, or is not, by all that the changes to both sides may mean. Where these do not agree, for the light is in its
// plane or there are two surfaces, pixels farther and farther off on either side say which of them goes on there, and how it lies
// to a part of a step of depth.
//
// What is turned away by less than some ten degrees, and bends but little on the way to where it faces the light, is of a smooth
// body, whose facets are not its shape: its map decides. Another surface behind its rim may seem to go on so; but that lies otherwise
// about the light, as a ground does beside a wall.
//
// In one loop for llvmpipe: see mapOf(). steepest: see MapErrors, of a map whose side is 1.
Lie lieOf(float e, ivec2 here, Axes axes, float steepest) {
    const float most = 64.0, enough = 16.0;           // pixels: the farthest are so far off; what is known over so many is known
    const float grazing = 3.5, faces = 2.0 * grazing; // times the steepest: tangents of 10 and 20 degrees
    bvec2 isSecond = equal(here & 1, ivec2(1));       // of its quad
    bool isX = abs(axes.z.x) > abs(axes.z.y);         // along the axis that leads nearer to the light
    float away = isX ? axes.z.x : axes.z.y, ahead = away > 0.0 ? -1.0 : 1.0;
    float snaps = min(depthError.y, 0.125), doubt = depthError.x * (abs(axes.z.x) + abs(axes.z.y));
    float over = 1.0, side = 1.0, limit = 0.0, rest = 0.0, last = 0.0, facing = -1e37;
    vec2 about, after, before, afterOver = vec2(1.0), beforeOver = vec2(1.0);
    bool asked, unclear = false, smoothly = false;
    ivec2 way = reach * (2 * ivec2(isSecond) - 1);
#ifdef ODD
    ivec2 back = -way;
    vec2 inQuad = changeOver(back, e, here);
#else
    vec2 inQuad = vec2(dFdx(e), dFdy(e));
#endif
    Lie lie;
    float lit = 0.0;
    do {
        vec2 change = changeOver(way, e, here);
        if (over == 1.0) {
            after = mix(inQuad, change, isSecond);
            before = mix(change, inQuad, isSecond);
            bvec2 isAfter = lessThan(abs(after), abs(before));
            vec2 least = mix(before, after, isAfter), larger = mix(after, before, isAfter);
            lie.change = least;
            lie.steeper = mix(least, larger, lessThan(after, before));
#ifdef SMOOTH
            lie.isAtRim = any(greaterThan(abs(after - before), 0.75 * abs(larger) + 4.0 * depthError.x));
#endif
            vec3 nearer = nearerAlong(axes, least);
            vec2 other = axes.z.xy * (larger - least);
            lie.turned = nearer.z - max(other.x, 0.0) - max(other.y, 0.0) > doubt;
            lie.facing = nearer.z - min(other.x, 0.0) - min(other.y, 0.0) < -doubt;
            unclear = !lie.turned && !lie.facing;
            about = nearer.xy;
            limit = (abs(nearer.x) + abs(nearer.y)) / steepest;
            smoothly = !lie.facing && nearer.z < grazing * limit;
            rest = nearer.z + away * (isX ? least.x : least.y);
            last = isX ? (ahead > 0.0 ? after.x : before.x) : (ahead > 0.0 ? after.y : before.y);
        } else {
            bvec2 isAfter = greaterThan(way, ivec2(0));
            vec2 next = mix(before, after, isAfter), nextOver = mix(beforeOver, afterOver, isAfter);
            vec2 off = abs(change - next) * over - snaps * abs(next);
            bvec2 isNext = equal(nextOver, vec2(0.5 * over));
            bvec2 goesOn = bvec2(off.x <= depthError.x && isNext.x, off.y <= depthError.x && isNext.y);
            next = mix(next, change, goesOn);
            nextOver = mix(nextOver, vec2(over), goesOn);
            after = mix(after, next, isAfter);
            before = mix(next, before, isAfter);
            afterOver = mix(afterOver, nextOver, isAfter);
            beforeOver = mix(nextOver, beforeOver, isAfter);
            if ((isX ? way.x : way.y) * int(ahead) > 0) {
                float mean = isX ? change.x : change.y;
                float outer = 2.0 * mean - last, towards = away * outer - rest; // by so much the outer half faces the light
                last = mean;
                smoothly = smoothly && abs(towards) < faces * limit && towards > facing - 4.0 * doubt / over;
                if (towards > 2.0 * doubt / over) {
                    lit += 1.0;
                    facing = towards;
                    float across = changeAcross(here + (isX ? ivec2(way.x, 0) : ivec2(0, way.y)), isX);
                    vec2 off = depthError.x * (isX ? vec2(abs(axes.x.y), abs(axes.y.y)) : vec2(abs(axes.x.x), abs(axes.y.x)));
                    vec3 there = nearerAlong(axes, isX ? vec2(outer, across) : vec2(across, outer));
                    smoothly = smoothly && areAlike(about, there.xy, 2.0 * off);
                }
            }
        }
        if (over > 1.0 && unclear && side > 0.0) {
            side = -1.0;
        } else {
            vec2 likely = mix(after, before, lessThan(afterOver, beforeOver));
            bool goesOn = any(equal(vec4(afterOver, beforeOver), vec4(over)));
            bool near = over < 2.0 || abs(axes.z.z - dot(likely, axes.z.xy)) * over < 2.0 * doubt;
            asked = (unclear && goesOn && near && over < most) || (smoothly && lit < 1.5 && over < most);
            over *= 2.0;
            side = unclear ? 1.0 : ahead;
        }
        way = ivec2(float(reach) * side * over);
    } while (asked);
    if (unclear) {
        bvec2 same = equal(afterOver, beforeOver);
        vec2 apart = abs(after - before) * afterOver - snaps * (abs(after) + abs(before));
        bool known = !any(bvec2(same.x && apart.x > 2.0 * depthError.x, same.y && apart.y > 2.0 * depthError.x));
        if (known) lie.change = mix(mix(after, before, lessThan(afterOver, beforeOver)), 0.5 * (after + before), same);
        float away = axes.z.z - dot(lie.change, axes.z.xy);
        lie.turned = known && away > doubt / enough;
        lie.facing = known && !lie.turned;
    }
    lie.turned = lie.turned && !(smoothly && lit > 1.5);
    return lie;
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

// By how much the depth may be wrong: a pixel is taken to be so much nearer to the eye, for between that and what it sees is nothing.
float depthOff(Lie lie) { return depthError.x + depthError.y * (abs(lie.change.x) + abs(lie.change.y)); }

// How a map compares a pixel on a surface whose plane is given: see visibility().
struct Compared {
    vec2 place, slope; // in texels of the texture; change of depth a texel
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
    if (otherwise <= error.z) {
        steepness = max(steepness, otherwise);
        allowed = max(allowed, allowance(others));
    }
    float back = deeper > 0.0 ? 2.0 * depthOff(lie) : 0.0; // nearer to the eye, it is farther from the light
    float off = (drawn + back) / (along * held.w);
    float within = allowed + error.y * steepness + error.x + off, depth = min(inMap.z, 1.0);
    bool isEdgeOn = abs(deeper) < least;
    vec2 slope = isEdgeOn ? vec2(0.0) : -change.xy / (deeper * size);
    vec2 outwards = isEdgeOn && lie.facing ? change.xy / max(length(change.xy), 1e-37) : vec2(0.0);
    vec2 beside = outwards * (abs(outwards.x) + abs(outwards.y));
    // Its plane goes deeper there, and by a texel less where four are compared.
    const float inwards = 2.0, spare = 0.5 * (inwards - 1.0);
    vec2 at = place(i).xy + inMap.xy * place(i).z;
    vec3 inner = vec3(at - inwards * change.xy / max(length(change.xy), 1e-37), depth + spare * length(own) - error.x - off);
    return Compared(at + beside, slope, depth - within, inner);
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
    float share = litOverPixel(i, c.place, c.depth, c.slope, lie.isAtRim ? mat2(0.0) : sides);
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
    gl_FragColor = vec4(vec3(mix(wanted.z, 1.0, arrives * wanted.w)), unwanted ? 1.0 : mix(arrives, 1.0 - arrives, wanted.y));
}
