#include "viewer/phantoms/head/anatomy.h"

namespace volumen::head {

namespace {

// Returns the septum and the three shelves on the outer wall of the nasal cavity, each curled downwards.
float turbinates(Vec p) {
  const float septum = std::abs(p.x - 0.8f * wave(p.y / 70)) - 1.3f;
  float d = septum;
  const Vec q = mirrored(p);
  constexpr float heights[] = {-33, -19, -7}, reach[] = {5.5f, 5, 4};
  for (int n = 0; n < 3; ++n) {
    const float wall = 12 - 8 * rise(-34, 6, heights[n]);
    d = join(d,
             tube(q, {wall - reach[n], -78 + 6.f * n, heights[n] - 3}, {wall - reach[n], -26, heights[n] - 3},
                  2.4f),
             1.5f);
    d = join(d, tube(q, {wall, -76 + 6.f * n, heights[n] + 2}, {wall, -28, heights[n] + 2}, 1.8f), 3);
  }
  return d;
}

float nasalAirway(Vec p) {
  const float widest = 11.5f - 8.5f * rise(-34, 6, p.z);
  float d = std::max(std::abs(p.x) - widest, std::abs(p.z + 19) - 20);
  d = both(d, std::abs(p.y + 54) - 32, 4);
  const Vec q = mirrored(p);
  d = join(d, tube(q, {7.5f, -101, -46}, {6, -88, -36}, 4, 4.5f), 4);
  return d;
}

float throat(Vec p) {
  const Vec q(p.x * 0.6f, p.y, p.z);
  float d = tube(q, {0, -14, -26}, {0, 2, -46}, 8, 6);
  d = join(d, tube(q, {0, 2, -46}, {0, 2, -92}, 5, 4.5f), 4);
  d = join(d, tube(q, {0, 2, -92}, {0, -4, -108}, 5, 3), 3);
  const float windpipe = tube(p, {0, -14, -112}, {0, -10, -150}, 6, 8.5f);
  return join(d, windpipe, 4);
}

// Returns a honeycomb of air cells, `s` mm apart.
float cells(Vec p, float s) {
  const Vec row = glm::floor(p / s);
  float d = 1e3f;
  for (int n = 0; n < 8; ++n) {
    const Vec cell = row + Vec(float(n & 1), float((n >> 1) & 1), float(n >> 2));
    const std::uint32_t h = hashOf(int(cell.x), int(cell.y), int(cell.z));
    const Vec shift(float(h & 255) / 255 - 0.5f, float((h >> 8) & 255) / 255 - 0.5f,
                    float((h >> 16) & 255) / 255 - 0.5f);
    d = std::min(d, glm::length(p - (cell + 0.5f * shift) * s) - s * 0.44f);
  }
  return d;
}

}  // namespace

float airways(Vec p) {
  const Vec q = mirrored(p);
  float d = std::max(nasalAirway(p), -turbinates(p));
  d = join(d, throat(p), 2);
  d = std::min(d, tube(q, {86, 13, -12}, {52, 15, -11}, 3, 2.8f));
  const float mouth = ellipsoid(p, {0, -58, -57}, {17, 20, 2.2f});
  return std::min(d, mouth);
}

float sinuses(Vec p, float cavity) {
  const Vec q = mirrored(p);
  const float maxillary = ellipsoid(q, {27, -60, -27}, {11.5f, 15, 14});
  const float frontal = join(ellipsoid(q, {9 + 0.5f * wave(p.z / 30), -82, 24}, {7.5f, 3, 8}),
                             ellipsoid(q, {18, -80, 26}, {8, 2.8f, 5}), 3);
  const float sphenoid = ellipsoid(q, {7.5f, -14, -9}, {6, 13, 9});
  float d = std::min(std::min(maxillary, frontal), sphenoid);
  const float ethmoid = box(q, {8.5f, -54, 2}, {4.5f, 19, 9}, 3);
  if (ethmoid < 6) d = std::min(d, std::max(ethmoid, cells(p, 6)));
  const float mastoid =
      join(tube(q, {55, 26, -10}, {53, 22, -33}, 9, 4), tube(q, {44, 17, -8}, {54, 22, -8}, 4, 8), 3);
  if (mastoid < 6) d = std::min(d, std::max(mastoid, cells(p, 4.6f)));
  return std::max(d, 1.8f - cavity);
}

}  // namespace volumen::head
