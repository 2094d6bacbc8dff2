#include "viewer/phantoms/head/anatomy.h"

namespace volumen::head {

namespace {

float faceMass(Vec p) {
  float d = ellipsoid(p, {0, -34, -14}, {62, 48, 56});          // upper face
  d = join(d, ellipsoid(p, {26, -50, -34}, {33, 35, 32}), 14);  // cheeks
  d = join(d, ellipsoid(p, {0, -61, -57}, {34, 31, 30}), 14);   // around the mouth
  d = join(d, ellipsoid(p, {30, -34, -74}, {24, 38, 24}), 12);  // along the jaw
  d = join(d, ellipsoid(p, {0, -28, -64}, {46, 54, 40}), 8);    // floor of the mouth, and everything between
  d = join(d, ellipsoid(p, {46, -36, 10}, {20, 36, 36}), 12);   // temples
  d = join(d, ellipsoid(p, {44, -25, -44}, {23.5f, 36, 38}), 12);  // over the muscles of the jaw
  d = join(d, ellipsoid(p, {0, -46, -94}, {26, 34, 14}), 10);      // under the chin
  d = join(d, tube(p, {54, 25, -14}, {52, 22, -40}, 14, 9), 14);   // behind the ears
  if (p.z > -50) d = join(d, facialRelief(p) - 3.6f, 16);
  if (p.z < 5 && p.y < 35) d = join(d, jaw(p) - 6, 12);
  return d;
}

float neck(Vec p) {
  const float lean = -0.10f * (p.z + 90);
  const Vec q(p.x, p.y - 24 + lean, 0);
  const float column = glm::length(q / Vec(55, 54, 1));
  const float d = (column - 1) * 54;
  const float larynx = ellipsoid(p, {0, -30, -128}, {12, 14, 16});
  return join(join(std::max(d, p.z - 10), larynx, 14), tube(p, {46, 28, -40}, {26, -20, -150}, 12, 12), 16);
}

float nose(Vec p) {
  float d = tube(p, {0, -82, 14}, {0, -86, -32}, 7, 14);        // base, where it rises from the face
  d = join(d, tube(p, {0, -86, 16}, {0, -103, -32}, 5, 7), 8);  // bridge
  d = join(d, ellipsoid(p, {0, -104, -35}, {9, 8, 8}), 6);      // tip
  d = join(d, ellipsoid(p, {11, -95, -39}, {7, 10, 7}), 5);     // wings
  d = join(d, tube(p, {0, -102, -42}, {0, -92, -46}, 2.6f, 4), 3);
  return without(d, tube(p, {7, -103, -50}, {6.5f, -90, -37}, 3.4f), 2);
}

float eyes(Vec p, float face) {
  const float hollow = ellipsoid(p, {32, -97, 3}, {19, 17, 14});
  float d = without(face, hollow, 12);
  const float fromCentre = glm::length(p - Vec(32, -69, 3));
  float lids = fromCentre - 14.2f;
  // Grooves in the lids: where the closed lids meet, and the fold of the upper lid.
  const float curve = 0.012f * (p.x - 32) * (p.x - 32);
  const float meet = std::abs(p.z + 2 - curve) - 0.5f, fold = std::abs(p.z - 10.5f + 1.3f * curve) - 0.3f;
  lids = without(lids, std::max({meet, std::abs(lids) - 1.2f, std::abs(p.x - 32) - 13}), 1.5f);
  lids = without(lids, std::max({fold, std::abs(lids) - 0.8f, std::abs(p.x - 32) - 12}), 1.5f);
  return join(d, lids, 4);
}

float mouth(Vec p, float face) {
  const float curve = 0.006f * p.x * p.x;
  const Vec lip(p.x, p.y - 1.3f * curve, p.z);  // Lips bend around the teeth.
  float d = join(face, ellipsoid(lip, {5, -89.2f, -59.5f - 0.6f * curve}, {17, 7, 4.8f}), 6);
  d = join(d, ellipsoid(lip, {0, -88.2f, -69.5f + curve}, {18, 7.5f, 5.5f}), 6);
  d = without(d, ellipsoid(lip + Vec(0, 0, -0.25f * curve), {0, -98.5f, -64.3f}, {22, 9.5f, 1}), 2.5f);
  d = without(d, tube(p, {17, -95, -42}, {31, -87, -66}, 3), 8);   // from the nose to the corner of the mouth
  d = without(d, tube(p, {0, -99, -47}, {0, -98.5f, -56}, 3), 4);  // philtrum
  return without(d, ellipsoid(p, {0, -99, -80}, {17, 6, 5}), 8);   // under the lower lip
}

// The auricle: a bowl with a rolled rim that stands off the head towards the back.
float ear(Vec p) {
  const Vec fromCanal = p - Vec(66, 11, -12);
  const float out = 0.94f * fromCanal.x - 0.34f * fromCanal.y;
  const float back = 0.34f * fromCanal.x + 0.94f * fromCanal.y - 0.18f * fromCanal.z;
  const float up = fromCanal.z;
  if (out > 30 || out < -25 || up > 50 || up < -48) return 10;
  const Vec q(out, back - 15, up - 2);
  const float narrower = 1 + 0.25f * rise(0, -30, q.z);
  const Vec r(0, q.y * narrower, q.z);
  const float toRim = (glm::length(r / Vec(1, 17, 31)) - 1) * 17;
  const float bowl = 5 + 3 * rise(-14, 0, toRim);
  const float shell = std::max(std::abs(q.x - bowl) - 1.9f, toRim);
  const float helix = glm::length(Vec(q.x - bowl - 1.2f, toRim + 0.5f, 0)) - 2.9f + 2 * rise(-14, -26, q.z);
  float d = join(shell, helix, 2);
  const float inner = (glm::length((r - Vec(0, -1, 2)) / Vec(1, 9.5f, 18)) - 1) * 10;
  const float antihelix = glm::length(Vec(q.x - bowl - 0.5f, inner, 0)) - 2.4f;
  if (q.y > -9) d = join(d, antihelix, 3);
  const float lobule = ellipsoid(q, {7, -6, -29}, {3.5f, 8, 9});
  const float root = ellipsoid(q, {-1, -4, 0}, {9, 9, 25});
  d = join(join(d, lobule, 4), root, 6);
  const float concha = ellipsoid(q, {9, -4, -6}, {8, 8.5f, 11});
  d = without(d, concha, 3);
  const float tragus = ellipsoid(q, {4, -18, -9}, {5, 3, 6});
  return join(d, tragus, 3);
}

}  // namespace

float skin(Vec p, float cavity) {
  p = mirrored(p);
  float d = cavity - skullThickness(p) - 5.5f;
  if (p.z > 64) return d;
  d = join(d, neck(p), 20);
  if (p.y < 70) {
    float face = faceMass(p);
    if (p.y < -60) face = mouth(p, eyes(p, join(face, nose(p), 7)));
    d = join(d, face, 16);
  }
  if (p.x > 55 && p.y > -15 && p.y < 60) d = join(d, ear(p), 5);
  return without(d, tube(p, {90, 13, -12}, {52, 15, -11}, 3.2f, 2.8f), 1);
}

}  // namespace volumen::head
