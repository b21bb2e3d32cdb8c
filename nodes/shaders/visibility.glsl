// What share of the light reaches a place, for programs of one's own: see ShadowMapTechnique::setProgramUnit().
uniform int gnomon_maps; // how many there are; 0: all of the light arrives
uniform mat4 gnomon_mapFromEye[12];
uniform vec4 gnomon_mapPlace[12]; // in the texture: corner, and texels on a side; share of it that is border
uniform vec4 gnomon_mapNear[12], gnomon_mapFar[12]; // see map.frag; of the second w is 1 if depths must be within the map's

vec3 gnomon_placeIn(int map, vec3 eye, out bool before) {
    vec4 at = gnomon_mapFromEye[map] * vec4(eye, 1.0);
    before = at.w > 0.0;
    return at.xyz / at.w;
}

// `eye`: in eye coordinates, interpolated, for its change from pixel to pixel is how the surface lies. Call it from all pixels
// of a drawable, not under a condition.
float gnomon_visibility(vec3 eye) {
    vec3 right = eye + dFdx(eye), above = eye + dFdy(eye);
    for (int i = 0; i < gnomon_maps; ++i) {
        bool before, rightBefore, aboveBefore;
        vec3 at = gnomon_placeIn(i, eye, before);
        vec4 place = gnomon_mapPlace[i];
        if (!before || any(lessThan(at.xy, place.ww)) || any(greaterThan(at.xy, 1.0 - place.ww))) continue;
        if (gnomon_mapFar[i].w > 0.5 && !(at.z >= 0.0 && at.z <= 1.0)) continue;
        vec3 dx = gnomon_placeIn(i, right, rightBefore) - at, dy = gnomon_placeIn(i, above, aboveBefore) - at;
        vec2 slope = vec2(dx.z * dy.y - dy.z * dx.y, dx.x * dy.z - dy.x * dx.z) / ((dx.x * dy.y - dy.x * dx.y) * place.z);
        vec4 error = mix(gnomon_mapNear[i], gnomon_mapFar[i], clamp(at.z, 0.0, 1.0));
        float steepness = abs(slope.x) + abs(slope.y);
        if (!(steepness <= error.z && rightBefore && aboveBefore)) { // edge-on
            slope = vec2(0.0);
            steepness = error.z;
        }
        return lit(place.xy + at.xy * place.z, min(at.z, 1.0) - (0.5 + error.y) * steepness - error.x, slope, true);
    }
    return 1.0;
}
