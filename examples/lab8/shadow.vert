#version 120
// Lab 8's vertex shader, z up, mended: main() returns void, and x_S = x_L - z_L (x_L - x) / (z_L - z) is left undivided,
// so that a vertex at the light's height divides by nothing and one above it is clipped, w being negative.
uniform vec3 light;
varying float height;

void main() {
    vec3 p = gl_Vertex.xyz;
    height = p.z;
    gl_Position = gl_ModelViewProjectionMatrix * vec4(light.z * p.xy - p.z * light.xy, 0.0, light.z - p.z);
}
