// Draws the strips of a batch, one instance each: whole lines of the target.
// strip texel: first line, lines, log2 of the samples a step, texel of the first ray.
uniform samplerBuffer rays;
uniform float lines;  // of the target
flat out ivec3 strip;  // first line, log2 of the samples a step, texel of the first ray

void main() {
  vec4 s = texelFetch(rays, gl_InstanceID);
  strip = ivec3(s.x, s.z, s.w);
  float line = s.x + (gl_VertexID < 2 ? 0.0 : s.y);
  gl_Position = vec4((gl_VertexID & 1) == 0 ? -1.0 : 1.0, 2.0 * line / lines - 1.0, 0.0, 1.0);
}
