#version 150
layout(triangles) in;
layout(line_strip, max_vertices = 6) out;
in vec3 normal[];
uniform mat4 camera;
#define EMIT(p) gl_Position = camera * (p); EmitVertex()

void main() {
    for (int i = 0; i < gl_in.length(); i++) {
        EMIT(gl_in[i].gl_Position);
        gl_Position.xyz += normal[i];
        EmitVertex ();
        EndPrimitive();
    }
}
