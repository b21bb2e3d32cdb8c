// Where a pixel is in a light's maps.
//
// A pixel's place is (x, y, e, 1), x and y in window coordinates, e = 1 - depth: of what is far, where floats are fine.
// MAPS is how many there are, beside one another in one texture; CASCADES, if the finer of them hold part of what is seen
// only.

uniform sampler2D seen;       // depths of the frame

// What is the same for all pixels: SHARED vectors, then EACH of them for each map; see quad.vert and MapLookupPass::setConstants().
#ifdef FLAT
flat in vec4 constant[CONSTANTS];
#else
uniform vec4 constants[CONSTANTS];
#define constant constants
#endif
mat4 matrixAt(int first) { return mat4(constant[first], constant[first + 1], constant[first + 2], constant[first + 3]); }
#define depthError constant[0]       // of the frame: in depth, in pixels; of the sample's place in its pixel: x, y
#define texel constant[1].xy         // of the texture, whose sides are 1
#define rows constant[1].zw           // of `seen`: see FrameDepthCopy
#define wanted constant[2]           // see map.frag
#define seenPixels constant[3]       // first and last pixel that `seen` holds: x, y; x, y
#define drawnError constant[4]       // how far off a surface may be drawn, in depth, divided by w: x + e y; in pixels to z times that
#define coneFromPixel matrixAt(5)    // see cone.frag
#define ofMap(i, k) constant[SHARED + EACH * (i) + k]
#define mapFromPixel(i) matrixAt(SHARED + EACH * (i))
#define place(i) ofMap(i, 4)         // in the texture: corner, and texels on a side; share of it that is border
#define pixelFromMapX(i) ofMap(i, 5) // columns of the inverse of mapFromPixel
#define pixelFromMapY(i) ofMap(i, 6)
#define pixelFromMapZ(i) ofMap(i, 7)
#define nearestError(i) ofMap(i, 8)  // x, y, z: see MapErrors
#define farthestError(i) ofMap(i, 9)
#define penumbra(i) vec2(nearestError(i).w, farthestError(i).w) // see map_filter.frag
#define discs(i) ofMap(i, 10)        // the same

float seenDepth(ivec2 here) { return texelFetch(seen, ivec2(here.x, int(rows.x + rows.y * float(here.y))), 0).r; }

// False if map i does not answer for the pixel. Sides and depths of a map are 0 ... 1.
bool holds(int i, vec4 pixel, out vec3 inMap) {
    vec4 at = mapFromPixel(i) * pixel;
    inMap = at.xyz / at.w;
    bool beside = any(lessThan(inMap.xy, place(i).ww)) || any(greaterThan(inMap.xy, 1.0 - place(i).ww));
#ifdef CASCADES
    beside = beside || !(inMap.z >= 0.0 && inMap.z <= 1.0);
#endif
    return at.w > 0.0 && !beside;
}
