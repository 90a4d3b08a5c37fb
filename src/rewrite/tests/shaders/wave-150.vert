#version 150 compatibility
uniform float mv_shift; // one of our names
varying vec2 at;
void main(void) {
    at = gl_MultiTexCoord0.st;
    gl_Position = ftransform() + vec4(0.0, sin(mv_shift), 0.0, 0.0);
}
