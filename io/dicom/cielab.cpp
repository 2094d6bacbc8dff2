#include "io/dicom/cielab.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace volumen::dicom {
namespace {

/// Inverts cubeRoot() (CIE 15).
double cubed(double t) { return t > 6.0 / 29 ? t * t * t : 3 * 36.0 / 841 * (t - 4.0 / 29); }

/// Returns the cube root of L*a*b*, linear near 0 (CIE 15).
double cubeRoot(double t) { return t > 216.0 / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29; }

/// Encodes a linear component as sRGB (IEC 61966-2-1). decoded() is its inverse.
double encoded(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}
double decoded(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

const glm::dvec3 white(0.96422, 1, 0.82521);  // D50
/// Matrix from XYZ (D50) to linear sRGB, with Bradford adaptation.
const glm::dmat3 linearFromXyz(3.1338561, -0.9787684, 0.0719453, -1.6168667, 1.9161415, -0.2289914,
                               -0.4906146, 0.0334540, 1.4052427);

}  // namespace

std::optional<glm::u8vec3> readCieLab(const DataSet& data, std::uint32_t tag, DataSet::Scope scope) {
  const std::vector<std::uint16_t> words = data.words(tag, scope);
  if (words.size() < 3) return {};
  const double l = words[0] / 655.35, a = words[1] / 257.0 - 128, b = words[2] / 257.0 - 128;
  const double y = (l + 16) / 116;
  const glm::dvec3 xyz = white * glm::dvec3(cubed(y + a / 500), cubed(y), cubed(y - b / 200));
  const glm::dvec3 linear = linearFromXyz * xyz;
  glm::u8vec3 colour;
  for (int c = 0; c < 3; ++c) colour[c] = std::uint8_t(255 * encoded(linear[c]) + 0.5);
  return colour;
}

std::array<std::uint16_t, 3> cieLabOf(glm::u8vec3 colour) {
  glm::dvec3 linear;
  for (int c = 0; c < 3; ++c) linear[c] = decoded(colour[c] / 255.0);
  const glm::dvec3 xyz = glm::inverse(linearFromXyz) * linear / white;
  const double x = cubeRoot(xyz.x), y = cubeRoot(xyz.y), z = cubeRoot(xyz.z);
  const double words[] = {(116 * y - 16) * 655.35, (500 * (x - y) + 128) * 257, (200 * (y - z) + 128) * 257};
  std::array<std::uint16_t, 3> lab;
  for (std::size_t n = 0; n < 3; ++n) lab[n] = std::uint16_t(std::clamp(words[n] + 0.5, 0.0, 65535.0));
  return lab;
}

}  // namespace volumen::dicom
