#include "viewer/volume/volume.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "viewer/volume/buffer.h"

namespace volumen {

glm::dmat3 VoxelGeometry::voxelFromPatientStep() const { return glm::inverse(patientFromVoxelStep); }

glm::dvec3 VoxelGeometry::voxelFromPatient(glm::dvec3 pPatient) const {
  return voxelFromPatientStep() * (pPatient - origin);
}

glm::dmat3 VoxelGeometry::patientFromVoxelGradient() const { return glm::transpose(voxelFromPatientStep()); }

glm::dvec3 VoxelGeometry::spacing() const {
  const auto& L = patientFromVoxelStep;
  return {glm::length(L[0]), glm::length(L[1]), glm::length(L[2])};
}

glm::dvec3 VoxelGeometry::centre() const { return patientFromVoxel((glm::dvec3(size) - 1.0) * 0.5); }

std::vector<glm::dvec3> VoxelGeometry::boxCorners() const {
  std::vector<glm::dvec3> corners;
  for (int n = 0; n < 8; ++n) {
    const glm::dvec3 upper(n & 1, (n >> 1) & 1, n >> 2);
    corners.push_back(patientFromVoxel(upper * glm::dvec3(size) - 0.5));
  }
  return corners;
}

double VoxelGeometry::voxelVolume() const { return std::abs(glm::determinant(patientFromVoxelStep)); }

std::string cutText(const Cut& cut) {
  const std::string table = cut.table ? "table removed" : "";
  if (cut.outlines == 0) return table;
  const std::string outlines = std::to_string(cut.outlines) + (cut.outlines == 1 ? " outline" : " outlines");
  return table.empty() ? outlines : outlines + ", " + table;
}

namespace {

// Larger values are limited (design.md 10), so that sums and products stay finite in float32.
constexpr float largestValue = 1e30f;
// Smaller fractions of the largest value become 0: no float holds the product of both.
constexpr float smallestShare = 1e-33f;

// Returns whether rounding values to floats is noticeable beside a step of the stored integers. Integers
// would then be more exact than the file's values here (picture.md 2).
bool roundsToFloats(const VolumeParts& parts) {
  return std::abs(parts.intercept) > double(1 << 17) * std::abs(parts.slope);
}

Status checkGeometry(const VoxelGeometry& g) {
  for (int a = 0; a < 3; ++a) {
    if (g.size[a] < 1)
      return Error{"The volume has " + std::to_string(g.size[a]) + " voxels along axis " + std::to_string(a) +
                   "."};
    for (int b = 0; b < 3; ++b)
      if (!std::isfinite(g.patientFromVoxelStep[a][b]))
        return Error{"The voxel spacing or orientation is not finite."};
    if (!std::isfinite(g.origin[a])) return Error{"The position of the volume is not finite."};
  }
  const glm::dvec3 s = g.spacing();
  const double relativeVolume = g.voxelVolume() / (s.x * s.y * s.z);
  if (!(relativeVolume > 1e-9)) return Error{"The three voxel axes do not span space (determinant 0)."};
  return {};
}

// Replaces NaN and -inf by the smallest and +inf by the largest finite value (picture.md 2). Returns the
// number of changes.
std::size_t replaceNonFinite(std::vector<float>& values) {
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (float v : values)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (low > high) low = high = 0;
  std::size_t changed = 0;
  for (float& v : values) {
    if (std::isfinite(v)) continue;
    v = v > 0 ? high : low;
    ++changed;
  }
  return changed;
}

std::size_t limitLarge(std::vector<float>& values) {
  std::size_t changed = 0;
  for (float& v : values) {
    if (std::abs(v) <= largestValue) continue;
    v = std::copysign(largestValue, v);
    ++changed;
  }
  return changed;
}

std::size_t dropSmall(std::vector<float>& values) {
  float most = 0;
  for (float v : values) most = std::max(most, std::abs(v));
  std::size_t changed = 0;
  for (float& v : values) {
    if (v == 0 || std::abs(v) >= smallestShare * most) continue;
    v = 0;
    ++changed;
  }
  return changed;
}

// Floats are kept as real values (slope 1), so that limits and replacements refer to the file's values.
void makeReal(VolumeParts& parts) {
  if (parts.slope == 1 && parts.intercept == 0 && std::holds_alternative<std::vector<float>>(parts.values))
    return;
  std::vector<float> real;
  std::visit(
      [&](const auto& v) {
        real = zeros<float>(v.size());
        for (std::size_t n = 0; n < v.size(); ++n)
          real[n] = float(parts.slope * double(v[n]) + parts.intercept);
      },
      parts.values);
  parts.values = std::move(real);
  parts.slope = 1;
  parts.intercept = 0;
}

}  // namespace

Result<VolumePtr> Volume::make(VolumeParts parts, std::vector<std::string>& warnings) {
  if (Status s = checkGeometry(parts.geometry); !s) return s.error();
  const std::size_t count = std::visit([](const auto& v) { return v.size(); }, parts.values);
  if (std::int64_t(count) != parts.geometry.voxelCount())
    return Error{"The data hold " + std::to_string(count) + " samples, but the grid has " +
                 std::to_string(parts.geometry.voxelCount()) + " voxels."};
  if (!std::isfinite(parts.slope) || !std::isfinite(parts.intercept) || parts.slope == 0)
    return Error{"The rescale slope or intercept is zero or not finite."};

  const bool floats = std::holds_alternative<std::vector<float>>(parts.values);
  if (floats || roundsToFloats(parts) ||
      std::abs(parts.slope) * 65535 + std::abs(parts.intercept) > largestValue) {
    makeReal(parts);
    auto& values = std::get<std::vector<float>>(parts.values);
    if (std::size_t n = replaceNonFinite(values))
      warnings.push_back(
          std::to_string(n) +
          " values are NaN or infinite; they were replaced by the smallest or largest finite value.");
    if (std::size_t n = limitLarge(values))
      warnings.push_back(std::to_string(n) + " values are beyond 1e30 and were limited to it.");
    if (std::size_t n = dropSmall(values))
      warnings.push_back(std::to_string(n) + " values are below 1e-33 of the largest and were set to 0.");
  }
  return VolumePtr(new Volume(std::move(parts)));
}

std::size_t Volume::bytes() const {
  return std::visit([](const auto& v) { return v.size() * sizeof(v[0]); }, parts_.values);
}

const char* Volume::typeName() const {
  static constexpr const char* names[] = {"uint8", "int16", "uint16", "float32"};
  return names[parts_.values.index()];
}

}  // namespace volumen
