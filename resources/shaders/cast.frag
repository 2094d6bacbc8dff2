// A ray of a pixel from front to back (picture.md 6, 9): resampled, classified, shaded and composited here
// (figure 1c of the paper), or composited from voxels that were shaded before (figure 1b). In passes: a shader
// that loops for long may be ended (llvmpipe: after 65,536 turns).
uniform float stopTransmittance;
uniform sampler2D before;           // what the passes so far came to
uniform int firstStep, behindStep;  // of this pass
// Colour times opacity and opacity; or a projection's extreme, or sum, length and what Kahan's sum lost.
out vec4 pixel;

vec4 sumBefore() { return firstStep > 0 ? texelFetch(before, ivec2(gl_FragCoord.xy), 0) : vec4(0.0); }

#ifdef COMPOSITE
vec4 sampleHere(float units) {
#ifdef PRESHADED
  vec4 s = fourHere();
  if (s.a <= 0.0) return vec4(0.0);
  float alpha = intervalOpacity(s.a, units);
  return vec4(s.rgb * (alpha / s.a), alpha);
#else
  float d = densityHere();
  int s = segmentOf(d);
  float opacity = opacityOf(s, d);
  if (opacity <= 0.0) return vec4(0.0);
#ifdef GRADIENTS
  vec3 g = gradientHere();
  vec4 normal = normalOf(g);
#endif
#ifdef GRADIENT_OPACITY
  opacity *= gradientFactor(normal.w);
  if (opacity <= 0.0) return vec4(0.0);
#endif
#ifdef TABLE
  vec3 colour = tableColour(g, d);
#else
  vec3 colour = colourOf(s, d);
#endif
#if defined(MAP) || defined(MAP_NEAREST) || defined(PHONG) || defined(LOCAL)
  colour = litColour(colour, normal);
#endif
  float alpha = intervalOpacity(opacity, units);
  return vec4(colour * alpha, alpha);
#endif
}

void main() {
  readRay();
  vec4 sum = sumBefore();
  int behind = min(behindStep, steps);
  for (int n = firstStep; n < behind && sum.a <= 1.0 - stopTransmittance; ++n) {
    moveTo(samplePlace(n));
    sum += (1.0 - sum.a) * sampleHere(n + 1 == steps ? lastUnits : stepUnits);
  }
  pixel = sum;
}
#else
void main() {
  readRay();
  vec4 sum = sumBefore();
  float value = sum.x, total = sum.y, lost = sum.z;
  int behind = min(behindStep, steps);
  for (int n = firstStep; n < behind; ++n) {
    moveTo(samplePlace(n));
    float d = densityHere();
#ifdef MIP
    value = n == 0 ? d : max(value, d);
#elif defined(MINIP)
    value = n == 0 ? d : min(value, d);
#else
    float units = n + 1 == steps ? lastUnits : stepUnits;
    // Kahan's sum: samples can be many.
    EXACT float term = d * units - lost;
    EXACT float next = value + term;
    EXACT float rest = (next - value) - term;
    lost = rest;
    value = next;
    total += units;
#endif
  }
  pixel = vec4(value, total, lost, 0.0);
}
#endif
