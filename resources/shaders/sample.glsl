// Density and gradient at a place (picture.md 2, 3), in the units of the textures' integers or floats.
uniform sampler3D density;
uniform sampler3D gradient;
uniform ivec3 size;  // voxels
vec3 pVoxel;         // where it is looked at, clamped to the grid

#ifdef SHADER_FILTER
// The interpolation of the CPU, operation for operation: a + f (b - a), first along i, then j, then k.
ivec3 cell, next;
vec3 place;

void moveTo(vec3 p) {
  pVoxel = clamp(p, vec3(0.0), vec3(size - 1));
  cell = min(ivec3(pVoxel), max(size - 2, ivec3(0)));
  next = min(cell + 1, size - 1);
  place = pVoxel - vec3(cell);
}

vec4 rowOf(sampler3D texels, int j, int k) {
  vec4 a = texelFetch(texels, ivec3(cell.x, j, k), 0), b = texelFetch(texels, ivec3(next.x, j, k), 0);
  EXACT vec4 x = a + place.x * (b - a);
  return x;
}

vec4 valueHere(sampler3D texels) {
  vec4 a = rowOf(texels, cell.y, cell.z), b = rowOf(texels, next.y, cell.z);
  vec4 c = rowOf(texels, cell.y, next.z), d = rowOf(texels, next.y, next.z);
  EXACT vec4 near = a + place.y * (b - a);
  EXACT vec4 far = c + place.y * (d - c);
  EXACT vec4 x = near + place.z * (far - near);
  return x;
}

float densityHere() { return valueHere(density).r; }
vec4 fourHere() { return valueHere(gradient); }
vec3 gradientHere() { return fourHere().xyz; }
#else
uniform float smallest;  // density
uniform float rounding;  // of a density that comes back

void moveTo(vec3 p) { pVoxel = clamp(p, vec3(0.0), vec3(size - 1)); }

vec3 coordinate() { return (pVoxel + 0.5) / vec3(size); }

// Normalised 16 bits come back as 0..1, counted from the smallest density; what is within the rounding of
// that of an integer is the integer, so that constant regions keep their value (picture.md 2).
float densityHere() {
  float d = textureLod(density, coordinate(), 0.0).r * 65535.0;
  float whole = round(d);
  return smallest + (abs(d - whole) < rounding ? whole : d);
}

vec3 gradientHere() { return textureLod(gradient, coordinate(), 0.0).xyz * 32767.0; }
#endif
