#pragma once

#include <optional>
#include <string>

#include "viewer/measure/peak.h"
#include "viewer/measure/range_volume.h"
#include "viewer/measure/region.h"
#include "viewer/measure/shape.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/rigid.h"

namespace volumen {

/// The acquired voxel nearest to a point (`nearest` of slices.md 1).
struct ProbedVoxel {
  glm::ivec3 index{0};
  glm::dvec3 centre{0};  ///< Centre of the voxel, patient mm.
  bool padding = false;  ///< True if the value is padding.
};

/// A position or a distance along an axis of an ultrasound region.
struct AxisReading {
  double number = 0;
  std::string unit;  ///< "s", "cm/s", ...
};

/// Additional information about a measurement on a frame (slices.md 4).
struct FrameReading {
  std::string calibration;  ///< Calibration of the mm, e.g. "at detector"; empty: the patient's mm, or px.
  bool colour = false;      ///< True if the frame has only colours, no values.
  std::optional<glm::ivec3> rgb;  ///< Colour at a probe on a colour frame, 0 to 255.
  /// Set in regions of units other than cm. For probes: the position of the point. For lengths: the distance
  /// between the ends, never below 0.
  std::optional<AxisReading> across, down;
};

/// The lengths of the two lines of a shape (ShapeRule::twoLines): long and short axis, or heart and thorax.
struct TwoLines {
  double first = 0, second = 0;
  std::string unit;  ///< Either "mm" or "px".
};

/// The axis of a leg through the centres of hip, knee and ankle.
struct LegAxis {
  /// Side to which the knee is bent. Varus: the knee lies outwards of the line from hip to ankle.
  enum class Bend { unknown, varus, valgus };
  double hka = 180;  ///< Angle at the knee, degrees.
  Bend bend = Bend::unknown;
};

/// Values of another series in a region.
struct OtherValues {
  std::string source;  ///< Name of the series; empty if unknown.
  std::string unit;    ///< Unit of its values.
  std::optional<ValueStatistics> values;
  std::optional<ValuePeak> peak;  ///< Same as Measured::peak.
};

/// Results of measuring a shape (slices.md 4).
struct Measured {
  /// Length, long axis, angle, deviation of a leg from straight, ratio, area, value of a probe (not of
  /// colours), or volume of the voxels.
  double number = 0;
  /// Unit: "mm", "degrees", "mm^2", "ml", or that of a probe's value; may be empty. On grids without
  /// calibration "px", "px^2" and "voxels" replace units with mm.
  std::string unit;
  std::optional<double> plusMinus;        ///< Uncertainty of lengths, in their unit.
  std::optional<TwoLines> lines;          ///< Set for axes and ratios.
  std::optional<LegAxis> leg;             ///< Set for leg axes.
  std::optional<ValueStatistics> values;  ///< Set for regions, unless no voxel is inside.
  std::optional<ValuePeak> peak;          ///< SUVpeak of regions in SUV volumes.
  std::string source;                     ///< Name of the series of `values` if `other` is set.
  std::optional<OtherValues> other;       ///< Set for regions on fused slices (addOther()).
  std::optional<ProbedVoxel> voxel;       ///< Set for probes.
  std::optional<RangeVolume> segment;     ///< Set for volumes, in voxels.
  std::optional<double> drawn;            ///< Volume as drawn, in `unit`.
  std::string valueUnit;                  ///< Unit of the volume's values.
  std::optional<FrameReading> frame;      ///< Set for shapes on frames.
};

/// Measures one shape on the voxels of a volume. `valueUnit`: unit of the volume's values (Series::unit).
/// Returns an Error if
/// - checkShape() refuses the shape, or it belongs to a frame,
/// - a point of a region is off its plane by more than half a voxel along the normal,
/// - an arm of an angle has no length, or the axes are more than 1 degree off a right angle,
/// - an arrow or a label is measured, or the thorax has no width,
/// - a probe lies outside the volume's box, or `cancel` was requested.
Result<Measured> measure(const Shape& shape, const Volume& volume, const std::string& valueUnit,
                         const CancelToken& cancel = {});

/// Returns true if values in this unit are SUV, whose regions have a SUVpeak.
bool isSuv(const std::string& valueUnit);

/// Adds the values of a second volume in a measured region; does nothing for other shapes. `toOther` maps the
/// patient space of the shape to that of the volume.
void addOther(Measured& measured, const Shape& shape, const Volume& other, const Rigid& toOther,
              const std::string& valueUnit, const CancelToken& cancel = {});

}  // namespace volumen
