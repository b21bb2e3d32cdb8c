// Where a pixel is in a light's maps. The first of the texts that MapPrograms.cpp joins: it knows of no other.
//
// A pixel's place is (x, y, e, 1), x and y in window coordinates, e = 1 - depth: of what is far, where floats are fine.
// MAPS is how many there are, beside one another in one texture; CASCADES, if the finer of them hold part of what is seen
// only.

uniform sampler2D seen;       // depths of the frame

// What is the same for all pixels: SHARED vectors, PLACING of them for each map, then EACH for each map. The first FLATS come
// from the vertices: see quad.vert. Names of single ones, as depthError and place(i), are defined before this text, in the order in
// which MapLookup::constantsOf() gives their values.
uniform vec4 constants[CONSTANTS];
#if FLATS > 0
flat in vec4 constant[FLATS];
#endif
#if FLATS >= SHARED
#define ofAll(k) constant[k]
#else
#define ofAll(k) constants[k]
#endif
#if FLATS >= SHARED + PLACING * MAPS
#define placing(i, k) constant[SHARED + PLACING * (i) + k]
#else
#define placing(i, k) constants[SHARED + PLACING * (i) + k]
#endif
#define firstOfMap(i) (SHARED + PLACING * MAPS + EACH * (i))
#if FLATS == CONSTANTS && MAPS == 1
#define ofMap(i, k) constant[firstOfMap(0) + k]
#elif FLATS == CONSTANTS && MAPS == 2
#define ofMap(i, k) ((i) == 0 ? constant[firstOfMap(0) + k] : constant[firstOfMap(1) + k])
#else
#define ofMap(i, k) constants[firstOfMap(i) + k]
#endif
// depthError: of the frame: in depth, in pixels; of the sample's place in its pixel: x, y. wanted: see map.frag. seenPixels: first and
// last pixel that `seen` holds: x, y; x, y. drawnError: how far off a surface may be drawn, in depth, divided by w: x + e y; in
// pixels to z times that. coneFromPixel: see cone.frag.
#define texel texelAndRows.xy // of the texture, whose sides are 1
#define rows texelAndRows.zw  // of `seen`: see FrameDepths
#define border drawnError.w   // share of a map's side
#define mapFromPixel(i) mat4(placing(i, 0), placing(i, 1), placing(i, 2), placing(i, 3))
// The same of a map that differs from pixel to pixel: a varying of such an index is slower than a uniform.
#if MAPS == 1
#define mapFromPixelOf(i) mapFromPixel(0)
#define mapFromPixelZ(i) placing(0, 2)
#else
mat4 matrixAt(int first) { return mat4(constants[first], constants[first + 1], constants[first + 2], constants[first + 3]); }
#define mapFromPixelOf(i) matrixAt(SHARED + PLACING * (i))
#define mapFromPixelZ(i) constants[SHARED + PLACING * (i) + 2]
#endif
// place(i): in the texture: corner, and texels on a side. pixelFromMapX, Y, Z(i): columns of the inverse of mapFromPixel.
// nearestError(i), farthestError(i): x, y, z: see MapErrors. discs(i): see map_soft.frag.
#define penumbra(i) vec2(nearestError(i).w, farthestError(i).w) // the same

float seenDepth(ivec2 here) { return texelFetch(seen, ivec2(here.x, int(rows.x + rows.y * float(here.y))), 0).r; }

// False if map i does not answer for the pixel. Sides and depths of a map are 0 ... w.
bool holds(int i, vec4 pixel, out vec4 inMap) {
    inMap = mapFromPixel(i) * pixel;
    vec2 low = vec2(border * inMap.w);
    bool beside = any(lessThan(inMap.xy, low)) || any(greaterThan(inMap.xy, inMap.w - low));
#ifdef CASCADES
    beside = beside || !(inMap.z >= 0.0 && inMap.z <= inMap.w);
#endif
    return inMap.w > 0.0 && !beside;
}

// A place of the texture that a comparison may be made at for map i.
vec2 withinTile(vec2 p, int i) { return clamp(p, place(i).xy + 0.5, place(i).xy + place(i).z - 0.5); }
