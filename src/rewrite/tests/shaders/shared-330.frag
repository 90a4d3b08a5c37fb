#version 330
#define FRAGMENT
#ifdef VERTEX
in vec4 position;
void main() { gl_Position = position; }
#endif
#ifdef FRAGMENT
out vec4 colour;
void main() { colour = vec4(gl_FragCoord.xy, 0.0, 1.0); }
#endif
