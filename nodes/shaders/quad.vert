// A rectangle over the whole viewport.
void main() { gl_Position = gl_Vertex; }
