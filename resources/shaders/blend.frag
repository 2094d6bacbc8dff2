// A slice as it is blended into the frame buffer.
uniform sampler2D shaded;
out vec4 pixel;

void main() { pixel = texelFetch(shaded, ivec2(gl_FragCoord.xy), 0); }
