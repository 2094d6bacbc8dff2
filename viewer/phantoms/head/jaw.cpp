#include <array>

#include "viewer/phantoms/head/anatomy.h"

namespace volumen::head {

float jaw(Vec p) {
  p = mirrored(p);
  // The body is a band on edge along a parabola, with its upper edge nearer to the tongue.
  const float curve = 27 - 4 * rise(-92, -76, p.z), x = std::min(p.x, 42.f);
  const float slope = 2 * x / curve, across = (p.y + 85 - x * x / curve) / std::sqrt(1 + slope * slope);
  const float middle = -90 + 14 * rise(8, 48, p.x), halfHeight = 18.5f - 4.5f * rise(20, 46, p.x);
  const float beyond = std::max({p.x - 42, p.y + 10, 0.f});
  const float body = box(Vec(across, beyond, p.z - middle), Vec(0), {5.5f, 2, halfHeight}, 4.5f);
  const float chin = ellipsoid(p, {0, -85, -103}, {14, 7.5f, 7});
  // The ramus with its two processes.
  const Vec q(p.x - 48 - 0.05f * (p.z + 50), p.y + 14 + 0.22f * (p.z + 50), p.z + 52);
  float ramus = box(q, Vec(0), {3.4f, 16, 30}, 3);
  ramus = without(ramus, tube(q, {-9, 3, 36}, {9, 3, 36}, 12), 3);
  const float condyle = ellipsoid(p, {52, 3, -19}, {9, 4.5f, 5});
  const float neckOfCondyle = tube(p, {50, -3, -40}, {52, 2, -21}, 4, 3.5f);
  const float coronoid = tube(p, {48, -26, -44}, {49, -29, -22}, 4, 2);
  ramus = join(join(ramus, join(condyle, neckOfCondyle, 3), 4), coronoid, 4);
  const float angle = ellipsoid(p, {47, -13, -76}, {4.5f, 13, 13});
  const float bone = join(join(join(body, chin, 6), ramus, 6), angle, 5);
  return without(bone, tube(p, {25, -80, -91}, {21, -68, -90}, 1.8f), 1);  // mental foramen
}

namespace {

struct ToothShape {
  float x, y;                    // Centre of the crown.
  float alongX, alongY;          // Unit vector along the arch.
  float halfWidth, halfDepth;    // Along the arch and across it.
  float biteZ, neckZ, rootTipZ;  // Heights: biting edge, end of the crown, end of the root.
};

// Widths of the teeth from the middle to the back, in mm. Each tooth touches the next along the parabola y =
// front + x^2 / curve.
struct Arch {
  float front, curve;
  std::array<float, 7> widths, depths;
  float biteZ, neckZ, rootTipZ;
};

constexpr Arch upperArch{
    -81.5f, 22, {8.6f, 6.8f, 7.8f, 7, 6.8f, 10.2f, 9.6f}, {6.5f, 6, 8, 9, 9, 11, 11}, -63.5f, -53.5f, -41};
constexpr Arch lowerArch{
    -79, 22, {5.6f, 6, 7, 7.1f, 7.2f, 11, 10.4f}, {6, 6.2f, 7.6f, 8, 8.4f, 10.4f, 10.2f}, -62, -71, -84};

std::array<ToothShape, 7> placed(const Arch& arch) {
  std::array<ToothShape, 7> shapes{};
  float x = 0, y = arch.front;
  const auto advance = [&](float length) {
    for (float done = 0; done < length; done += 0.05f) {
      const float slope = 2 * x / arch.curve, step = 0.05f / std::sqrt(1 + slope * slope);
      x += step;
      y = arch.front + x * x / arch.curve;
    }
  };
  for (std::size_t n = 0; n < shapes.size(); ++n) {
    advance(arch.widths[n] / 2);
    const float slope = 2 * x / arch.curve, length = std::sqrt(1 + slope * slope);
    const float shorter = n >= 3 ? (arch.biteZ > arch.neckZ ? -1.2f : 1.2f) : n == 2 ? 0.f : 0.3f;
    shapes[n] = {x,
                 y,
                 1 / length,
                 slope / length,
                 arch.widths[n] / 2 + 0.1f,
                 arch.depths[n] / 2,
                 arch.biteZ + shorter,
                 arch.neckZ,
                 arch.rootTipZ};
    advance(arch.widths[n] / 2);
  }
  return shapes;
}

Tooth toothAt(Vec p, const ToothShape& s, bool molar) {
  const Vec fromCentre = p - Vec(s.x, s.y, 0);
  const float up = s.biteZ > s.neckZ ? 1.f : -1.f;
  // Local axes: x along the arch, y outwards, z from the neck of the tooth to its biting edge.
  const Vec q(fromCentre.x * s.alongX + fromCentre.y * s.alongY,
              fromCentre.y * s.alongX - fromCentre.x * s.alongY, (p.z - s.neckZ) * up);
  const float height = (s.biteZ - s.neckZ) * up;
  // Front teeth end in an edge, back teeth in a chewing surface with cusps.
  const float taper = molar ? 1.f : 1 - 0.62f * rise(0.2f * height, height, q.z);
  const float halfDepth = s.halfDepth * taper, waist = 1 - 0.18f * rise(0.35f * height, 0, q.z);
  const float cusps =
      molar ? 0.7f * wave(q.x / s.halfWidth * 0.5f + 0.5f) * wave(q.y / s.halfDepth * 0.5f) : 0.f;
  const Vec crownHalf(s.halfWidth * waist, halfDepth, height / 2 + 0.6f);
  const float crown =
      box(q + Vec(0, 0, cusps), {0, 0, height / 2}, crownHalf, std::min(2.f, halfDepth * 0.8f));
  const float rootLength = (s.neckZ - s.rootTipZ) * up;
  const float fork = molar ? 0.25f * s.halfWidth : 0.f;
  const Vec r(std::abs(q.x), q.y, q.z);
  const float root =
      tube(r, {fork, 0, 1}, {2 * fork, 0, -rootLength}, std::min(s.halfWidth, s.halfDepth) * 0.72f, 1);
  const float pulp = tube(q, {0, 0, 0.45f * height}, {0, 0, -0.7f * rootLength}, 0.9f, 0.3f);
  return {join(crown, root, 1), std::max(crown, 0.4f - q.z), pulp};
}

}  // namespace

Tooth teeth(Vec p) {
  static const std::array<ToothShape, 7> upper = placed(upperArch), lower = placed(lowerArch);
  p = mirrored(p);
  const float outside = box(p, {0, -62, -62}, {36, 28, 24}, 0);
  if (outside > 4) return {outside, outside, outside};
  Tooth nearest{1e3f, 1e3f, 1e3f};
  for (std::size_t n = 0; n < upper.size(); ++n)
    for (const auto* arch : {&upper, &lower}) {
      const ToothShape& s = (*arch)[n];
      const float dx = p.x - s.x, dy = p.y - s.y;
      if (dx * dx + dy * dy > 144) continue;
      const Tooth tooth = toothAt(p, s, n >= 3);
      if (tooth.distance < nearest.distance) nearest = tooth;
    }
  return nearest.distance < 1e3f ? nearest : Tooth{6, 6, 6};
}

}  // namespace volumen::head
