precision mediump float;
attribute vec4 position;
uniform mat4 modelViewProjection;
varying vec2 at;
void main() { at = position.xy; gl_Position = modelViewProjection * position; }
