// How the surface lies that is seen in a pixel, by the depths about it: lieOf(). Behind map_place.frag.

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
    vec2 steeper; // the larger of the two, where this is no rim or ends in an edge towards the eye; elsewhere as `change`
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
// In one loop for llvmpipe, see mapOf(): its first round does step 1, later ones 2 and 3, all of them 4. steepest: see MapErrors, of
// a map whose side is 1.
Lie lieOf(float e, ivec2 here, Axes axes, float steepest) {
    const float most = 64.0, enough = 16.0;           // pixels: the farthest are so far off; what is known over so many is known
    const float grazing = 3.5, faces = 2.0 * grazing; // times the steepest: tangents of 10 and 20 degrees
    bvec2 isSecond = equal(here & 1, ivec2(1));       // of its quad
    bool isX = abs(axes.z.x) > abs(axes.z.y);         // along the axis that leads nearer to the light
    float away = isX ? axes.z.x : axes.z.y;           // how far the way from the light leads along that axis
    float ahead = away > 0.0 ? -1.0 : 1.0;            // the side on which it leads to the light
    float snaps = min(depthError.y, 0.125);           // share of a change: places are off by so much of a pixel
    float doubt = depthError.x * (abs(axes.z.x) + abs(axes.z.y)); // how far nearerAlong().z may be off, by a change over a pixel

    // Known of both sides so far, along x and y: change of e a pixel, and over how many pixels that was seen.
    vec2 after, before, afterOver = vec2(1.0), beforeOver = vec2(1.0);
    // Of the pixel itself: axes x and y of its surface, see nearerAlong(); by how much it faces the light without the change along
    // the axis isX; how much it does where it counts as edge-on.
    vec2 tilt;
    float without = 0.0, edgeOn = 0.0;
    bool unclear = false; // whether it is turned away or faces the light
    bool ofSmooth = false; // it may be a smooth body, by all that was seen
    // On the way ahead: mean change from here to the pixel that was seen last; how often, and by how much, what lies before that
    // faces the light.
    float mean = 0.0, litSeen = 0.0, facedBy = -1e37;

    float pixelsOff = 1.0, side = 1.0; // how far off the pixel is that is looked at, and whether after this one or before it
    ivec2 way = reach * (2 * ivec2(isSecond) - 1);
#ifdef ODD
    ivec2 back = -way;
    vec2 inQuad = changeOver(back, e, here);
#else
    vec2 inQuad = vec2(dFdx(e), dFdy(e));
#endif
    Lie lie;
    bool goesFarther;
    do {
        vec2 change = changeOver(way, e, here);
        if (pixelsOff == 1.0) {
            // 1. The two pixels beside it, one of them in its quad: the smaller change is taken for its own.
            after = mix(inQuad, change, isSecond);
            before = mix(change, inQuad, isSecond);
            bvec2 isAfter = lessThan(abs(after), abs(before));
            vec2 least = mix(before, after, isAfter), larger = mix(after, before, isAfter);
            lie.change = least;
            lie.isAtRim = any(greaterThan(abs(after - before), 0.75 * abs(larger) + 4.0 * depthError.x));
            lie.steeper = lie.isAtRim ? mix(least, larger, lessThan(after, before)) : larger;
            vec3 nearer = nearerAlong(axes, least);
            vec2 other = axes.z.xy * (larger - least);
            lie.turned = nearer.z - max(other.x, 0.0) - max(other.y, 0.0) > doubt;
            lie.facing = nearer.z - min(other.x, 0.0) - min(other.y, 0.0) < -doubt;
            unclear = !lie.turned && !lie.facing;
            tilt = nearer.xy;
            edgeOn = (abs(nearer.x) + abs(nearer.y)) / steepest;
            ofSmooth = !lie.facing && nearer.z < grazing * edgeOn;
            without = nearer.z + away * (isX ? least.x : least.y);
            mean = isX ? (ahead > 0.0 ? after.x : before.x) : (ahead > 0.0 ? after.y : before.y);
        } else {
            // 2. A pixel farther off: where the change to it agrees with what is known of its side, over half as many pixels, the
            //    surface goes on there, and is known better.
            bvec2 isAfter = greaterThan(way, ivec2(0));
            vec2 next = mix(before, after, isAfter), nextOver = mix(beforeOver, afterOver, isAfter);
            vec2 off = abs(change - next) * pixelsOff - snaps * abs(next);
            bvec2 isNext = equal(nextOver, vec2(0.5 * pixelsOff));
            bvec2 goesOn = bvec2(off.x <= depthError.x && isNext.x, off.y <= depthError.x && isNext.y);
            next = mix(next, change, goesOn);
            nextOver = mix(nextOver, vec2(pixelsOff), goesOn);
            after = mix(after, next, isAfter);
            before = mix(next, before, isAfter);
            afterOver = mix(afterOver, nextOver, isAfter);
            beforeOver = mix(nextOver, beforeOver, isAfter);
            if ((isX ? way.x : way.y) * int(ahead) > 0) {
                // 3. On the way ahead: the outer half of it may face the light, as a smooth body's surface does that bends little
                //    and lies about the light as it does here.
                float latest = isX ? change.x : change.y;
                float outer = 2.0 * latest - mean, towards = away * outer - without; // by so much the outer half faces the light
                mean = latest;
                ofSmooth = ofSmooth && abs(towards) < faces * edgeOn && towards > facedBy - 4.0 * doubt / pixelsOff;
                if (towards > 2.0 * doubt / pixelsOff) {
                    litSeen += 1.0;
                    facedBy = towards;
                    float across = changeAcross(here + (isX ? ivec2(way.x, 0) : ivec2(0, way.y)), isX);
                    vec2 doubtThere = depthError.x * (isX ? vec2(abs(axes.x.y), abs(axes.y.y)) : vec2(abs(axes.x.x), abs(axes.y.x)));
                    vec3 there = nearerAlong(axes, isX ? vec2(outer, across) : vec2(across, outer));
                    ofSmooth = ofSmooth && areAlike(tilt, there.xy, 2.0 * doubtThere);
                }
            }
        }
        // 4. On to the other side, if both may tell; else twice as far off, while that may tell more.
        if (pixelsOff > 1.0 && unclear && side > 0.0) {
            side = -1.0;
        } else {
            vec2 likely = mix(after, before, lessThan(afterOver, beforeOver));
            bool goesOn = any(equal(vec4(afterOver, beforeOver), vec4(pixelsOff)));
            bool near = pixelsOff < 2.0 || abs(axes.z.z - dot(likely, axes.z.xy)) * pixelsOff < 2.0 * doubt;
            goesFarther = (unclear && goesOn && near && pixelsOff < most) || (ofSmooth && litSeen < 1.5 && pixelsOff < most);
            pixelsOff *= 2.0;
            side = unclear ? 1.0 : ahead;
        }
        way = ivec2(float(reach) * side * pixelsOff);
    } while (goesFarther);
    // 5. What was unclear is decided by the side on which its surface goes on farther, unless both do and differ.
    if (unclear) {
        bvec2 same = equal(afterOver, beforeOver);
        vec2 apart = abs(after - before) * afterOver - snaps * (abs(after) + abs(before));
        bool known = !any(bvec2(same.x && apart.x > 2.0 * depthError.x, same.y && apart.y > 2.0 * depthError.x));
        if (known) lie.change = mix(mix(after, before, lessThan(afterOver, beforeOver)), 0.5 * (after + before), same);
        float turnedBy = axes.z.z - dot(lie.change, axes.z.xy);
        lie.turned = known && turnedBy > doubt / enough;
        lie.facing = known && !lie.turned;
    }
    // 6. Of a smooth body the map decides.
    lie.turned = lie.turned && !(ofSmooth && litSeen > 1.5);
    return lie;
}
