#version 120
varying float height;

void main() {
    if (height < 0.0) discard; // what lies under the ground casts nothing
    gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0);
}
