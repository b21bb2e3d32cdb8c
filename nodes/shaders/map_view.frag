// How a light's maps lie on what is seen, laid over the picture: see ShadowMapTechnique::setView().
#ifdef PICTURE
uniform sampler2D depths;     // of the maps
uniform vec4 frame;           // where on the screen: corner, sides; pixels

// Near is bright; where nothing stands, blue.
void main() {
    vec2 at = (gl_FragCoord.xy - frame.xy) / frame.zw;
    float depth = texture(depths, at).r;
    gl_FragColor = vec4(depth < 1.0 ? vec3(1.0 - 0.9 * depth) : vec3(0.1, 0.1, 0.3), 1.0);
}
#else
const vec3 red = vec3(0.9, 0.1, 0.1), yellow = vec3(0.9, 0.8, 0.1), green = vec3(0.1, 0.8, 0.2), blue = vec3(0.2, 0.3, 1.0),
           purple = vec3(0.7, 0.2, 0.9), cyan = vec3(0.1, 0.8, 0.9);

#ifdef TEXELS
// Of a texel so many pixels wide: blue to a quarter of one, green at one, red from eight.
vec3 tint(float pixels) {
    float step = log2(max(pixels, 0.01));
    vec3 fine = mix(blue, green, clamp(step / 2.0 + 1.0, 0.0, 1.0));
    vec3 coarse = mix(green, yellow, clamp(step / 1.5, 0.0, 1.0));
    return step < 0.0 ? fine : mix(coarse, red, clamp((step - 1.5) / 1.5, 0.0, 1.0));
}
#endif

void main() {
    float e = 1.0 - seenDepth(ivec2(gl_FragCoord.xy));
    vec4 pixel = vec4(gl_FragCoord.xy + depthError.zw, e, 1.0);
    int map = MAPS;
    vec2 texels = vec2(0.0);
    for (int i = MAPS - 1; i >= 0; --i) { // the first that holds it counts
        vec4 at;
        if (!holds(i, pixel, at)) continue;
        map = i;
        texels = at.xy / at.w * place(i).z;
    }
#ifdef TEXELS
    float pixels = 1.0 / min(length(dFdx(texels)), length(dFdy(texels)));
    bool even = mod(floor(texels.x) + floor(texels.y), 2.0) == 0.0;
    vec3 color = tint(pixels) * (even && pixels > 2.0 ? 0.7 : 1.0);
#else
    vec3 color = map == 0 ? red : map == 1 ? green : map == 2 ? blue : map == 3 ? yellow : map == 4 ? purple : cyan;
#endif
    if (e <= 0.0 || map == MAPS) discard;
    gl_FragColor = vec4(color, 0.5);
}
#endif
