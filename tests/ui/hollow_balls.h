#pragma once

#include <glm/geometric.hpp>

#include "tests/fixtures/small_volumes.h"
#include "tests/ui/test_series.h"

namespace volumen::tests {

/// Returns 40 x 40 x 40 voxels of 1 mm, centred on the origin. A hollow ball of 1000 lies at -5 (radius 6 to
/// 10) around a core of 500 (radius 4). A small ball of 1000 lies apart at 12 (radius 3). The rest is 0.
inline LoadedSeriesPtr hollowBalls() {
  auto series = std::make_shared<LoadedSeries>(
      *seriesOf(volumeOf<std::int16_t>(glm::ivec3(40), glm::dmat3(1), [](glm::dvec3 pVoxel) {
        const glm::dvec3 p = pVoxel - 19.5;
        const double inBall = glm::length(p + 5.0), inSmall = glm::length(p - 12.0);
        if (inBall < 4) return 500.0;
        return (inBall > 6 && inBall < 10) || inSmall < 3 ? 1000.0 : 0.0;
      })));
  series->series.acquired = series->volume->geometry();
  series->firstScene.transferFunction.points = {{400, {1, 1, 1}, 0.0}, {400, {1, 1, 1}, 1.0}};
  return series;
}

/// Counts the voxels of the grid of hollowBalls() whose centre fulfils `isIn`.
template <class IsIn>
std::int64_t voxelsWhere(const IsIn& isIn) {
  std::int64_t count = 0;
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) count += isIn(glm::dvec3(i, j, k) - 19.5) ? 1 : 0;
  return count;
}
inline bool isShell(glm::dvec3 p) { return glm::length(p + 5.0) > 6 && glm::length(p + 5.0) < 10; }
inline bool isCore(glm::dvec3 p) { return glm::length(p + 5.0) < 4; }
inline bool isSmall(glm::dvec3 p) { return glm::length(p - 12.0) < 3; }

/// Returns two balls of 1000 (radius 6, centres 8 mm to either side of the origin along x), joined by a rod
/// of radius 1.5. The rest is 0.
inline constexpr glm::dvec3 inLeftBall(-8, 0, 0), inRightBall(8, 0, 0);
inline LoadedSeriesPtr joinedBalls() {
  auto series = std::make_shared<LoadedSeries>(*hollowBalls());
  series->volume = volumeOf<std::int16_t>(glm::ivec3(40), glm::dmat3(1), [](glm::dvec3 pVoxel) {
    const glm::dvec3 p = pVoxel - 19.5;
    const bool inRods = std::abs(p.x) < 8 && std::hypot(p.y, p.z) < 1.5;
    return inRods || glm::distance(p, inLeftBall) < 6 || glm::distance(p, inRightBall) < 6 ? 1000.0 : 0.0;
  });
  series->firstScene.transferFunction.points = {{500, {1, 1, 1}, 0.0}, {500, {1, 1, 1}, 1.0}};
  return series;
}

/// Positions in the hollow ball and in the small ball.
inline constexpr glm::dvec3 inShell(-5 + 8, -5, -5), inSmallBall(12);

}  // namespace volumen::tests
