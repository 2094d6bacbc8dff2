#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "io/study/loaded.h"
#include "io/study/series.h"
#include "io/study/suv.h"
#include "results/numbers/shape_places.h"
#include "results/series/loaded_frame.h"
#include "viewer/measure/measure.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// A measured shape, and the frame that it was measured on.
struct MeasuredShape {
  Result<Measured> measured;
  const Series* series = nullptr;  ///< series of the frame; null if measured in a volume, or not at all
  int frame = 0;                   ///< index in `series`
  glm::dvec2 pixelMm{1};           ///< pixel size of the frame in mm, or only its proportions
};

/// A volume in which shapes are measured.
struct ShapesVolume {
  Series series;
  VolumePtr volume;                    ///< on the drawn grid
  std::vector<SliceOrigin> origins{};  ///< Loaded::origins
  std::vector<double> places{};        ///< Loaded::places
};

/// A shape to measure.
struct ShapeToMeasure {
  Shape shape;
  std::string name;                      ///< for messages: "[2] (length)"
  const ShapesVolume* volume = nullptr;  ///< null if the shape is on a frame
};

/// Returns the scale of a series' values (unit and factor), or an Error.
using ScaleOf = std::function<Result<ValueScale>(const Series& series)>;

/// The series with the frames on which shapes are measured. Keeps the frame that was read last, as shapes
/// often share one.
class FramesToMeasure {
 public:
  explicit FramesToMeasure(std::vector<Series> all = {}) : all_(std::move(all)) {}

  /// The frame of a shape, and its series and index there. `frame` is an Error if it cannot be read.
  struct Found {
    const Series* series = nullptr;
    int index = 0;
    Result<LoadedFramePtr> frame;
  };
  /// Returns the frame that has this name. Returns an Error if no series has it.
  Result<Found> find(const ShapeFrame& name);

 private:
  std::vector<Series> all_;
  LoadedFramePtr last_;
};

/// Measures shapes in their volumes and on frames, one frame after the other, so that each is read once. The
/// results are in the order of `shapes`. A shape that cannot be measured has an Error. So have the remaining
/// shapes if cancelled.
std::vector<MeasuredShape> measuredShapes(std::span<const ShapeToMeasure> shapes, FramesToMeasure& frames,
                                          const ScaleOf& scaleOf, const CancelToken& cancel);
/// Does the same with values in SUVbw for series that have SUV.
std::vector<MeasuredShape> measuredShapes(std::span<const ShapeToMeasure> shapes, FramesToMeasure& frames,
                                          const CancelToken& cancel);

/// Returns the images that a shape is measured on, in a volume or on a frame. The result refers to the
/// argument. `isTiled` is true if the volume is read from mosaics.
MeasuredOn placeIn(const ShapesVolume& volume, bool isTiled = false);
MeasuredOn placeOn(const MeasuredShape& frame);

}  // namespace volumen
