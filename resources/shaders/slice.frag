// The n-th sample of every ray: a slice of Blend (paper 3.2).
uniform int slice;
layout(location = 0) out float densityOut;
#ifdef GRADIENTS
layout(location = 1) out vec4 gradientOut;
#endif

void main() {
  readRay();
  densityOut = 0.0;
#ifdef GRADIENTS
  gradientOut = vec4(0.0);
#endif
  if (slice >= steps) return;
  moveTo(samplePlace(slice));
  densityOut = densityHere();
#ifdef GRADIENTS
  gradientOut.xyz = gradientHere();
#endif
}
