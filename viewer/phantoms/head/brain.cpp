#include "viewer/phantoms/head/anatomy.h"

namespace volumen::head {

namespace {

constexpr float csfHu = 8, greyHu = 40, whiteHu = 29, duraHu = 60;

// Returns the distance to the sheets of fluid between the folds of the brain, up to their depth.
float folds(Vec p, float depth) {
  const Vec bent = p + 5.f * Vec(noise(p / 23.f), noise(p / 23.f + 31.f), noise(p / 23.f + 67.f));
  const float sheet = std::abs(noise(bent / 11.f)) * 8;
  return sheet + 6 * rise(11, 20, depth);
}

// The leaves of the cerebellum are thin and almost level.
float leaves(Vec p, float depth) {
  const float sheet = (1 + wave((p.z + 0.35f * p.y + 2 * noise(p / 12.f)) / 5.5f)) * 1.2f;
  return sheet + 3 * rise(6, 14, depth);
}

float deepGrey(Vec q) {
  float d = ellipsoid(q, {10, 8, 33}, {8, 14, 8});                    // thalamus
  d = std::min(d, ellipsoid(q, {26, -6, 33}, {6, 17, 11}));           // putamen
  return std::min(d, tube(q, {14, -26, 38}, {17, 10, 50}, 5, 2.5f));  // caudate
}

// Returns a positive value in the cerebrum, which lies above the tent of the cerebellum.
float aboveTent(Vec p) { return p.z - 6 - 0.35f * (62 - p.y) + 0.25f * std::abs(p.x); }

float brainStem(Vec p) {
  const float upper = tube(p, {0, 12, 24}, {0, 27, -12}, 12, 13);
  return std::min(upper, tube(p, {0, 27, -12}, {0, 35, -44}, 11, 6.5f));
}

// Returns the distance to the fluid between the lobes: between the hemispheres, in the Sylvian fissure, at
// the tent.
float fissures(Vec p) {
  const Vec q = mirrored(p);
  const float tent = aboveTent(p);
  float d = std::abs(tent) + (p.y > 14 ? 0.f : 20.f);
  if (tent < 0 && p.y > 14) return d;
  if (q.x < 8 && p.z > 30)
    d = std::min(d, q.x - 0.6f + 6 * rise(62, 50, p.z) * rise(60, 40, std::abs(p.y - 10)));
  const float course = std::abs(p.z - 14 - 0.30f * (p.y + 30) - 4 * noise(p / 14.f)) - 0.6f;
  return std::min(d, std::max({course, 30 - q.x, std::abs(p.y) - 36}));
}

// Returns how far p lies inside brain tissue, measured from the nearest fluid. Negative in fluid, and limited
// where larger values no longer matter.
float cortex(Vec p, float depth) {
  const float surface = depth - 2.6f - 0.8f * noise(p / 19.f);
  if (brainStem(p) < 0) return std::min(8.9f, surface);
  float fluid = fissures(p);
  if (surface < 14) {
    const bool hindBrain = aboveTent(p) < 0 && p.y > 14;
    fluid = std::min(fluid, hindBrain ? leaves(p, depth) : folds(p, depth));
  }
  const float cistern = ellipsoid(p, {0, -6, 6}, {15, 16, 8});
  return std::min({fluid - 1.1f, surface, cistern, 8.9f});
}

// Returns the hard membranes: around everything, between the hemispheres, over the cerebellum.
float dura(Vec p, float depth) {
  const float falx = std::max(std::abs(p.x) - 0.6f, 46 - p.z + 0.2f * p.y);
  const float tent = std::max({std::abs(aboveTent(p)) - 0.7f, 16 - p.y, 14 - std::abs(p.x)});
  return std::min({falx, tent, depth - 0.8f});
}

}  // namespace

float ventricles(Vec p) {
  const Vec q = mirrored(p);
  float d = tube(q, {7, -32, 40}, {10, -4, 52}, 5, 5.5f);  // frontal horn and body
  d = join(d, tube(q, {10, -4, 52}, {20, 30, 46}, 5.5f, 6.5f), 3);
  d = join(d, tube(q, {20, 30, 46}, {24, 40, 34}, 7, 6.5f), 3);
  d = join(d, tube(q, {24, 40, 34}, {24, 62, 30}, 5.5f, 2.5f), 3);  // occipital horn
  d = join(d, tube(q, {24, 40, 34}, {32, 8, 10}, 5, 3), 3);         // temporal horn
  d = std::max(d, 1 - q.x);                                         // septum
  d = std::min(d, box(p, {0, 2, 34}, {2.6f, 15, 9}, 2));            // third ventricle
  d = std::min(d, tube(p, {0, 18, 26}, {0, 30, 4}, 1.2f, 1.5f));    // aqueduct
  return std::min(d, ellipsoid(p, {0, 35, -6}, {8, 6, 11}));        // fourth ventricle
}

float brainValue(Vec p, float depth, float w) {
  const Vec q = mirrored(p);
  const float underSurface = cortex(p, depth);
  const float grey = std::min(cover(underSurface - 3.4f, 1) + cover(deepGrey(q), 1), 1.f);
  float hu = brainStem(p) < 0 ? 34 : glm::mix(whiteHu, greyHu, grey) + 1.5f * noise(p / 2.5f);
  hu = glm::mix(hu, csfHu, cover(std::min(underSurface, ventricles(p)), w));
  hu = glm::mix(hu, duraHu, cover(dura(p, depth), w));
  hu = glm::mix(hu, 160.f, cover(ellipsoid(p, {0, 22, 31}, {2, 3, 2}), w));        // pineal gland
  return glm::mix(hu, 130.f, cover(ellipsoid(q, {22, 38, 37}, {2, 4, 2.5f}), w));  // choroid plexus
}

}  // namespace volumen::head
