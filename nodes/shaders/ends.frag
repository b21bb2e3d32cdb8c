// Passes where a pixel is marked otherwise than one of its four neighbours: see MarkEdges. A straight edge that cuts a pixel at all
// leaves one of them on its other side. What is beyond the pass may be anything: cuts.frag takes it for no end.
uniform sampler2D marks; // alpha: 0 where marked

void main() {
    vec2 texel = 1.0 / vec2(textureSize(marks, 0)), here = gl_FragCoord.xy * texel;
    float own = texture(marks, here).a;
    float others = texture(marks, here + vec2(texel.x, 0.0)).a + texture(marks, here - vec2(texel.x, 0.0)).a +
                   texture(marks, here + vec2(0.0, texel.y)).a + texture(marks, here - vec2(0.0, texel.y)).a;
    if (abs(others - 4.0 * own) < 0.5) discard;
    gl_FragColor = vec4(0.0);
}
