#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "io/study/suv.h"
#include "viewer/measure/measure.h"

namespace volumen {

/// A measured shape, and the frame that it was measured on.
struct MeasuredShape {
  Result<Measured> measured;
  const Series* series = nullptr;  ///< of the frame; null: it was measured in the volume, or on nothing
  int frame = 0;                   ///< index in `series`
  glm::dvec2 pixelMm{1};           ///< size of a pixel of the frame, or its proportions
};

/// Returns the scale of a series' values.
using ScaleOf = std::function<Result<ValueScale>(const Series& series)>;

/// Reads the frame of a shape, which is in one of the series, and measures the shape on it.
MeasuredShape measuredOnFrame(const Shape& shape, const std::vector<Series>& all, const ScaleOf& scaleOf);

}  // namespace volumen
