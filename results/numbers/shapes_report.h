#pragma once

#include <string>
#include <vector>

#include "io/report.h"
#include "io/study/study.h"
#include "results/numbers/measured_shape.h"
#include "results/numbers/report_of_shapes.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// A report of measured shapes.
struct ShapesReport {
  Report report;
  std::vector<std::string> notes{};  ///< sentences: what is left out or not said
  std::vector<Unread> unread{};      ///< losses of the series with the frames
};

/// Measures shapes in their volumes, or on frames of `frames`, and returns their report (TID 1500). Shapes
/// without number are left out. `study` has the instances of all volumes. The Error begins with the name of
/// the shape that a report cannot hold; it is empty if no shape has a number.
Result<ShapesReport> reportOfShapes(std::span<const ShapeToMeasure> shapes, const Study& study,
                                    FramesToMeasure& frames, const CancelToken& cancel);

/// Returns whether all slices of a series are tiles of one image without frames (mosaic).
Result<bool> isMosaic(const Study& study, const Series& series);

/// Returns the study that a document about images is made of: all that belongs to the study with this UID.
Study studyOfUid(std::span<const Study* const> open, const std::string& studyUid);

}  // namespace volumen
