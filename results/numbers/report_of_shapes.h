#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "io/report.h"
#include "io/study/loaded.h"
#include "io/study/series.h"
#include "viewer/measure/measure.h"

namespace volumen {

/// The images that a shape is measured on.
struct ReportedOn {
  const Series* series = nullptr;
  VoxelGeometry grid{};                ///< the measured grid; unused for shapes on frames
  std::vector<SliceOrigin> origins{};  ///< as in Loaded: the acquired slice that each slice of `grid` is
  std::vector<double> places{};        ///< as in Loaded: acquired slices along k of `grid`; empty: its slices
  bool isTiled = false;   ///< its slices are tiles of one image (mosaic), so that pixels do not fit
  int frame = 0;          ///< index in the series of the frame that a shape is drawn on
  glm::dvec2 pixelMm{1};  ///< size of a pixel of that frame, or its proportions
};

/// Returns a measured shape as a measurement group of TID 1500 that OHIF brings back to life: its tracking
/// identifier names the tool of Cornerstone3D and the shape's name. Numbers are those of `measured`, with
/// UCUM units. A shape on one acquired slice has pixels of that image (0, 0 is the outer corner), other
/// shapes of a volume are in patient space and name the nearest slices. Areas are also the region of the
/// group (TID 1410). The Error says why without the shape's name or full stop: lengths are in pixels, the
/// series is not from DICOM files or has no frame of reference, or a shape on a frame leaves it.
Result<MeasurementGroup> reportedShape(const Shape& shape, const Measured& measured, const ReportedOn& on);

}  // namespace volumen
