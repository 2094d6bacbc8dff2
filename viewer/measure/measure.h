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

/// The acquired voxel at a point, by `nearest` (slices.md 1).
struct ProbedVoxel {
  glm::ivec3 index{0};
  glm::dvec3 centre{0};  ///< of the voxel, patient mm
  bool padding = false;  ///< its value stands for no value
};

/// A place or a distance along an axis of an ultrasound region.
struct AxisReading {
  double number = 0;
  std::string unit;  ///< "s", "cm/s", ...
};

/// What is said of a frame beside the number (slices.md 4).
struct FrameReading {
  std::string calibration;        ///< what is true of the mm: "at detector"; empty: the patient's, or px
  bool colour = false;            ///< it has no values, only colours
  std::optional<glm::ivec3> rgb;  ///< of probes of colours, 0 to 255
  std::optional<AxisReading> across, down;  ///< in a region of other units than cm: of probes where the point
                                            ///< lies, of lengths from end to end, never below 0
};

/// How long the two lines of a shape are (ShapeRule::twoLines): the long axis and the short one, the heart
/// and the thorax.
struct TwoLines {
  double first = 0, second = 0;
  std::string unit;  ///< "mm", "px"
};

/// A leg by the centres of hip, knee and ankle.
struct LegAxis {
  /// To which side the knee is bent: varus is outwards of the line from hip to ankle.
  enum class Bend { unknown, varus, valgus };
  double hka = 180;  ///< the angle at the knee, degrees
  Bend bend = Bend::unknown;
};

/// What another series says in a region.
struct OtherValues {
  std::string source;  ///< what names it; empty: nobody said
  std::string unit;    ///< of its values
  std::optional<ValueStatistics> values;
  std::optional<ValuePeak> peak;  ///< as Measured::peak
};

/// What a shape measures (slices.md 4).
struct Measured {
  double number = 0;  ///< length, the long axis, angle, how far a leg is from straight, ratio, area, the
                      ///< probe's value (of colours none), the voxels' volume
  std::string unit;   ///< "mm", "degrees", "mm^2", "ml", the probe's own; where the grid is not calibrated
                      ///< "px", "px^2" and "voxels" stand for what has mm in it; empty: none
  std::optional<double> plusMinus;        ///< of lengths, in their unit
  std::optional<TwoLines> lines;          ///< of axes and ratios
  std::optional<LegAxis> leg;             ///< of leg axes
  std::optional<ValueStatistics> values;  ///< of regions; none: no voxel inside
  std::optional<ValuePeak> peak;          ///< of regions in volumes of SUV: SUVpeak
  std::string source;                     ///< what names the series of `values` where there is `other`
  std::optional<OtherValues> other;       ///< of regions over fused slices (addOther())
  std::optional<ProbedVoxel> voxel;       ///< of probes
  std::optional<RangeVolume> segment;     ///< of volumes, in voxels
  std::optional<double> drawn;            ///< of volumes: as drawn, in `unit`
  std::string valueUnit;                  ///< of the volume's values
  std::optional<FrameReading> frame;      ///< of shapes on frames
};

/// Measures one shape on the voxels of a volume; `valueUnit` is that of its values (Series::unit). An Error
/// where checkShape() refuses it, a region's point lies further off its plane than half a voxel along the
/// normal, an arm of an angle has no length, an arrow is asked for its
/// number, the axes are more than 1 degree off a right angle, the thorax has no width, a probe lies outside
/// the volume's box, the shape is a frame's, or `cancel` was asked to.
Result<Measured> measure(const Shape& shape, const Volume& volume, const std::string& valueUnit,
                         const CancelToken& cancel = {});

/// Whether values in this unit are SUV: their regions have a SUVpeak.
bool isSuv(const std::string& valueUnit);

/// Adds what a second volume says in the region that was measured; nothing to what is no region. `toOther`
/// leads from the patient space of the shape to that of the volume.
void addOther(Measured& measured, const Shape& shape, const Volume& other, const Rigid& toOther,
              const std::string& valueUnit, const CancelToken& cancel = {});

}  // namespace volumen
