#include "viewer/phantoms/head/anatomy.h"

namespace volumen::head {

namespace {

float vault(Vec p) {
  // Narrower at the forehead than at the parietal bones.
  const float narrow = 1 + 0.13f * rise(10, -75, p.y) + 0.05f * rise(30, 95, p.y);
  const Vec q(p.x * narrow, p.y, p.z);
  const float round =
      join(ellipsoid(q, {0, 11, 41}, {66, 83, 65}), ellipsoid(q, {0, 34, 40}, {67, 60, 57}), 8);
  return join(round, ellipsoid(q, {0, -10, 34}, {57, 64, 50}), 8);
}

}  // namespace

float cranialCavity(Vec p) {
  p = mirrored(p);
  const float anteriorFloor = 15 - 0.10f * (p.y + 40) - p.z;  // The orbits lie below it.
  const float above = both(vault(p), std::max(anteriorFloor, -6 - p.z), 5);
  const float temporal = ellipsoid(p, {34, -5, 3}, {25, 34, 20});
  const float posterior = ellipsoid(p, {0, 52, -4}, {51, 39, 34});
  return join(join(above, temporal, 8), posterior, 10);
}

float skullThickness(Vec p) {
  const float forehead = rise(-40, -80, p.y), back = rise(70, 100, p.y);
  const float temple = rise(50, 64, std::abs(p.x)) * rise(40, 10, p.z) * rise(50, 20, p.y);
  return 6.2f + 1.2f * forehead + 1.6f * back - 2.4f * temple;
}

namespace {

// A cone from the rim to the optic canal, squarish in front.
float orbitalCone(Vec p) {
  const Vec q(p.x, p.y, 3 + (p.z - 3) * 1.12f);
  const float cone = tube(q, {33.5f, -84, 3}, {15, -30, 5}, 20, 3);
  const float front = box(p, {33.5f, -72, 3}, {19, 22, 17.5f}, 9);
  return join(cone, both(front, cone - 2.5f, 3), 2);
}

}  // namespace

float orbit(Vec p, float cavity) { return std::max(orbitalCone(mirrored(p)), 2.2f - cavity); }

namespace {

float orbitalRim(Vec p) {
  float d = tube(p, {10, -77, 20}, {28, -77, 25}, 5.5f, 5.5f);
  d = join(d, tube(p, {28, -77, 25}, {47, -67.5f, 18}, 5.5f, 5), 4);
  d = join(d, tube(p, {48, -66.5f, 19}, {51.5f, -61, -6}, 5, 4.5f), 5);
  d = join(d, tube(p, {51.5f, -61, -6}, {46, -66, -18}, 5, 5), 5);
  d = join(d, tube(p, {47, -66, -18}, {22, -77, -16}, 5, 4), 5);
  return join(d, tube(p, {16, -78, -18}, {11, -79, 14}, 4.5f, 4), 5);
}

float cheekBone(Vec p) {
  float d = ellipsoid(p, {46, -61, -22}, {13, 10, 10});
  d = join(d, tube(p, {55, -54, -21}, {63, -34, -19}, 4.5f, 3.2f), 6);
  d = join(d, tube(p, {63, -34, -19}, {64, -6, -13}, 3.2f, 3.4f), 3);
  return join(d, tube(p, {64, -6, -13}, {57, 10, -8}, 3.6f, 6), 5);
}

float upperJaw(Vec p) {
  // The alveolar arch that holds the teeth, and the walls of the maxillary sinus above it.
  const float arch = -81 + p.x * p.x / 23;
  const float along = std::max(std::abs(p.y - arch) / (1 + std::abs(p.x) / 14) - 5, p.y + 34);
  const float alveolar = both(both(along, std::abs(p.z + 47) - 7, 8), p.x - 33, 3);
  const float body =
      join(ellipsoid(p, {25, -60, -28}, {20, 19, 18}), ellipsoid(p, {6, -63, -40}, {20, 18, 11}), 6);
  const float palate = box(p, {0, -55, -41}, {22, 20, 3}, 2);
  const float spineOfNose = tube(p, {0, -78, -41}, {0, -85, -41}, 2.5f, 1);
  return join(join(join(alveolar, body, 10), palate, 3), spineOfNose, 3);
}

// The bridge of the nose, the frontal bone above it and the ethmoid bone behind it.
float noseBone(Vec p) {
  float d = tube(p, {0, -80, 15}, {0, -91.5f, -7}, 4.2f, 3);
  d = join(d, tube(p, {5, -82, 6}, {11, -80, -18}, 3.5f, 3.5f), 5);
  d = join(d, ellipsoid(p, {0, -77, 20}, {14, 6, 10}), 5);
  return join(d, box(p, {7, -54, 2}, {8, 21, 11}, 3), 3);
}

// The base of the skull: sphenoid, petrous bones, mastoids and condyles.
float baseOfSkull(Vec p) {
  float d = ellipsoid(p, {0, -12, -8}, {17, 24, 15});
  d = join(d, tube(p, {0, 2, -10}, {0, 20, -36}, 9, 5), 5);
  d = join(d, tube(p, {18, 4, -13}, {56, 18, -10}, 9, 12), 6);
  d = join(d, tube(p, {56, 25, -14}, {53, 22, -37}, 11, 6), 5);
  d = join(d, ellipsoid(p, {17, 28, -41}, {7, 11, 6}), 4);
  d = join(d, tube(p, {13, -20, -14}, {14, -24, -42}, 4, 2.5f), 4);
  return join(d, tube(p, {24, -36, 2}, {42, -40, 4}, 5, 6), 6);
}

// Pear-shaped in front, a corridor behind.
float nasalCavity(Vec p) {
  const float widest = 12.5f - 8.5f * rise(-36, 2, p.z);
  const float top = 3 - 9 * rise(-70, -82, p.y);
  const float across = both(p.x - widest, std::max(p.z - top, -39 - p.z), 5);
  return both(across, std::abs(p.y + 66) - 34, 4);
}

}  // namespace

float facialRelief(Vec p) { return join(orbitalRim(p), cheekBone(p), 4); }

float skull(Vec p, float cavity) {
  p = mirrored(p);
  float d = cavity - skullThickness(p);
  if (p.z > 50) return d;
  d = join(d, baseOfSkull(p), 5);
  if (p.y < 20) {
    const float frontal = both(vault(p) - skullThickness(p), 12 - p.z, 4);
    const float cone = orbitalCone(p);
    const float orbitalWalls = both(cone - 2.2f, -66 - p.y, 4);
    d = std::min(d, frontal);
    d = join(d, join(facialRelief(p), orbitalWalls, 3), 6);
    d = join(d, join(upperJaw(p), noseBone(p), 4), 6);
    d = without(d, std::max(cone, 2.2f - cavity), 1.5f);
    const float nose = nasalCavity(p);
    d = without(d, nose, 1.5f);
    d = std::min(d, std::max({p.x - 0.7f, nose, -70 - p.y}));  // septum
    d = without(d, ellipsoid(p, {50, -30, -36}, {10, 18, 13}), 3);
  }
  d = without(d, tube(p, {0, 35, -24}, {0, 37, -70}, 15, 14), 2);       // foramen magnum
  d = without(d, tube(p, {90, 14, -12}, {50, 15, -11}, 4.6f), 1);       // ear canal
  return without(d, tube(p, {27, -86, -26}, {26, -74, -22}, 1.8f), 1);  // infraorbital foramen
}

float sutureGap(Vec p) {
  const auto zigzag = [](float along) { return 1.8f * wave(along / 11) + wave(along / 5.3f + 0.2f); };
  const float ax = std::abs(p.x);
  const float coronal = std::max(std::abs(p.y + 14 - 0.12f * ax + zigzag(ax - p.z)) - 0.9f, 37 - p.z);
  const float sagittal = std::max({std::abs(p.x + zigzag(p.y)) - 0.9f, -13 - p.y, 76 - p.z});
  const float lambdoid = std::max(
      {std::abs(p.z - 76 + 1.15f * ax + 1.4f * zigzag(1.3f * ax)) * 0.66f - 0.9f, 35 - p.y, 2 - p.z});
  const float arc = glm::length(Vec(0, p.y - 14, p.z + 10)) - 48 + zigzag(0.9f * p.y);
  const float squamous = std::max({std::abs(arc) - 0.9f, 45 - ax, 8 - p.z, p.y - 55});
  return std::min(std::min(coronal, sagittal), std::min(lambdoid, squamous));
}

}  // namespace volumen::head
