// Classification and light of a sample (picture.md 4, 5), as the CPU's kernels compute them.
uniform samplerBuffer curve;    // three texels a segment: end, start, opacity, its rise; red, green; blue
uniform samplerBuffer buckets;  // the first segment that a density of each bucket can lie in
uniform float curveLow, perBucket;
uniform int bucketCount, hops;

int segmentOf(float d) {
  int s = int(texelFetch(buckets, int(clamp((d - curveLow) * perBucket, 0.0, float(bucketCount - 1)))).r);
  for (int hop = 0; hop < hops && d >= texelFetch(curve, 3 * s).x; ++hop) ++s;
  return s;
}

float opacityOf(int s, float d) {
  vec4 c = texelFetch(curve, 3 * s);
  return clamp(c.z + (d - c.y) * c.w, 0.0, 1.0);
}

vec3 colourOf(int s, float d) {
  float along = d - texelFetch(curve, 3 * s).y;
  vec4 rg = texelFetch(curve, 3 * s + 1), b = texelFetch(curve, 3 * s + 2);
  return clamp(vec3(rg.x + along * rg.y, rg.z + along * rg.w, b.x + along * b.y), 0.0, 1.0);
}

// 1 - (1 - opacity)^units, by series where differences would lose digits.
float intervalOpacity(float opacity, float units) {
  float o = min(opacity, 1.0 - 1.0 / 1048576.0);
  float log1p = o < 0.02 ? -o * (1.0 + o * (0.5 + o * (1.0 / 3.0 + o * (0.25 + o * 0.2)))) : log(1.0 - o);
  float x = log1p * units;
  return x > -0.02 ? -x * (1.0 + x * (0.5 + x * (1.0 / 6.0 + x / 24.0))) : 1.0 - exp(x);
}

#ifdef GRADIENT_OPACITY
uniform samplerBuffer factors;  // gradient, factor
uniform int factorCount;

float gradientFactor(float g) {
  vec2 below = texelFetch(factors, 0).xy;
  if (g < below.x) return below.y;
  for (int n = 1; n < factorCount; ++n) {
    vec2 above = texelFetch(factors, n).xy;
    if (g < above.x) return mix(below.y, above.y, (g - below.x) / (above.x - below.x));
    below = above;
  }
  return below.y;
}
#endif

#if defined(GRADIENTS)
uniform mat3 gradientMatrix;  // stored gradient -> value per mm, patient space

// The normal, and |g_p|.
vec4 normalOf(vec3 stored) {
  vec3 g = gradientMatrix * stored;
  float largest = max(max(abs(g.x), abs(g.y)), max(abs(g.z), 1e-30));
  vec3 unit = g / largest;
  float l = length(unit);
  return vec4(-unit / max(l, 1e-15), largest * l);
}
#endif

#if defined(MAP) || defined(MAP_NEAREST)
uniform samplerBuffer shades;  // the map's nodes: two texels each, D and S of red, green, blue; or one
uniform int mapSize;

struct DS { vec3 d, s; };
DS nodeOf(int face, int u, int v) {
  int at = (face * mapSize + v) * mapSize + u;
#ifdef GREY
  vec2 light = texelFetch(shades, at).xy;
  return DS(light.xxx, light.yyy);
#else
  vec4 a = texelFetch(shades, 2 * at), b = texelFetch(shades, 2 * at + 1);
  return DS(vec3(a.xz, b.x), vec3(a.yw, b.y));
#endif
}

DS lightOf(vec3 n) {
  vec3 size = abs(n);
  int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  float major = n[axis];
  int face = 2 * axis + (major < 0.0 ? 1 : 0);
  vec2 c = vec2(n[(axis + 1) % 3], n[(axis + 2) % 3]) / (major == 0.0 ? 1.0 : major);
#ifdef MAP_NEAREST
  ivec2 p = clamp(ivec2((c + 1.0) * (0.5 * float(mapSize))), ivec2(0), ivec2(mapSize - 1));
  return nodeOf(face, p.x, p.y);
#else
  vec2 at = clamp((c + 1.0) * (0.5 * float(mapSize - 1)), vec2(0.0), vec2(mapSize - 1));
  ivec2 low = min(ivec2(at), ivec2(mapSize - 2));
  vec2 f = at - vec2(low);
  DS a = nodeOf(face, low.x, low.y), b = nodeOf(face, low.x + 1, low.y);
  DS e = nodeOf(face, low.x, low.y + 1), g = nodeOf(face, low.x + 1, low.y + 1);
  return DS(mix(mix(a.d, b.d, f.x), mix(e.d, g.d, f.x), f.y), mix(mix(a.s, b.s, f.x), mix(e.s, g.s, f.x), f.y));
#endif
}
#elif defined(PHONG) || defined(LOCAL)
uniform samplerBuffer lights;  // four texels each: l, h, diffuse, specular
uniform int lightCount;
uniform float ambient, shininess;
uniform bool twoSided, specular;
uniform vec3 viewer;  // of the camera

struct DS { vec3 d, s; };
DS oneSide(vec3 n, vec3 e) {
  DS sum = DS(vec3(ambient), vec3(0.0));
  for (int i = 0; i < lightCount; ++i) {
    vec3 l = texelFetch(lights, 4 * i).xyz;
    float nl = dot(n, l);
    sum.d += texelFetch(lights, 4 * i + 2).xyz * max(nl, 0.0);
    if (!specular) continue;
#ifdef LOCAL
    float size = length(l + e);
    vec3 h = size < 1e-3 ? vec3(0.0) : (l + e) / size;
#else
    vec3 h = texelFetch(lights, 4 * i + 1).xyz;
#endif
    float nh = min(dot(n, h), 1.0);
    if (nh > 0.0)
      sum.s += texelFetch(lights, 4 * i + 3).xyz * (clamp(10.0 * nl, 0.0, 1.0) * pow(nh, shininess));
  }
  return sum;
}

DS lightOf(vec3 n) {
#ifdef LOCAL
  vec3 e = rayViewer;
#else
  vec3 e = viewer;
#endif
  if (!twoSided) return oneSide(n, e);
  float w = clamp(0.5 + dot(n, e) / 0.2, 0.0, 1.0);
  if (w >= 1.0) return oneSide(n, e);
  DS back = oneSide(-n, e);
  if (w <= 0.0) return back;
  DS front = oneSide(n, e);
  return DS(mix(back.d, front.d, w), mix(back.s, front.s, w));
}
#endif

#ifdef TABLE
uniform isamplerBuffer shades;  // the 4-index table
uniform float perGradient, densityLow, perDensity;

vec3 tableColour(vec3 stored, float d) {
  ivec3 g = ivec3(clamp(stored * perGradient + 15.5, 0.0, 30.0));
  int at = ((g.z * 32 + g.y) * 32 + g.x) * 32 + int(clamp((d - densityLow) * perDensity + 0.5, 0.0, 31.0));
  int bgr = texelFetch(shades, at).r;
  return vec3(bgr & 255, (bgr >> 8) & 255, (bgr >> 16) & 255) / 255.0;
}
#endif

#if defined(MAP) || defined(MAP_NEAREST) || defined(PHONG) || defined(LOCAL)
uniform float inverseFloor;
uniform vec3 flatLight;

// picture.md 5, a gradient too small to have a direction included.
vec3 litColour(vec3 colour, vec4 normal) {
  DS light = lightOf(normal.xyz);
  float q = min(1.0, normal.w * inverseFloor);
  return colour * (flatLight + q * (light.d - flatLight)) + q * light.s;
}
#endif
