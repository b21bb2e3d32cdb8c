// Where an edge of a shadow cuts a pixel: the share of the pixel that is beyond it, or if the pixel is marked, on this side. In the
// channel of the side that is beyond: left, right, below, above. Of several edges on a side the one counts that leaves more in the
// shadow: 0 where there is none.
//
// An edge is where a side of a volume meets the surface that is seen: both are planes on the screen. LINES: where a line is, drawn
// wider than it is. There is none where that surface, or the light, goes on. See MarkEdges.
uniform sampler2D seen;   // window depths
uniform vec2 rows;        // pixels of row y are in row rows.x + y rows.y
uniform float doubt;      // how far a depth may be off
uniform sampler2D marks;  // alpha: 0 where marked
uniform vec4 within;      // first and last pixel
in vec4 clip;             // place on the side, or on the line: as far along it as the pixel is
// By what part of its slope a surface may bend from one pixel to the next.
#ifdef LINES
uniform vec4 viewport; // corner and size
const float bend = 0.1; // it is a plane
#else
const float bend = 0.5;
#endif

bool isWithin(ivec2 at) {
    return all(greaterThanEqual(at, ivec2(within.xy))) && all(lessThanEqual(at, ivec2(within.zw)));
}

float depthAt(ivec2 at) { return texelFetch(seen, ivec2(at.x, int(rows.x + rows.y * float(at.y))), 0).r; }

bool isMarked(ivec2 at) { return texelFetch(marks, at, 0).a < 0.5; }

// Whether something stands there.
bool isSeen(ivec2 at) { return isWithin(at) && depthAt(at) < 1.0; }

// Change of depth to the next pixel along an axis: to that which is marked as this one is, or else of two that differ the smaller. The
// other may be of another surface: beyond a fold the light ends otherwise.
float changeAlong(ivec2 here, ivec2 axis, float depth, bool own) {
    bool seenAfter = isSeen(here + axis), seenBefore = isSeen(here - axis);
    float after = seenAfter ? depthAt(here + axis) - depth : 1.0;
    float before = seenBefore ? depth - depthAt(here - axis) : 1.0;
    bool isAfter = seenAfter && isMarked(here + axis) == own, isBefore = seenBefore && isMarked(here - axis) == own;
    bool takesAfter = isAfter == isBefore ? abs(after) < abs(before) : isAfter;
    float change = takesAfter ? after : before;
    return abs(change) < 1.0 ? change : 0.0;
}

// What share of a pixel is beyond a line so far from its middle.
float beyond(float off, vec2 towards) {
    vec2 way = abs(towards);
    float longer = max(way.x, way.y), shorter = min(way.x, way.y), left = 0.5 * (longer + shorter) - off;
    if (left <= 0.0) return 0.0;
    return left < shorter ? 0.5 * left * left / (longer * shorter) : 0.5 - off / longer;
}

const float onEdge = 1.0 / 32.0; // so near, pixels, the middle may be on either side of the edge

// From the pixel's middle to the edge, pixels.
#ifdef LINES
vec2 wayToEdge(float depth, vec2 surface) {
    vec2 at = viewport.xy + (0.5 + 0.5 * clip.xy / clip.w) * viewport.zw, x = dFdx(at), y = dFdy(at);
    vec2 along = dot(x, x) > dot(y, y) ? x : y, across = normalize(vec2(-along.y, along.x));
    return dot(at - gl_FragCoord.xy, across) * across;
}
#else
vec2 wayToEdge(float depth, vec2 surface) {
    float side = 0.5 + 0.5 * clip.z / clip.w;
    vec2 slope = vec2(dFdx(side), dFdy(side)) - surface; // of the side's depth before the surface's
    return (depth - side) * slope / max(dot(slope, slope), 1e-30);
}
#endif

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    float depth = depthAt(here);
    bool own = isMarked(here);
    vec2 surface = vec2(changeAlong(here, ivec2(1, 0), depth, own), changeAlong(here, ivec2(0, 1), depth, own));
    vec2 way = wayToEdge(depth, surface);
    float off = length(way);
    vec2 towards = off > 0.0 ? way / off : vec2(1.0, 0.0);
    // The pixel beyond the edge, which lies between both middles.
    vec2 over = abs(towards.x) > abs(towards.y) ? vec2(sign(towards.x), 0.0) : vec2(0.0, sign(towards.y));
    if (off < onEdge && isMarked(here + ivec2(over)) == own) over = -over;
    ivec2 other = here + ivec2(over), next = other + ivec2(over);
    float change = dot(surface, over), there = depthAt(other), most = doubt + bend * abs(change);
    bool goesOn = abs(there - depth - change) <= most && (!isWithin(next) || abs(depthAt(next) - there - change) <= most + most);
    bool isBetween = off <= abs(dot(towards, over));
    bool ends = isBetween && isWithin(other) && isMarked(other) != own && max(depth, there) < 1.0 && goesOn;
    float part = beyond(off, towards);
    vec4 channel = max(vec4(-over.x, over.x, -over.y, over.y), 0.0);
    gl_FragColor = ends ? channel * (own ? 1.0 - part : part) : vec4(0.0);
}
