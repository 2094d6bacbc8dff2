#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "ui/data/series_key.h"
#include "viewer/measure/shape.h"

namespace volumen {

/// What was measured on a series: a plain value of the workspace.
struct Measurement {
  int id = 0;                           ///< above 0, its own in a workspace
  SeriesKey series;                     ///< whose voxels it is of
  Shape shape;                          ///< its name may be empty; arrows say it as their text
  std::optional<glm::dvec3> textOffset; /**< from the middle of the shape to that of its text, mm, of frames
                                           pixels; none: placed beside the shape */
  bool operator==(const Measurement&) const = default;
};

}  // namespace volumen
