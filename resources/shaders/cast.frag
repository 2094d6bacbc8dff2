// A ray of a pixel from front to back (SCENE 6, 9): resampled, classified, shaded and composited here (figure
// 1c of the paper), or composited from voxels that were shaded before (figure 1b).
uniform float stopTransmittance;
out vec4 pixel;  // colour times opacity and opacity, or a projection's density in red

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
  vec4 sum = vec4(0.0);
  for (int n = 0; n < steps && sum.a <= 1.0 - stopTransmittance; ++n) {
    moveTo(samplePlace(n));
    sum += (1.0 - sum.a) * sampleHere(n + 1 == steps ? lastUnits : stepUnits);
  }
  pixel = sum;
}
#else
void main() {
  readRay();
  float value = 0.0, total = 0.0, lost = 0.0;
  for (int n = 0; n < steps; ++n) {
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
    EXACT float sum = value + term;
    EXACT float rest = (sum - value) - term;
    lost = rest;
    value = sum;
    total += units;
#endif
  }
#ifdef AVERAGE
  value /= max(total, 1e-30);
#endif
  pixel = vec4(value, 0.0, 0.0, 0.0);
}
#endif
