#include "viewer/phantoms/head/anatomy.h"

namespace volumen::head {

namespace {

constexpr float pitch = 17;  // Distance of adjacent vertebrae, mm.

float vertebra(Vec p, float z, bool axis) {
  const Vec q = p - Vec(0, 0, z);
  const Vec flat(q.x, q.y, 0);
  const float disc =
      std::max(glm::length((flat - Vec(0, 19, 0)) / Vec(1.35f, 1, 1)) - 8.5f, std::abs(q.z) - 6.2f);
  const float body = without(disc, ellipsoid(q, {0, 34, 0}, {10, 8, 20}), 1);
  const float ring = glm::length(Vec(glm::length(flat - Vec(0, 36, 0)) - 13, 0, q.z * 0.55f)) - 3;
  const float pillar = box(q, {22, 31, 0}, {6, 7, 8}, 4);
  const float transverse = tube(q, {14, 20, 0}, {27, 21, -2}, 3.5f, 3);
  const float spinous =
      tube(q, {0, 48, -1}, {axis ? 2.f : 0.f, axis ? 66.f : 62.f, -8}, axis ? 5.f : 3.5f, axis ? 5.f : 3.f);
  float d = join(join(body, ring, 3), join(pillar, spinous, 2), 3);
  d = join(d, transverse, 3);
  return without(d, tube(q, {19, 20, -12}, {19, 20, 12}, 2.6f), 1);
}

float atlas(Vec p) {
  const Vec q = p - Vec(0, 0, -52);
  const Vec flat(q.x / 1.12f, q.y - 34, 0);
  float d = glm::length(Vec(glm::length(flat) - 21, 0, q.z * 0.8f)) - 3.6f;
  d = join(d, box(q, {19, 29, 0}, {8, 9, 7}, 4), 3);
  d = join(d, tube(q, {24, 31, 0}, {38, 33, 0}, 5, 4), 4);
  return without(d, tube(q, {31, 31, -12}, {31, 31, 12}, 3), 1);
}

}  // namespace

float spine(Vec p) {
  p = mirrored(p);
  float d = atlas(p);
  const float axisZ = -70;
  d = std::min(d, join(vertebra(p, axisZ, true), tube(p, {0, 20, axisZ}, {0, 20, -44}, 5.5f, 4.5f), 3));
  for (int n = 1; n <= 4; ++n) d = std::min(d, vertebra(p, axisZ - pitch * float(n), false));
  const float hyoid = tube(p, {0, -24, -112}, {19, -6, -107}, 3.5f, 2);
  return std::min(d, hyoid);
}

float spinalCanal(Vec p) {
  const float forward = 36 - 1.5f * rise(-60, -130, p.z);
  return std::max(glm::length(Vec(p.x / 1.2f, p.y - forward, 0)) - 9, p.z + 26);
}

}  // namespace volumen::head
