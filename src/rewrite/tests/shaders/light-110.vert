// Per-pixel light, first half.
varying vec3 normal, toLight;
uniform vec3 light;

void main()
{
    vec4 eye = gl_ModelViewMatrix * gl_Vertex;
    normal = gl_NormalMatrix * gl_Normal;
    toLight = light - eye.xyz / eye.w;
    gl_TexCoord[0] = gl_MultiTexCoord0;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
