#version 330 core
// What a Gaussian adds to a pixel, in front of those that were drawn before it.

flat in vec4 colour;
flat in vec3 conic;
in vec2 away;
out vec4 shown;

void main() {
    float power = 0.5 * (conic.x * away.x * away.x + conic.z * away.y * away.y) + conic.y * away.x * away.y;
    float alpha = min(colour.a * exp(-power), 0.99);
    if (alpha < 1.0 / 255.0) {
        discard;
    }
    shown = vec4(colour.rgb * alpha, alpha);
}
