#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "io/study/series_key.h"
#include "viewer/measure/shape.h"

namespace volumen {

/// A measurement on a series: a plain value of the workspace.
struct Measurement {
  int id = 0;                           ///< above 0, unique in a workspace
  SeriesKey series;                     ///< the series whose voxels it measures
  Shape shape;                          ///< its name may be empty; arrows show it as their text
  std::optional<glm::dvec3> textOffset; /**< from the middle of the shape to that of its text, mm; on frames,
                                           pixels; empty: placed beside the shape */
  bool operator==(const Measurement&) const = default;
};

}  // namespace volumen
