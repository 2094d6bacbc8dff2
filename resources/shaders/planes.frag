// Density and gradient of one sample of one ray (SCENE 2, 3, 9), in the units of the textures' integers or
// floats. A strip's samples lie one behind the other, line after line of the target: all rays of step 0, of
// step 1, ...
uniform sampler3D density;
uniform sampler3D gradient;
uniform samplerBuffer rays;  // two texels a ray: start, middle of the last step; move, steps (voxels)
uniform ivec3 size;          // voxels
uniform int lineShift;       // log2 of the samples of a line
flat in ivec3 strip;
layout(location = 0) out float densityOut;
#ifdef GRADIENTS
layout(location = 1) out vec4 gradientOut;
#endif

#ifdef SHADER_FILTER
// The interpolation of the CPU, operation for operation: a + f (b - a), first along i, then j, then k.
ivec3 cell, next;
vec3 place;

float densityRow(int j, int k) {
  float a = texelFetch(density, ivec3(cell.x, j, k), 0).r, b = texelFetch(density, ivec3(next.x, j, k), 0).r;
  EXACT float x = a + place.x * (b - a);
  return x;
}

float densityAt(vec3 p) {
  float a = densityRow(cell.y, cell.z), b = densityRow(next.y, cell.z);
  float c = densityRow(cell.y, next.z), d = densityRow(next.y, next.z);
  EXACT float near = a + place.y * (b - a);
  EXACT float far = c + place.y * (d - c);
  EXACT float x = near + place.z * (far - near);
  return x;
}

vec3 gradientRow(int j, int k) {
  vec3 a = texelFetch(gradient, ivec3(cell.x, j, k), 0).xyz, b = texelFetch(gradient, ivec3(next.x, j, k), 0).xyz;
  EXACT vec3 x = a + place.x * (b - a);
  return x;
}

vec3 gradientAt(vec3 p) {
  vec3 a = gradientRow(cell.y, cell.z), b = gradientRow(next.y, cell.z);
  vec3 c = gradientRow(cell.y, next.z), d = gradientRow(next.y, next.z);
  EXACT vec3 near = a + place.y * (b - a);
  EXACT vec3 far = c + place.y * (d - c);
  EXACT vec3 x = near + place.z * (far - near);
  return x;
}
#else
uniform float smallest;  // density
uniform float rounding;  // of a density that comes back

vec3 coordinate(vec3 p) { return (p + 0.5) / vec3(size); }

// Normalised 16 bits come back as 0..1, counted from the smallest density; what is within the rounding of
// that of an integer is the integer, so that constant regions keep their value (SCENE 2).
float densityAt(vec3 p) {
  float d = textureLod(density, coordinate(p), 0.0).r * 65535.0;
  float whole = round(d);
  return smallest + (abs(d - whole) < rounding ? whole : d);
}

vec3 gradientAt(vec3 p) { return textureLod(gradient, coordinate(p), 0.0).xyz * 32767.0; }
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
  p = clamp(p, vec3(0.0), vec3(size - 1));
#ifdef SHADER_FILTER
  cell = min(ivec3(p), max(size - 2, ivec3(0)));
  next = min(cell + 1, size - 1);
  place = p - vec3(cell);
#endif
  densityOut = densityAt(p);
#ifdef GRADIENTS
  gradientOut.xyz = gradientAt(p);
#endif
}
