#pragma once

#include <functional>
#include <limits>

#include "tests/fixtures/small_volumes.h"
#include "viewer/segment/grow_from_seeds.h"

namespace volumen::tests {

/// A margin in mm that reaches beyond any grid.
inline constexpr double everywhere = std::numeric_limits<double>::infinity();

/// Returns voxels of 1 mm with these values.
inline VolumePtr valuesBy(glm::ivec3 size, const std::function<double(glm::dvec3)>& valueAt) {
  return volumeOf<std::int16_t>(size, glm::dmat3(1), valueAt);
}

}  // namespace volumen::tests
