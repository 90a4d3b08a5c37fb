#version 150 compatibility
out gl_PerVertex {
    vec4 gl_Position; // where
    float gl_ClipDistance[3];
    vec4 gl_TexCoord[2];
};
void main() {
    gl_Position = ftransform();
    for (int i = 0; i < 3; i++)
        gl_ClipDistance[i] = gl_Position[i];
    gl_TexCoord[1] = gl_MultiTexCoord0;
}
