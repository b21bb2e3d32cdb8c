// What share of the light arrives where marks end within pixels, as alpha: see MarkEdges. Of edges to the left and right what is
// beyond both counts, and of those below and above; of these two the more, for both may be one that leads askew.
uniform sampler2D marks; // alpha: 0 where marked
uniform sampler2D cuts;  // see cuts.frag

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec4 cut = texelFetch(cuts, here, 0);
    bool isMarked = texelFetch(marks, here, 0).a < 0.5;
    vec4 beyond = isMarked ? (1.0 - cut) * vec4(greaterThan(cut, vec4(0.0))) : cut;
    float all = min(max(beyond.x + beyond.y, beyond.z + beyond.w), 1.0);
    gl_FragColor = vec4(0.0, 0.0, 0.0, isMarked ? all : 1.0 - all);
}
