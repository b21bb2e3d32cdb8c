#version 120
// One light's pass: the lit colour, as vertices have it, times what the light's map lets through. See DepthPass.
uniform sampler2D own;         // the object's own texture, or white
uniform sampler2DShadow map;
uniform int unit;              // whose texture coordinates are the place in the map
uniform float bias;            // of depth, -1 ... 1 from near to far
uniform bool bicubic;
varying vec4 gl_TexCoord[5];

const float size = 512.0;

float bilinear(vec2 at, float depth) { return shadow2D(map, vec3(at, depth)).r; }

// The cubic B-spline over 4 x 4 comparisons as four of 2 x 2.
float smooth4(vec2 at, float depth) {
    vec2 p = at * size, corner = floor(p - 0.5) + 0.5, f = p - corner, g = 1.0 - f;
    vec2 w0 = g * g * g / 6.0, w1 = 2.0 / 3.0 - 0.5 * f * f * (2.0 - f), w3 = f * f * f / 6.0;
    vec2 low = w0 + w1, high = 1.0 - low;
    vec2 a = (corner - 1.0 + w1 / low) / size, b = (corner + 1.0 + w3 / high) / size;
    return low.y * (low.x * bilinear(a, depth) + high.x * bilinear(vec2(b.x, a.y), depth)) +
           high.y * (low.x * bilinear(vec2(a.x, b.y), depth) + high.x * bilinear(b, depth));
}

void main() {
    vec4 p = gl_TexCoord[unit];
    vec3 at = p.xyz / p.w + vec3(0.0, 0.0, bias * 0.5);
    float arrives = p.w > 0.0 ? (bicubic ? smooth4(at.xy, at.z) : bilinear(at.xy, at.z)) : 0.0;
    vec4 texel = texture2D(own, gl_TexCoord[0].xy);
    gl_FragColor = vec4(gl_Color.rgb * texel.rgb * arrives, gl_Color.a * texel.a);
}
