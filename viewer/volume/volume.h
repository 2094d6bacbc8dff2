#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// Position of the voxels (picture.md 1). Voxel space: (i, j, k), centres at integers. Patient space: DICOM
/// LPS, mm.
struct VoxelGeometry {
  glm::ivec3 size{1};                  ///< Voxels along i, j, k; each >= 1
  glm::dmat3 patientFromVoxelStep{1};  ///< L: column a is the step in mm along voxel axis a
  glm::dvec3 origin{0};                ///< o: patient position of the centre of voxel (0, 0, 0), mm
  /// False if position and spacing are unknown: drawn at a nominal 1 mm, without mm or directions shown.
  bool calibrated = true;

  bool operator==(const VoxelGeometry&) const = default;

  /// Returns p = L x + o, mm.
  glm::dvec3 patientFromVoxel(glm::dvec3 pVoxel) const { return patientFromVoxelStep * pVoxel + origin; }
  /// Returns x = L^-1 (p - o).
  glm::dvec3 voxelFromPatient(glm::dvec3 pPatient) const;
  /// Returns inverse(L), voxels per mm.
  glm::dmat3 voxelFromPatientStep() const;
  /// Returns transpose(inverse(L)), which turns gradients in value per voxel into value per mm (picture.md
  /// 3).
  glm::dmat3 patientFromVoxelGradient() const;
  /// Returns the lengths of the columns of L, mm.
  glm::dvec3 spacing() const;
  /// Returns the centre of the volume, patientFromVoxel((n - 1)/2).
  glm::dvec3 centre() const;
  /// Returns the eight corners of the box of voxel cells (picture.md 1: -1/2 .. n - 1/2) in patient space.
  std::vector<glm::dvec3> boxCorners() const;
  /// Returns the volume of one voxel, mm^3 (|det L|).
  double voxelVolume() const;
  std::int64_t voxelCount() const { return std::int64_t(size.x) * size.y * size.z; }
};

/// The samples as stored in the file, i fastest.
using VoxelValues = std::variant<std::vector<std::uint8_t>, std::vector<std::int16_t>,
                                 std::vector<std::uint16_t>, std::vector<float>>;

/// A closed range of values (real units: HU for CT).
struct ValueRange {
  double low = 0, high = 0;
  bool operator==(const ValueRange&) const = default;
};

/// Returns the range with ends rounded to float32, as voxel values are: a file's 0.7 then lies in a range
/// from 0.7.
inline ValueRange inFloats(ValueRange range) { return {double(float(range.low)), double(float(range.high))}; }

/// Returns whether a voxel's value lies in a range, by inFloats().
inline bool holds(ValueRange range, double value) {
  const ValueRange compared = inFloats(range);
  return value >= compared.low && value <= compared.high;
}

/// Returns whether a value is padding; false if there is no padding.
inline bool isPadding(const std::optional<ValueRange>& padding, double value) {
  return padding && holds(*padding, value);
}

/// A display window (picture.md 6), real units.
struct Window {
  double centre = 40, width = 400;
  bool operator==(const Window&) const = default;
};

/// The parts cut away from a volume (masked()) before drawing or measuring.
struct Cut {
  bool table = false;  ///< True if everything outside the patient was made air
  int outlines = 0;    ///< Number of outlines cut
  bool operator==(const Cut&) const = default;
};

/// Returns for example "2 outlines, table removed"; empty if nothing was cut.
std::string cutText(const Cut& cut);

/// Attributes for titles, presets and histograms that pictures do not need.
struct VolumeAttributes {
  std::string name;             ///< File name or series description, for titles
  std::string modality;         ///< DICOM Modality ("CT", "MR", ...); empty if unknown
  std::vector<Window> windows;  ///< The file's own windows, default first
  /// Values left out of histograms and automatic presets (design.md 10), real units.
  std::optional<ValueRange> padding;
  Cut cut;
};

/// The parts that a Volume is made from.
struct VolumeParts {
  VoxelGeometry geometry;
  VoxelValues values;
  double slope = 1, intercept = 0;  ///< Real value = slope * stored + intercept
  VolumeAttributes attributes;
};

/// Immutable samples and geometry. A voxel's value is slope * stored + intercept in double, rounded once to
/// float32 (design.md 10).
class Volume {
 public:
  /// Checks and takes over `parts`. NaN and infinities become the smallest or largest finite value
  /// (picture.md 2), values beyond 1e30 are limited and those below 1e-33 of the largest become 0; each such
  /// change adds a sentence to `warnings`. The Error means: sizes that do not match, non-finite geometry or
  /// rescale, det L = 0, or slope 0.
  static Result<std::shared_ptr<const Volume>> make(VolumeParts parts, std::vector<std::string>& warnings);

  const VoxelGeometry& geometry() const { return parts_.geometry; }
  glm::ivec3 size() const { return parts_.geometry.size; }
  const VoxelValues& stored() const { return parts_.values; }
  double slope() const { return parts_.slope; }
  double intercept() const { return parts_.intercept; }
  const VolumeAttributes& attributes() const { return parts_.attributes; }

  /// Returns the value of voxel (i, j, k) in real units. Indices must lie inside.
  float value(int i, int j, int k) const {
    return valueAt((std::size_t(k) * size().y + j) * std::size_t(size().x) + i);
  }
  /// Returns the value of the n-th voxel in memory order (i fastest) in real units.
  float valueAt(std::size_t n) const {
    return std::visit([&](const auto& v) { return realValue(double(v[n])); }, parts_.values);
  }
  /// Returns the real value of a stored sample, rounded once to float32.
  float realValue(double storedValue) const { return float(parts_.slope * storedValue + parts_.intercept); }
  /// Returns the size of the samples in bytes.
  std::size_t bytes() const;
  /// Returns "uint8", "int16", "uint16" or "float32".
  const char* typeName() const;

 private:
  explicit Volume(VolumeParts parts) : parts_(std::move(parts)) {}
  VolumeParts parts_;
};

using VolumePtr = std::shared_ptr<const Volume>;

}  // namespace volumen
