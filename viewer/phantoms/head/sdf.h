#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

/// Signed distances in mm, negative inside, to the shapes that the head consists of. They are exact or
/// slightly too small outside, and never below minus the smallest half width inside, so that far means far.
/// No transcendental functions are used: the bytes are the same on every machine.
namespace volumen::head {

using Vec = glm::vec3;

inline float ellipsoid(Vec p, Vec centre, Vec radii) {
  const Vec q = (p - centre) / radii;
  const float k0 = glm::length(q), k1 = glm::length(q / radii);
  const float smallest = std::min({radii.x, radii.y, radii.z});
  return k1 > 0 ? std::max(k0 * (k0 - 1) / k1, -smallest) : -smallest;
}

/// A tube from a to b whose radius changes from radiusA to radiusB.
inline float tube(Vec p, Vec a, Vec b, float radiusA, float radiusB) {
  const Vec ab = b - a;
  const float t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.f, 1.f);
  return glm::length(p - a - t * ab) - (radiusA + t * (radiusB - radiusA));
}
inline float tube(Vec p, Vec a, Vec b, float radius) { return tube(p, a, b, radius, radius); }

/// A box with rounded edges. `half` includes the rounding.
inline float box(Vec p, Vec centre, Vec half, float rounding) {
  const Vec q = glm::abs(p - centre) - (half - rounding);
  return glm::length(glm::max(q, Vec(0))) + std::min(std::max({q.x, q.y, q.z}), 0.f) - rounding;
}

/// The union of two shapes, blended smoothly where they are within k mm of each other.
inline float join(float a, float b, float k) {
  const float h = std::max(k - std::abs(a - b), 0.f) / k;
  return std::min(a, b) - h * h * k * 0.25f;
}
/// The intersection of two shapes.
inline float both(float a, float b, float k) { return -join(-a, -b, k); }
/// Shape a without shape b.
inline float without(float a, float b, float k) { return -join(-a, b, k); }

/// Returns the share of a voxel inside a surface at distance d, 0..1. The edge is 2 w wide.
inline float cover(float d, float w) {
  const float t = std::clamp(0.5f - 0.5f * d / w, 0.f, 1.f);
  return t * t * (3 - 2 * t);
}
/// Returns 0 up to `low`, 1 from `high` on, and a smooth transition between.
inline float rise(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.f, 1.f);
  return t * t * (3 - 2 * t);
}

inline std::uint32_t mixed(int x, int y, int z) {
  return std::uint32_t(x) * 0x8da6b343u ^ std::uint32_t(y) * 0xd8163841u ^ std::uint32_t(z) * 0xcb1ab31fu;
}
inline std::uint32_t hashOf(int x, int y, int z) {
  std::uint32_t h = mixed(x, y, z);
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return h ^ (h >> 15);
}

/// Returns smooth noise in -1..1 that varies over a distance of 1.
inline float noise(Vec p) {
  const Vec base = glm::floor(p);
  const Vec f = p - base, s = f * f * (3.f - 2.f * f);
  const int x = int(base.x), y = int(base.y), z = int(base.z);
  const auto at = [&](int a, int b, int c) {
    std::uint32_t h = mixed(x + a, y + b, z + c) * 0x2c1b3c6du;
    h = (h ^ (h >> 15)) * 0x297a2d39u;
    return float(std::int32_t(h)) * 0x1p-31f;
  };
  const float low =
      glm::mix(glm::mix(at(0, 0, 0), at(1, 0, 0), s.x), glm::mix(at(0, 1, 0), at(1, 1, 0), s.x), s.y);
  const float high =
      glm::mix(glm::mix(at(0, 0, 1), at(1, 0, 1), s.x), glm::mix(at(0, 1, 1), at(1, 1, 1), s.x), s.y);
  return glm::mix(low, high, s.z);
}

/// Returns a smooth wave of period 1 between -1 and 1.
inline float wave(float x) {
  const float t = std::abs(2 * (x - std::floor(x)) - 1);
  return 2 * t * t * (3 - 2 * t) - 1;
}

/// Left and right half are mirror images. The left one (x >= 0) is modelled.
inline Vec mirrored(Vec p) { return {std::abs(p.x), p.y, p.z}; }

}  // namespace volumen::head
