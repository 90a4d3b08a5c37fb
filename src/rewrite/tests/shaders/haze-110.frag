uniform sampler2D screen; uniform vec2 size;
vec2 at = gl_FragCoord.xy / size;
void main() {
    gl_FragColor = texture2D(screen, at + 0.01 * sin(gl_FragCoord.yx));
}
