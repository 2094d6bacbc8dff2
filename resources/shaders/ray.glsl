// The ray of a pixel (picture.md 6, 7, 9).
// Four texels a pixel: start, middle of the last step; move, steps (voxels); towards the viewer (patient
// space); length of a step, of the last one (unit distances).
uniform samplerBuffer rays;
uniform int width;  // pixels a row
vec3 rayStart, rayMove, rayViewer;
float lastMiddle, stepUnits, lastUnits;
int steps;

void readRay() {
  int at = 4 * (int(gl_FragCoord.y) * width + int(gl_FragCoord.x));
  vec4 start = texelFetch(rays, at), move = texelFetch(rays, at + 1), units = texelFetch(rays, at + 3);
  rayStart = start.xyz;
  lastMiddle = start.w;
  rayMove = move.xyz;
  steps = int(move.w);
  rayViewer = texelFetch(rays, at + 2).xyz;
  stepUnits = units.x;
  lastUnits = units.y;
}

vec3 samplePlace(int n) {
  float middle = n + 1 == steps ? lastMiddle : float(n) + 0.5;
  EXACT vec3 p = rayStart + rayMove * middle;
  return p;
}
