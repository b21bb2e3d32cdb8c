// Where a pixel is in a light's maps.
//
// A pixel's place is (x, y, e, 1), x and y in window coordinates, e = 1 - depth: of what is far, where floats are fine.
// MAPS is how many there are, beside one another in one texture; CASCADES, if the finer of them hold part of what is seen
// only.

uniform sampler2D seen;       // depths of the frame
uniform vec4 depthError;      // of the frame: in depth, in pixels; of the sample's place in its pixel: x, y
uniform mat4 mapFromPixel[MAPS];
uniform vec4 place[MAPS];     // in the texture: corner, and texels on a side; share of it that is border

// False if map i does not answer for the pixel. Sides and depths of a map are 0 ... 1.
bool holds(int i, vec4 pixel, out vec3 inMap) {
    vec4 at = mapFromPixel[i] * pixel;
    inMap = at.xyz / at.w;
    bool beside = any(lessThan(inMap.xy, place[i].ww)) || any(greaterThan(inMap.xy, 1.0 - place[i].ww));
#ifdef CASCADES
    beside = beside || !(inMap.z >= 0.0 && inMap.z <= 1.0);
#endif
    return at.w > 0.0 && !beside;
}
