// What a spot lights, as map.frag has pixels' places.
#ifdef CONE
#ifdef SURROUND
uniform mat4 coneFromPixel; // see coneFromScene()
#endif

bool isInCone(vec4 pixel) {
    vec3 at = (coneFromPixel * pixel).xyz;
    return at.z >= 0.0 && dot(at.xy, at.xy) <= at.z * at.z;
}
#endif

#ifdef SURROUND
uniform sampler2D seen; // as map_place.frag has them
uniform vec2 rows;
uniform vec4 depthError;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    float e = 1.0 - texelFetch(seen, ivec2(here.x, int(rows.x + rows.y * float(here.y))), 0).r;
    if (e <= 0.0 || isInCone(vec4(gl_FragCoord.xy + depthError.zw, e, 1.0))) discard;
    gl_FragColor = vec4(0.0);
}
#endif
