// Density and gradient of one sample of one ray (picture.md 2, 3, 9), in the units of the textures' integers
// or floats. A strip's samples lie one behind the other, line after line of the target: all rays of step 0, of
// step 1, ...
uniform samplerBuffer rays;  // two texels a ray: start, middle of the last step; move, steps (voxels)
uniform int lineShift;       // log2 of the samples of a line
flat in ivec3 strip;
layout(location = 0) out float densityOut;
#ifdef GRADIENTS
layout(location = 1) out vec4 gradientOut;
#endif

void main() {
  int index = ((int(gl_FragCoord.y) - strip.x) << lineShift) + int(gl_FragCoord.x);
  int ray = strip.z + 2 * (index & ((1 << strip.y) - 1)), at = index >> strip.y;
  vec4 start = texelFetch(rays, ray), move = texelFetch(rays, ray + 1);
  int steps = int(move.w);
  densityOut = 0.0;
#ifdef GRADIENTS
  gradientOut = vec4(0.0);
#endif
  if (at >= steps) return;
  float middle = at + 1 == steps ? start.w : float(at) + 0.5;
  EXACT vec3 p = start.xyz + move.xyz * middle;
  moveTo(p);
  densityOut = densityHere();
#ifdef GRADIENTS
  gradientOut.xyz = gradientHere();
#endif
}
