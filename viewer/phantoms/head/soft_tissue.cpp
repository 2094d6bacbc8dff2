#include "viewer/phantoms/head/anatomy.h"

namespace volumen::head {

namespace {

constexpr float skinHu = 25, fatHu = -95, muscleHu = 58;

// Muscles that are visible through the surrounding fat.
float muscles(Vec p) {
  float d = ellipsoid(p, {57, -22, -48}, {7, 17, 30});              // masseter
  d = std::min(d, ellipsoid(p, {60, -22, 14}, {7, 30, 34}));        // temporalis
  d = std::min(d, tube(p, {28, -18, -40}, {42, -14, -72}, 7, 7));   // medial pterygoid
  d = std::min(d, tube(p, {20, -22, -26}, {46, -4, -24}, 7, 5));    // lateral pterygoid
  d = std::min(d, ellipsoid(p, {0, -46, -76}, {24, 34, 19}));       // tongue
  d = std::min(d, tube(p, {0, -78, -98}, {0, -44, -104}, 9, 7));    // floor of the mouth
  d = std::min(d, tube(p, {58, 26, -36}, {26, -12, -150}, 9, 11));  // sternomastoid
  d = std::min(d, ellipsoid(p, {18, 58, -100}, {18, 19, 70}));      // back of the neck
  d = std::min(d, tube(p, {0, -92, -58}, {24, -82, -62}, 4, 3));    // lips
  d = std::min(d, tube(p, {0, -90, -70}, {22, -80, -68}, 4, 3));
  return std::min(d, ellipsoid(p, {0, 4, -80}, {20, 11, 60}));  // walls of the throat
}

// Muscle, and sheets of fat between muscles.
float looseTissue(Vec p) {
  const Vec bent = p + 7.f * Vec(noise(p / 19.f), noise(p / 19.f + 31.f), noise(p / 19.f + 67.f));
  const float sheet = std::abs(noise(bent / 16.f));
  return glm::mix(fatHu, muscleHu, rise(0.09f, 0.18f, sheet)) + 6 * noise(p / 3.f);
}

}  // namespace

float softTissueValue(Vec p, float depth, float w) {
  const float onScalp = rise(20, 45, p.z + 0.25f * p.y);
  const float inFace = rise(-45, -65, p.y);  // Muscles move the skin there.
  const float fatDepth = glm::mix(9.f, 4.5f, std::max(onScalp, inFace)) + 1.5f * noise(p / 22.f);
  const float belowFat = cover(fatDepth - depth, 2 * w);
  float hu = fatHu + 10 * noise(p / 5.f);
  if (belowFat > 0) {
    const float muscle = muscleHu + 5 * noise(p / 2.f);
    const float inMuscle = std::max({cover(muscles(mirrored(p)), w), onScalp, inFace});
    const float below = inMuscle < 1 ? glm::mix(looseTissue(p), muscle, inMuscle) : muscle;
    hu = glm::mix(hu, below, belowFat);
  }
  return glm::mix(skinHu, hu, cover(1.9f - depth, w));
}

float orbitValue(Vec p, float w) {
  const Vec q = mirrored(p);
  const Vec centre(32, -69, 3);
  float hu = fatHu + 6 * noise(p / 4.f);
  constexpr float turn[4][2] = {{12, 0}, {-12, 0}, {0, 12}, {0, -12}};
  for (const auto& t : turn) {
    const float muscle = tube(q, centre + Vec(t[0], 6, t[1]), {16, -32, 5}, 1.8f, 1.6f);
    hu = glm::mix(hu, 55.f, cover(muscle, w));
  }
  hu = glm::mix(hu, 38.f, cover(tube(q, centre + Vec(-3, 10, 0), {15, -30, 5}, 2.2f, 2.2f), w));
  hu = glm::mix(hu, 45.f, cover(ellipsoid(q, {46, -74, 14}, {6, 7, 5}), w));  // lacrimal gland
  const float eyeball = glm::length(q - centre) - 12.2f;
  hu = glm::mix(hu, 62.f, cover(eyeball, w));
  hu = glm::mix(hu, 9.f, cover(eyeball + 1.3f, w));
  return glm::mix(hu, 95.f, cover(ellipsoid(q, centre + Vec(0, -7.2f, 0), {4.8f, 2.2f, 4.8f}), w));
}

}  // namespace volumen::head
