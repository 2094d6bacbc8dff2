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

/// Where the voxels lie (picture.md 1). Voxel space: (i, j, k), centres at integers. Patient space: DICOM
/// LPS, mm.
struct VoxelGeometry {
  glm::ivec3 size{1};  ///< voxels along i, j, k; each >= 1
  glm::dmat3 patientFromVoxelStep{
      1};                ///< L: column a is the step in mm from one voxel to the next along axis a
  glm::dvec3 origin{0};  ///< o: patient position of the centre of voxel (0, 0, 0), mm
  bool calibrated =
      true;  ///< false: no position or spacing known; drawn at a nominal 1 mm, no mm or directions shown

  bool operator==(const VoxelGeometry&) const = default;

  /// p = L x + o, mm.
  glm::dvec3 patientFromVoxel(glm::dvec3 pVoxel) const { return patientFromVoxelStep * pVoxel + origin; }
  /// x = L^-1 (p - o).
  glm::dvec3 voxelFromPatient(glm::dvec3 pPatient) const;
  /// inverse(L): voxels per mm.
  glm::dmat3 voxelFromPatientStep() const;
  /// transpose(inverse(L)): turns a gradient in value per voxel into one in value per mm (picture.md 3).
  glm::dmat3 patientFromVoxelGradient() const;
  /// Lengths of the columns of L, mm.
  glm::dvec3 spacing() const;
  /// patientFromVoxel((n - 1)/2): the centre of the volume.
  glm::dvec3 centre() const;
  /// The largest / smallest coordinate of the box of voxel cells (picture.md 1: -1/2 .. n - 1/2), as its
  /// eight corners in patient space.
  std::vector<glm::dvec3> boxCorners() const;
  /// Volume of one voxel, mm^3 (|det L|).
  double voxelVolume() const;
  std::int64_t voxelCount() const { return std::int64_t(size.x) * size.y * size.z; }
};

/// The samples as the file holds them, i fastest.
using VoxelValues = std::variant<std::vector<std::uint8_t>, std::vector<std::int16_t>,
                                 std::vector<std::uint16_t>, std::vector<float>>;

/// A closed range of values (real units: HU for CT).
struct ValueRange {
  double low = 0, high = 0;
  bool operator==(const ValueRange&) const = default;
};

/// A range with its ends rounded to float32, as values of voxels are: what a file says is 0.7 lies from 0.7
/// on.
inline ValueRange inFloats(ValueRange range) { return {double(float(range.low)), double(float(range.high))}; }

/// Whether the value of a voxel lies in a range, by inFloats().
inline bool holds(ValueRange range, double value) {
  const ValueRange compared = inFloats(range);
  return value >= compared.low && value <= compared.high;
}

/// Whether a value is padding; none of them is where there is no range of it.
inline bool isPadding(const std::optional<ValueRange>& padding, double value) {
  return padding && holds(*padding, value);
}

/// A display window (picture.md 6), real units.
struct Window {
  double centre = 40, width = 400;
  bool operator==(const Window&) const = default;
};

/// What was taken away from a volume (masked) before it is drawn or measured.
struct Cut {
  bool table = false;  ///< what lies outside the patient was made air
  int outlines = 0;    ///< how many outlines cut
  bool operator==(const Cut&) const = default;
};

/// "2 outlines, table removed"; empty: nothing.
std::string cutText(const Cut& cut);

/// What titles, presets and histograms want to know and the picture does not.
struct VolumeAttributes {
  std::string name;             ///< for titles: file name or series description
  std::string modality;         ///< DICOM Modality ("CT", "MR", ...), empty where unknown
  std::vector<Window> windows;  ///< the file's own windows, first is the default
  std::optional<ValueRange>
      padding;  ///< values left out of histogram and automatic presets (design.md 10), real units
  Cut cut;
};

/// All that a Volume is made from.
struct VolumeParts {
  VoxelGeometry geometry;
  VoxelValues values;
  double slope = 1, intercept = 0;  ///< real value = slope * stored + intercept
  VolumeAttributes attributes;
};

/// Immutable samples and geometry. A voxel's value is slope * stored + intercept, in double, rounded once to
/// float32 (design.md 10).
class Volume {
 public:
  /// Checks and takes over `parts`; shares the result. NaN and infinities become the smallest / largest
  /// finite value (picture.md 2), |value| > 1e30 is limited; each such change adds a sentence to `warnings`.
  /// Refused: sizes that do not match, non-finite geometry or rescale, det L = 0, slope 0.
  static Result<std::shared_ptr<const Volume>> make(VolumeParts parts, std::vector<std::string>& warnings);

  const VoxelGeometry& geometry() const { return parts_.geometry; }
  glm::ivec3 size() const { return parts_.geometry.size; }
  const VoxelValues& stored() const { return parts_.values; }
  double slope() const { return parts_.slope; }
  double intercept() const { return parts_.intercept; }
  const VolumeAttributes& attributes() const { return parts_.attributes; }

  /// The value of voxel (i, j, k), real units. Indices must lie inside.
  float value(int i, int j, int k) const {
    return valueAt((std::size_t(k) * size().y + j) * std::size_t(size().x) + i);
  }
  /// The value of the n-th voxel in memory order (i fastest), real units.
  float valueAt(std::size_t n) const {
    return std::visit([&](const auto& v) { return realValue(double(v[n])); }, parts_.values);
  }
  /// What a stored sample means, real units, rounded once to float32.
  float realValue(double storedValue) const { return float(parts_.slope * storedValue + parts_.intercept); }
  /// Bytes held by the samples.
  std::size_t bytes() const;
  /// "uint8", "int16", "uint16" or "float32".
  const char* typeName() const;

 private:
  explicit Volume(VolumeParts parts) : parts_(std::move(parts)) {}
  VolumeParts parts_;
};

using VolumePtr = std::shared_ptr<const Volume>;

}  // namespace volumen
