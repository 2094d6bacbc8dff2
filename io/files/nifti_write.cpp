#include "io/files/nifti_write.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <optional>

namespace volumen {

namespace {

template <class T>
void put(std::string& header, std::size_t place, T value) {
  std::memcpy(header.data() + place, &value, sizeof value);
}

int niftiType(SampleType type) {
  static constexpr int codes[] = {256, 2, 4, 512, 8, 768, 1024, 1280, 16, 64};
  return codes[int(type)];
}

// Returns the rotation of the axes of `L`; left-handed axes have the third inverted and `qfac` -1. Empty if
// the axes are not perpendicular; decimals in files leave errors of some 1e-5.
std::optional<glm::dquat> rotation(const glm::dmat3& L, double& qfac) {
  glm::dmat3 R(glm::normalize(L[0]), glm::normalize(L[1]), glm::normalize(L[2]));
  const double skew = std::max(
      {std::abs(glm::dot(R[0], R[1])), std::abs(glm::dot(R[1], R[2])), std::abs(glm::dot(R[2], R[0]))});
  constexpr double roundingOfFiles = 1e-4;
  if (skew > roundingOfFiles) return {};
  R[1] = glm::normalize(R[1] - glm::dot(R[1], R[0]) * R[0]);
  R[2] = glm::cross(R[0], R[1]) * (glm::determinant(R) < 0 ? -1.0 : 1.0);
  qfac = glm::determinant(R) < 0 ? -1 : 1;
  R[2] *= qfac;
  glm::dquat q = glm::normalize(glm::quat_cast(R));
  return q.w < 0 ? -q : q;  // NIfTI does not store w: it is positive
}

void putGeometry(std::string& header, const VoxelGeometry& g) {
  const glm::dmat3 rasFromLps(glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1));
  const glm::dmat3 L = rasFromLps * g.patientFromVoxelStep;
  const glm::dvec3 origin = rasFromLps * g.origin, spacing = g.spacing();
  double qfac = 1;
  if (const auto q = rotation(L, qfac)) {
    put<std::int16_t>(header, 252, 1);  // qform_code: scanner
    const double parts[] = {q->x, q->y, q->z, origin.x, origin.y, origin.z};
    for (std::size_t n = 0; n < 6; ++n) put(header, 256 + 4 * n, float(parts[n]));
  }
  put(header, 76, float(qfac));
  for (int a = 0; a < 3; ++a) put(header, 80 + 4 * std::size_t(a), float(spacing[a]));
  put<std::int16_t>(header, 254, 1);  // sform_code: scanner
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      put(header, 280 + 4 * std::size_t(4 * row + column), float(L[column][row]));
    put(header, 280 + 4 * std::size_t(4 * row + 3), float(origin[row]));
  }
  constexpr char mm = 2;
  header[123] |= mm;
}

}  // namespace

Result<std::string> niftiHeader(const VoxelGeometry& g, SampleType type, double slope, double intercept,
                                const NiftiTime& time) {
  constexpr int mostVoxels = std::numeric_limits<std::int16_t>::max();
  if (std::max({g.size.x, g.size.y, g.size.z, time.volumes}) > mostVoxels)
    return Error{"NIfTI holds at most 32767 voxels along an axis; write .nrrd or .mha."};
  constexpr std::size_t firstSample = 352;
  std::string header(firstSample, '\0');
  put<std::int32_t>(header, 0, 348);
  header[38] = 'r';  // "regular", required by old readers
  const int dims[] = {time.volumes > 1 ? 4 : 3, g.size.x, g.size.y, g.size.z, time.volumes, 1, 1, 1};
  for (std::size_t n = 0; n < 8; ++n) {
    put(header, 40 + 2 * n, std::int16_t(dims[n]));
    put(header, 76 + 4 * n, 1.0f);
  }
  constexpr char seconds = 8;
  if (time.stepSeconds > 0) header[123] = seconds, put(header, 92, float(time.stepSeconds));
  put(header, 70, std::int16_t(niftiType(type)));
  put(header, 72, std::int16_t(8 * bytesOf(type)));
  put(header, 108, float(firstSample));
  put(header, 112, float(slope));
  put(header, 116, float(intercept));
  if (g.calibrated) putGeometry(header, g);
  header.replace(344, 4, std::string("n+1\0", 4));
  return header;
}

}  // namespace volumen
