// Takes a vertex to clip space, of planar shadows by way of the receiver's plane, in one matrix made in double.
uniform mat4 clipFromVertex;

#ifdef CLIP
// What lies under the plane, or at and above a lamp, casts nothing: kept where the dot product is not negative.
uniform vec4 abovePlane;
uniform vec4 belowLight;
#endif

#ifdef EXTRUDE
uniform vec4 light; // homogeneous; a vertex's w says how far it goes on away from it, below 0 without an end
uniform float endless; // how far that is; below 0 to infinity
#endif

#ifdef CUTS
out vec4 clip;
#endif

#ifdef OFFSET
uniform vec4 light; // homogeneous
#endif

#ifdef CLIP_NEAR
uniform float nearest; // what a lamp has nearer than this along the axis casts nothing
#endif

#ifdef CUTOUT
out vec3 coordinates;
#endif

void main() {
#ifdef EXTRUDE
    vec3 away = light.w * gl_Vertex.xyz - light.xyz;
    float length = gl_Vertex.w < 0.0 ? endless : gl_Vertex.w;
#ifdef CUTS
    length *= 1.5; // volumes end close below all receivers, and an edge needs its side drawn in the pixels about it
#endif
    vec4 place = length < 0.0 ? vec4(away, 0.0) : vec4(gl_Vertex.xyz + length * away, 1.0);
    gl_Position = clipFromVertex * place;
#elif defined(OFFSET)
    // As terminatorOffset(), but twice as far: a map compares by texels, and what is turned away two texels further in.
    vec3 towards = light.xyz - light.w * gl_Vertex.xyz;
    towards /= max(length(towards), 1e-30);
    float grazed = clamp(3.0 - 2.0 * abs(dot(gl_MultiTexCoord0.xyz, towards)), 0.0, 1.0);
    gl_Position = clipFromVertex * vec4(gl_Vertex.xyz - 2.0 * gl_MultiTexCoord0.w * grazed * towards, 1.0);
#else
    gl_Position = clipFromVertex * gl_Vertex;
#endif
#ifdef CUTS
    clip = gl_Position;
#endif
#ifdef CUTOUT
    coordinates = gl_MultiTexCoord0.xyz;
#endif
#ifdef CLIP_NEAR
    gl_ClipDistance[0] = gl_Position.w - nearest;
#endif
#ifdef CLIP
    gl_ClipDistance[0] = dot(abovePlane, gl_Vertex);
    gl_ClipDistance[1] = dot(belowLight, gl_Vertex);
#endif
}
