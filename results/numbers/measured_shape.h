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
  const Series* series = nullptr;  ///< of the frame; null: it was measured in the volume, or on nothing
  int frame = 0;                   ///< index in `series`
  glm::dvec2 pixelMm{1};           ///< size of a pixel of the frame, or its proportions
};

/// A volume in which shapes are measured.
struct ShapesVolume {
  Series series;
  VolumePtr volume;                    ///< the drawn grid
  std::vector<SliceOrigin> origins{};  ///< as in Loaded
  std::vector<double> places{};        ///< as in Loaded
};

/// A shape to measure.
struct ShapeToMeasure {
  Shape shape;
  std::string name;                      ///< for messages: "[2] (length)"
  const ShapesVolume* volume = nullptr;  ///< null: it is on a frame
};

/// Returns the scale of a series' values.
using ScaleOf = std::function<Result<ValueScale>(const Series& series)>;

/// Series whose frames shapes are measured on. Keeps the frame that was read last, as shapes often share one.
class FramesToMeasure {
 public:
  explicit FramesToMeasure(std::vector<Series> all = {}) : all_(std::move(all)) {}

  /// Returns the frame of a shape, and its series and index there. The Error: no series has it, or it cannot
  /// be read.
  struct Found {
    const Series* series = nullptr;
    int index = 0;
    Result<LoadedFramePtr> frame;
  };
  Result<Found> find(const ShapeFrame& name);

 private:
  std::vector<Series> all_;
  LoadedFramePtr last_;
};

/// Measures shapes in their volumes and on frames. Shapes of one frame follow each other, so that each frame
/// is read once; results are in the order of `shapes`. After `cancel` some are Errors.
std::vector<MeasuredShape> measuredShapes(std::span<const ShapeToMeasure> shapes, FramesToMeasure& frames,
                                          const ScaleOf& scaleOf, const CancelToken& cancel);
/// Does the same with values in SUVbw where there is SUV.
std::vector<MeasuredShape> measuredShapes(std::span<const ShapeToMeasure> shapes, FramesToMeasure& frames,
                                          const CancelToken& cancel);

/// Returns the images that a shape is measured on, in a volume or on a frame. The result refers to the
/// argument.
MeasuredOn placeIn(const ShapesVolume& volume, bool isTiled = false);
MeasuredOn placeOn(const MeasuredShape& frame);

}  // namespace volumen
